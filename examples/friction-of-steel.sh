#!/usr/bin/env bash
# From a material and a roughness to friction, in one command.
#
#   examples/friction-of-steel.sh [OUTPUT_DIR]          default: friction-of-steel
#
# 1. Installs missing system packages (examples/system-packages.sh) and builds both programs.
# 2. asperity tabulate: one asperity of 4340 steel, pressed and slid at 6 interferences and
#    5 slip rates (examples/scenes/steel-4340-table.toml) -> table.nc, table.png
# 3. roughsurface predict: friction of a ground steel surface of such asperities
#    (examples/scenes/ground-steel-surface.toml)          -> friction.nc, friction.png
#
# Interrupted in step 2, it goes on with the cells that are missing when started again.
set -euo pipefail

output=${1:-friction-of-steel}
case $output in
-*)
    sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
    exit 2
    ;;
esac
mkdir -p "$output"
output=$(cd "$output" && pwd)
# Cargo reads .cargo/config.toml from the directory it is started in.
cd "$(dirname "${BASH_SOURCE[0]}")/.."

section() { printf '\n== %s  [%d s]\n' "$1" "$SECONDS"; }

section "System packages and build"
examples/system-packages.sh
# The whole workspace at once: cargo compiles dependencies anew for another choice of packages.
cargo build --locked --release --workspace
programs=$(cargo metadata --locked --no-deps --format-version 1 | sed 's/.*"target_directory":"\([^"]*\)".*/\1/')/release

section "One asperity of 4340 steel, R = 1 mm: 6 interferences x 5 slip rates"
# The journal of an interrupted run, if there is one, is continued.
"$programs/asperity" tabulate examples/scenes/steel-4340-table.toml --resume \
    -o "$output/table.nc" --plot "$output/table.png"

section "Friction of a ground surface of such asperities"
"$programs/roughsurface" predict examples/scenes/ground-steel-surface.toml --table "$output/table.nc" \
    -o "$output/friction.nc" --plot "$output/friction.png"

section "Written to $output"
cat <<END
table.nc      one asperity: mu, Q, P, area, temperature over interference and slip rate
table.png     the same as a figure
friction.nc   the surface: mu, mu_static, Q, real area over pressure and slip rate
friction.png  the same as a figure
Read them with:  ncdump -h friction.nc   or   xarray.open_dataset("friction.nc")
END
