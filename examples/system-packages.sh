#!/usr/bin/env bash
# Installs what the workspace needs besides a Rust toolchain: a C linker, pkg-config and the
# netCDF library with its headers (which brings HDF5). Does nothing where they are there already.
# Without a Rust toolchain, or with one that is too old, it says how to get one.
set -euo pipefail

needed=$(sed -n 's/^rust-version = "\(.*\)"/\1/p' "$(dirname "${BASH_SOURCE[0]}")/../Cargo.toml")

missing=()
command -v cc >/dev/null || missing+=(build-essential)
command -v pkg-config >/dev/null || missing+=(pkg-config)
pkg-config --exists netcdf hdf5 2>/dev/null || missing+=(libnetcdf-dev)

if [ ${#missing[@]} -gt 0 ]; then
    if ! command -v apt-get >/dev/null; then
        echo "error: this machine has no apt-get; install a C compiler, pkg-config and netCDF-C (development files) and try again" >&2
        exit 1
    fi
    as_root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "error: packages are missing and there is no sudo; as root:" >&2
            echo "    apt-get update && apt-get install --no-install-recommends ${missing[*]}" >&2
            exit 1
        fi
        as_root=(sudo)
    fi
    echo "Installing ${missing[*]}"
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
fi

# Debian's own is too old: cargo 1.65 in version 12.
found=$(command -v cargo >/dev/null && cargo --version | cut -d' ' -f2 || true)
if [ "$(printf '%s\n' "$needed" "${found:-0}" | sort -V | head -n1)" != "$needed" ]; then
    echo "error: ${found:+cargo $found is too old, }Rust $needed or later is needed; from https://rustup.rs (with the packages curl and ca-certificates):" >&2
    echo "    curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh -s -- -y --profile minimal && . ~/.cargo/env" >&2
    exit 1
fi
