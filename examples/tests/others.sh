#!/usr/bin/env bash
# Runs the examples that are not in Rust, coarsely: Python, Snakemake, the job array (one task after the
# other), the table of costs, and the tests of the Python package, of the HTML report in Chromium and of the lines for
# other programs. Not the comparison with other codes in
# examples/peers, which has needs of its own.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

packages=()
python3 -c 'import ensurepip' 2>/dev/null || packages+=(python3-venv)
{ command -v chromium && command -v chromedriver; } >/dev/null || packages+=(chromium chromium-driver)
command -v pvpython >/dev/null || packages+=(paraview python3-paraview)
if [ ${#packages[@]} -gt 0 ]; then
    as_root=()
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" apt-get install -q -y --no-install-recommends "${packages[@]}"
fi
versions=$PWD/examples/tests/python-versions.txt
# Also for what pip needs to build a package.
export PIP_CONSTRAINT=$versions PIP_BUILD_CONSTRAINT=$versions
cmp -s "$versions" target/python/versions.txt || {
    python3 -m venv --clear target/python
    target/python/bin/pip install -q meshio xarray netCDF4 matplotlib snakemake pytest tqdm nbclient ipykernel \
        scipy selenium SurfaceTopography
    cp "$versions" target/python/versions.txt
}
cargo build --locked --release --workspace
PATH=${CARGO_TARGET_DIR:-$PWD/target}/release:$PWD/target/python/bin:$PATH
output=$(mktemp -d)
trap 'rm -rf "$output"' EXIT

coarse=(--set numerics.elements_per_radius=4 --set numerics.sectors=4 --set loading.slip_distance=0.1)
asperity run examples/scenes/single-asperity.toml -o "$output/run.nc" "${coarse[@]}" --vtu "$output/fields" --quiet
python examples/read_body.py "$output/fields/body.pvd"

examples/snakemake/two-jobs.sh "$output/snakemake"
python examples/friction_against_rate.py "$output/snakemake/table.nc" "$output/figure.png"
test -s "$output/figure.png"

for task in 1 2; do
    SLURM_ARRAY_TASK_ID=$task SLURM_ARRAY_TASK_COUNT=2 \
        examples/snakemake/slurm-array.sh examples/snakemake/small-request.toml "$output/table.nc"
done
asperity merge "$output"/table.nc.shards/*.nc -o "$output/table.nc" --quiet
asperity table diff "$output/table.nc" "$output/snakemake/table.nc" --tolerance 0

python examples/scaling.py --set loading.slip_distance=0.1 4

# With the dependencies that were built for the programs.
target/python/bin/pip install -q './asperity/python[all]'
pytest -q asperity/python/tests examples/tests
examples/tests/old-processor.sh "${CARGO_TARGET_DIR:-target}/release" python
