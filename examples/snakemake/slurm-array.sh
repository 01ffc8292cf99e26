#!/usr/bin/env bash
# The same without Snakemake, as a Slurm job array of four shards and a merge after them:
#
#   array=$(sbatch --parsable --array=1-4 examples/snakemake/slurm-array.sh request.toml table.nc)
#   sbatch --dependency=afterok:$array --wrap "asperity merge table.nc.shards/*.nc -o table.nc"
#
# If a shard runs out of time or is killed, the merge stays pending (DependencyNeverSatisfied): cancel it and
# submit both again. Finished shards end at once, the others continue. To submit one shard alone, give the number
# of shards: sbatch --array=2 examples/snakemake/slurm-array.sh request.toml table.nc 4
#SBATCH --job-name=asperity
#SBATCH --cpus-per-task=1
#SBATCH --mem-per-cpu=1G
#SBATCH --time=04:00:00
set -euo pipefail
request=$1
table=$2
shards=${3:-$SLURM_ARRAY_TASK_COUNT}
shard=$table.shards/$SLURM_ARRAY_TASK_ID.nc
mkdir -p "$table.shards"
# Status 1 with a file: some cells failed and are marked as failed; the others can be merged.
asperity tabulate "$request" -o "$shard" --shard "$SLURM_ARRAY_TASK_ID/$shards" \
    --jobs "${SLURM_CPUS_PER_TASK:-1}" --resume --quiet || { [ $? -eq 1 ] && [ -s "$shard" ]; }
