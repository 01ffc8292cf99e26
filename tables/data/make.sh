#!/usr/bin/env bash
# Makes shipped tables anew from their requests:
#
#   tables/data/make.sh [NAME]...          default: all
#
# An interrupted table continues when started again. Two tables are made at a time, each on one processor.
set -euo pipefail

case ${1-} in
-*)
    sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
    exit 2
    ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
cargo build --locked --release --workspace --bin asperity
programs=$(cargo metadata --locked --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')/release
(($#)) || set -- {titanium-6al4v,steel-304,steel-4340,aluminium-6061,steel-1045,copper}{,-rigid,-rate}
export PATH="$programs:$PATH"
make_table() {
    local resume=()
    if [ -e "tables/data/$1.nc.part" ]; then resume=(--resume); fi
    asperity tabulate "tables/data/$1.toml" -o "tables/data/$1.nc" --jobs 1 --quiet "${resume[@]}"
}
export -f make_table
printf '%s\n' "$@" | xargs -P 2 -I NAME bash -euc 'make_table NAME'
