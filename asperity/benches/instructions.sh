#!/usr/bin/env bash
# Instructions of a small case, in total and by function: comparable between machines and versions, as times are not.
#
#     asperity/benches/instructions.sh            # prints them beside the recorded ones
#     asperity/benches/instructions.sh --record   # and records them in instructions.txt
#
# Needs valgrind, which does not support AVX-512. The program is compiled into target/instructions. Takes some minutes.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
record=asperity/benches/instructions.txt

cargo build --quiet --locked --release -p asperity --target-dir target/instructions
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

count() {
    local strain=$1
    RAYON_NUM_THREADS=1 valgrind --tool=callgrind --callgrind-out-file="$work/$strain.out" --quiet \
        target/instructions/release/asperity run examples/scenes/single-asperity.toml \
        --output "$work/$strain.nc" --quiet --set "model.kinematics=$strain" \
        --set loading.interference=5 --set loading.slip_distance=0.02 \
        --set numerics.elements_per_radius=4 --set numerics.sectors=4
    printf '%s strain: 5 omega_c, 1 m/s, slide 0.02 a0, 4 elements and angles, with auxiliary runs\n' "$strain"
    # Millions of instructions; hashes of symbols are left out.
    callgrind_annotate --auto=no --threshold=90 "$work/$strain.out" | awk '
        /PROGRAM TOTALS/ { gsub(",", "", $1); printf "%10.0f  all\n", $1 / 1e6 }
        /\([ 0-9.]+%\)/ && !/PROGRAM TOTALS/ {
            gsub(",", "", $1); millions = $1 / 1e6
            sub(/^[^:]*:/, ""); sub(/ \[.*/, ""); sub(/::h[0-9a-f]+$/, "")
            if (millions >= 20) printf "%10.0f  %s\n", millions, $0
        }'
}

{ count small; count finite; } > "$work/now.txt"
if [ "${1-}" = --record ]; then
    cp "$work/now.txt" "$record"
fi
diff --side-by-side --width=200 "$record" "$work/now.txt" || true
