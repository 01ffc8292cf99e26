#!/usr/bin/env bash
# Makes the figure of the README anew: runs the main job and keeps its picture here.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
examples/friction-of-steel.sh
cp friction-of-steel/friction.png examples/figures/
