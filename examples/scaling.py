#!/usr/bin/env python3
"""Cost of one case against its resolution, as a Markdown table.

    examples/scaling.py [--asperity PATH] [--set section.key=value]... [N_C]...

Runs examples/scenes/single-asperity.toml at each number of elements per contact radius on one
thread. Processor time is that of the main run alone, without the auxiliary runs for the errors; memory is the
largest of the whole process. Standard library only.
"""

import argparse
import json
import math
import os
import subprocess
import tempfile
from pathlib import Path

EXAMPLES = Path(__file__).resolve().parent


def run(command):
    """Standard output and rusage of a command."""
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen(command, stdout=output, env={**os.environ, "RAYON_NUM_THREADS": "1"})
        _, status, usage = os.wait4(process.pid, 0)
        if status:
            raise SystemExit(f"{' '.join(command)} failed")
        output.seek(0)
        return json.load(output), usage


def exponent(xs, ys):
    """Slope of the regression line of the logarithms."""
    x, y = [[math.log(v) for v in values] for values in (xs, ys)]
    mx, my = sum(x) / len(x), sum(y) / len(y)
    return sum((a - mx) * (b - my) for a, b in zip(x, y)) / sum((a - mx) ** 2 for a in x)


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("elements", nargs="*", type=int, default=[4, 8, 12, 16, 24, 32, 48], metavar="N_C")
    parser.add_argument("--asperity", default="asperity")
    parser.add_argument("--set", action="append", default=[], metavar="section.key=value")
    arguments = parser.parse_args()
    rows = []
    print("| n_c | unknowns | steps | Newton, press | Newton per step | CG per Newton | s | preconditioner | MB | s with errors |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for elements in arguments.elements:
        with tempfile.TemporaryDirectory() as folder:
            settings = [f"numerics.elements_per_radius={elements}", *arguments.set]
            command = [arguments.asperity, "run", str(EXAMPLES / "scenes/single-asperity.toml")]
            command += ["-o", f"{folder}/run.nc", "--quiet", "--json", "--timings"]
            command += [word for setting in settings for word in ("--set", setting)]
            result, usage = run(command)
        account, timings = result["account"], result["timings"]
        newton, krylov, steps = account["newton_iterations"], account["krylov_iterations"], account["steps"]
        press = account["press_newton_iterations"]
        # The clocks of the parts run on while others have the processor: their shares are sound.
        processor = usage.ru_utime + usage.ru_stime
        main_run = processor * timings["main_run"] / timings["total"]
        row = (account["unknowns"], main_run, usage.ru_maxrss / 1e3)
        rows.append(row)
        share = timings["parts"]["preconditioner"] / timings["main_run"]
        print(
            f"| {elements} | {row[0]} | {steps} | {press} | {(newton - press) / steps:.1f} | {krylov / newton:.1f} | {row[1]:.2f} "
            f"| {100 * share:.0f} % | {row[2]:.0f} | {processor:.1f} |",
            flush=True,
        )
    if len(rows) > 1:
        unknowns, seconds, memory = zip(*rows)
        print(f"\nTime grows with unknowns to the power {exponent(unknowns, seconds):.2f},", end=" ")
        print(f"memory to the power {exponent(unknowns, memory):.2f}.")


if __name__ == "__main__":
    main()
