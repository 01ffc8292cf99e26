#!/usr/bin/env python3
"""Solves one problem with asperity, CalculiX and GetFEM and prints what each found and took.

    compare.py [--asperity PATH] [--limit SECONDS] [--codes asperity,calculix,getfem] [--increments N]
               [--rows FILE] [N_C]...

N_C is the number of elements per contact radius, 8 and 16 by default. CalculiX and GetFEM take N increments
in the press and N in the slide; asperity chooses its own. Each code runs on one thread,
one after the other; one that has used more processor time than the limit is stopped and shown as
"more than". What was measured is added to the file given with --rows, one JSON object a line, of which
chart.py draws error against time.
"""

import argparse
import json
import os
import resource
import subprocess
import sys
import tempfile
from pathlib import Path

HERE = Path(__file__).resolve().parent
# Debian's Python: it has GetFEM.
PYTHON = "/usr/bin/python3"
ONE_THREAD = {name: "1" for name in ("RAYON_NUM_THREADS", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS")}


def command(code, elements, arguments, folder):
    if code == "asperity":
        return [arguments.asperity, "run", str(HERE / "hemisphere.toml"), "-o", f"{folder}/run.nc", "--json", "--quiet",
                "--timings", "--set", f"numerics.elements_per_radius={elements}"]  # fmt: skip
    if code == "calculix":
        return [PYTHON, str(HERE / "calculix.py"), str(elements), str(arguments.increments), f"{folder}/calculix"]
    return [PYTHON, str(HERE / "getfem_slide.py"), str(elements), str(arguments.increments)]


def results(code, text):
    if code == "asperity":
        run = json.loads(text)
        value = {name: run["summary"][name]["value"] for name in ("P", "Q", "area")}
        return {
            "P": value["P"],
            "Q": value["Q"],
            "A": 1e6 * value["area"],
            "unknowns": run["account"]["unknowns"],
            "main": run["timings"]["main_run"] / run["timings"]["total"],
            "finished": run["completion"] == "complete",
        }
    merged = {}
    for line in text.splitlines():
        if line.startswith("{"):
            merged.update(json.loads(line))
    return merged


def measure(code, elements, arguments):
    limit = arguments.limit

    def restrict():
        resource.setrlimit(resource.RLIMIT_CPU, (limit, limit + 5))

    with tempfile.TemporaryDirectory() as folder, tempfile.TemporaryFile() as output:
        process = subprocess.Popen(
            command(code, elements, arguments, folder),
            stdout=output,
            stderr=subprocess.DEVNULL,
            env={**os.environ, **ONE_THREAD},
            preexec_fn=restrict,
        )
        _, _, usage = os.wait4(process.pid, 0)
        output.seek(0)
        try:
            found = results(code, output.read().decode())
        except ValueError:
            found = {}
    seconds = usage.ru_utime + usage.ru_stime
    if code != "asperity":
        found["increments"] = arguments.increments
    found["stopped"] = seconds > 0.99 * limit
    return {**found, "seconds": seconds, "memory": usage.ru_maxrss / 1e3}


def cell(value, text):
    return text.format(value) if value is not None else ""


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("elements", nargs="*", type=int, default=[8, 16], metavar="N_C")
    parser.add_argument("--asperity", default="asperity")
    parser.add_argument("--limit", type=int, default=1800, help="processor time of one run, s [1800]")
    parser.add_argument("--codes", default="asperity,calculix,getfem")
    parser.add_argument("--increments", type=int, default=20, help="of press and slide each, CalculiX and GetFEM [20]")
    parser.add_argument("--rows", type=Path, help="file to add the results to")
    arguments = parser.parse_args()
    print("| code | n_c | unknowns | P (N) | Q (N) | A (mm²) | Q/P | processor time (s) | MB |")
    print("|---|---|---|---|---|---|---|---|---|")
    for elements in arguments.elements:
        for code in arguments.codes.split(","):
            found = measure(code, elements, arguments)
            done = found.get("finished", False)
            how = "" if done else "more than " if found["stopped"] else "failed after "
            time = f"{how}{found['seconds']:.1f}"
            if "main" in found:
                time += f" ({found['main'] * found['seconds']:.1f} without error estimates)"
            P, Q = (found.get(name) if done else None for name in "PQ")
            row = [code, str(elements), cell(found.get("unknowns"), "{}"), cell(P, "{:.4f}"), cell(Q, "{:.4f}")]
            row += [cell(found.get("A") if done else None, "{:.4e}"), cell(Q / P if P else None, "{:.4f}")]
            print("| " + " | ".join([*row, time, f"{found['memory']:.0f}"]) + " |")
            sys.stdout.flush()
            if arguments.rows:
                with arguments.rows.open("a") as rows:
                    rows.write(json.dumps({"code": code, "elements": elements, **found}) + "\n")


if __name__ == "__main__":
    main()
