#!/usr/bin/env bash
# Installs what the workspace needs besides a Rust toolchain: a C linker, pkg-config and the
# netCDF library with its headers (which brings HDF5). Does nothing where they are there already.
set -euo pipefail

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
    [ "$(id -u)" -eq 0 ] || as_root=(sudo)
    echo "Installing ${missing[*]}"
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
fi

if ! command -v cargo >/dev/null; then
    echo "error: no Rust toolchain; see https://rustup.rs (any stable version from 1.89 will do)" >&2
    exit 1
fi
