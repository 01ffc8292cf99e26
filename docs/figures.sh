#!/usr/bin/env bash
# Draws the figures of the book and of the README: docs/src/figures/.
#
#   docs/figures.sh [friction] [run] [convergence] [bearing] [transition] [slip-rate] [press] [rate-steps]
#                   [no-end-state] [peers]                       default: all but peers
#
# friction      examples/friction-of-steel.sh, the main job: friction.png, table.svg
# run           asperity run examples/scenes/single-asperity.toml --plot: run.png
# convergence   asperity convergence examples/scenes/single-asperity.toml --plot: convergence.svg
# bearing       roughsurface predict examples/scenes/bearing-steel.toml --compare all --plot: bearing.svg
# transition    the example elastic_to_plastic, from the shipped tables: transition.svg
# slip-rate     the example slip_rate_effects, from the shipped tables: slip-rate.svg
# press         the example press_curves: press.svg
# rate-steps    the example rate_steps: rate-steps.svg
# no-end-state  the example no_end_state: no-end-state.svg
# peers         examples/peers/chart.py, from the rows that `docs/numbers.py peers` leaves in target: peers.svg; needs
#               Python with matplotlib
#
# The data are kept in target/figures. Wall time on two cores without the build: run 2 s, convergence 15 s, friction 40 s,
# bearing, transition and slip-rate 1 s, press and rate-steps 10 s, no-end-state a minute.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

figures=docs/src/figures
data=target/figures
scenes=examples/scenes
mkdir -p "$data"
[ $# -gt 0 ] || set -- friction run convergence bearing transition slip-rate press rate-steps no-end-state

cargo build --locked --release --workspace --bins --examples
asperity=${CARGO_TARGET_DIR:-target}/release/asperity
roughsurface=${CARGO_TARGET_DIR:-target}/release/roughsurface
examples=${CARGO_TARGET_DIR:-target}/release/examples

for figure; do
    begun=$SECONDS
    case $figure in
    friction)
        # Without the journal of an interrupted run.
        rm -rf "$data/friction-of-steel"
        examples/friction-of-steel.sh "$data/friction-of-steel"
        cp "$data/friction-of-steel/friction.png" "$figures/"
        $asperity table plot "$data/friction-of-steel/table.nc" -o "$figures/table.svg"
        ;;
    run)
        $asperity run $scenes/single-asperity.toml -o "$data/run.nc" --plot "$figures/run.png"
        ;;
    convergence)
        $asperity convergence $scenes/single-asperity.toml -o "$data/report.nc" --plot "$figures/convergence.svg"
        ;;
    bearing)
        $roughsurface predict $scenes/bearing-steel.toml --table model:jackson-green --compare all \
            -o "$data/bearing.nc" --plot "$figures/bearing.svg"
        ;;
    transition)
        $examples/elastic_to_plastic "$figures/transition.svg" > "$data/transition.txt"
        ;;
    slip-rate)
        $examples/slip_rate_effects "$figures/slip-rate.svg" > "$data/slip-rate.txt"
        ;;
    press)
        $examples/press_curves "$figures/press.svg" > "$data/press.txt"
        ;;
    rate-steps)
        $examples/rate_steps "$figures/rate-steps.svg" > "$data/rate-steps.txt"
        ;;
    no-end-state)
        $examples/no_end_state "$figures/no-end-state.svg" > "$data/no-end-state.txt"
        ;;
    peers)
        python3 examples/peers/chart.py target/peers.jsonl "$figures/peers.svg"
        ;;
    *)
        sed -n '2,/^set/{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}" >&2
        exit 2
        ;;
    esac
    echo "== $figure: $((SECONDS - begun)) s"
done
