#!/usr/bin/env bash
# The workflow on this machine with two jobs, and whether it gives the numbers of an undivided run.
#
#   pip install snakemake && examples/snakemake/two-jobs.sh [OUTPUT_DIR]
#
# `asperity` must be in the PATH (cargo install --locked --path asperity).
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
output=${1:-snakemake-example}
mkdir -p "$output"
cd "$output"

snakemake --snakefile "$here/Snakefile" --cores 2 --quiet \
    --config request="$here/small-request.toml" table=table.nc shards=2
asperity tabulate "$here/small-request.toml" -o undivided.nc --quiet
asperity table diff table.nc undivided.nc --tolerance 0
