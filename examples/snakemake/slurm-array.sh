#!/usr/bin/env bash
# The same without Snakemake, as a Slurm job array of four shards and a merge after them:
#
#   array=$(sbatch --parsable --array=1-4 examples/snakemake/slurm-array.sh request.toml table.nc)
#   sbatch --dependency=afterok:$array --wrap "asperity merge table.nc.shards/*.nc -o table.nc"
#
# A shard that ran out of time goes on where it stopped if it is submitted again.
#SBATCH --job-name=asperity
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=1G
#SBATCH --time=04:00:00
set -euo pipefail
request=$1
table=$2
shard=$table.shards/$SLURM_ARRAY_TASK_ID.nc
mkdir -p "$table.shards"
# Status 1 with a file: some cells failed and are marked so in it; the others are worth merging.
asperity tabulate "$request" -o "$shard" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" \
    --jobs "${SLURM_CPUS_PER_TASK:-1}" --resume --quiet || { [ $? -eq 1 ] && [ -s "$shard" ]; }
