#!/usr/bin/env bash
# On a processor that is too old, emulated by QEMU, programs and package end with a message and not with an illegal
# instruction.
#
#   examples/tests/old-processor.sh DIRECTORY PYTHON       DIRECTORY of the programs, PYTHON that can import asperity
set -euo pipefail

[ "$(uname -m)" = x86_64 ] || exit 0
if ! command -v qemu-x86_64 >/dev/null; then
    as_root=()
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" apt-get install -q -y --no-install-recommends qemu-user
fi

refused() {
    local status=0 message
    message=$(qemu-x86_64 -cpu Nehalem "$@" 2>&1) || status=$?
    tail -n 1 <<<"$message"
    if [ $status -ne 1 ] || [[ $message != *"was compiled for a processor with"* ]]; then
        echo "error: $1 ended with status $status" >&2
        exit 1
    fi
}
refused "$1/asperity" --version
refused "$1/roughsurface" --version
refused "$("$2" -c 'import sys; print(sys.executable)')" -c 'import asperity'
