#!/usr/bin/env bash
# Makes shipped tables anew from their requests:
#
#   tables/data/make.sh [NAME]...          default: all six
#
# An interrupted one continues when started again. Two tables are made at a time, each on one processor.
set -euo pipefail

case ${1-} in
-*)
    sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
    exit 2
    ;;
esac
cd "$(dirname "${BASH_SOURCE[0]}")"
cargo build --locked --release --workspace --bin asperity
programs=$(cargo metadata --locked --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')/release
(($#)) || set -- *.toml
printf '%s\n' "${@%.toml}" | xargs -P 2 -I NAME sh -c \
    '"$1/asperity" tabulate NAME.toml -o NAME.new --jobs 1 --resume --quiet && mv NAME.new NAME.nc' make "$programs"
