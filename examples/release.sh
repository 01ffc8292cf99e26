#!/usr/bin/env bash
# The programs and the Python package for any Linux with glibc 2.28 (2018) or later: netCDF and HDF5 are in the files.
#
#   examples/release.sh [OUTPUT_DIR]          default: target/artefacts
#
# 1. Tools from the Python registry: CMake compiles netCDF and HDF5, Zig compiles and links for an old glibc.
# 2. Builds asperity, roughsurface and the wheel with the feature `static`.
# 3. Checks the shared libraries and the version of glibc that the files need.
# 4. Runs them in a bare Debian made by debootstrap (as root, or with sudo), and on an old processor emulated by QEMU.
# 5. Prints their sizes.
set -euo pipefail

output=${1:-target/artefacts}
case $output in
-*)
    sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
    exit 2
    ;;
esac
mkdir -p "$output"
output=$(cd "$output" && pwd)
cd "$(dirname "${BASH_SOURCE[0]}")/.."
glibc=2.28

section() { printf '\n== %s  [%d s]\n' "$1" "$SECONDS"; }
as_root() { if [ "$(id -u)" -eq 0 ]; then "$@"; else sudo "$@"; fi; }

section "Tools"
if ! command -v debootstrap >/dev/null || ! python3 -c 'import ensurepip' 2>/dev/null; then
    as_root apt-get update -q
    as_root apt-get install -q -y --no-install-recommends debootstrap python3-venv
fi
python3 -m venv target/release-tools
PATH=$PWD/target/release-tools/bin:$PATH
pip install -q -c examples/tests/python-versions.txt cmake ziglang cargo-zigbuild maturin

section "Programs and wheel"
export CARGO_TARGET_DIR=$PWD/target/static CARGO_PROFILE_RELEASE_STRIP=symbols
triple=$(uname -m)-unknown-linux-gnu
cargo zigbuild --locked --release --target "$triple.$glibc" --features static -p asperity -p roughsurface
cp "$CARGO_TARGET_DIR/$triple/release/"{asperity,roughsurface} "$output"
rm -f "$output"/*.whl
maturin build --quiet --zig --locked --release --compatibility "manylinux_${glibc/./_}" --features static \
    --manifest-path asperity/python/Cargo.toml --out "$output"

section "Libraries that they need"
root=$(mktemp -d)
trap 'as_root rm -rf "$root"' EXIT
pip install -q --no-deps --target "$root/package" "$output"/*.whl
for file in "$output"/{asperity,roughsurface} "$root"/package/asperity/_core*.so; do
    needed=$(objdump -p "$file" | awk '$1 == "NEEDED" { print $2 }' | sort | paste -sd ' ')
    newest=$(objdump -T "$file" | grep -o 'GLIBC_[0-9.]*' | sort -V | tail -n 1)
    echo "$(basename "$file"): $newest; $needed"
    if others=$(tr ' ' '\n' <<<"$needed" | grep -vE '^(lib(c|m|dl|rt|pthread|util|gcc_s)|ld-linux.*)\.so\.[0-9]+$'); then
        echo "error: $file needs $others" >&2
        exit 1
    fi
    if [ "$(printf 'GLIBC_%s\n' "$glibc" "${newest#GLIBC_}" | sort -V | tail -n 1)" != "GLIBC_$glibc" ]; then
        echo "error: $file needs $newest" >&2
        exit 1
    fi
done

section "A bare Debian"
as_root debootstrap --variant=minbase --include=python3-numpy bookworm "$root/debian" >"$output/debootstrap.log"
rm "$output/debootstrap.log"
as_root cp -r "$output"/{asperity,roughsurface} "$root/package" examples/scenes "$root/debian/root"
bare() { as_root chroot "$root/debian" env -C /root PYTHONPATH=/root/package "$@"; }
if bare find / -xdev '(' -name 'libnetcdf*' -o -name 'libhdf5*' ')' | grep .; then
    echo "error: the root is not bare" >&2
    exit 1
fi
coarse=(--set numerics.elements_per_radius=4 --set numerics.sectors=4 --set loading.slip_distance=0.1)
bare ./asperity --version
bare ./asperity run scenes/single-asperity.toml -o run.nc "${coarse[@]}"
bare ./roughsurface predict scenes/ground-steel-surface.toml --table steel-4340 -o friction.nc
bare python3 -c '
import asperity
print(asperity.predict("scenes/ground-steel-surface.toml", "steel-4340"))
'

section "An old processor"
PYTHONPATH=$root/package examples/tests/old-processor.sh "$output" python3

section "Written to $output"
du -h "$output"/{asperity,roughsurface,*.whl}
