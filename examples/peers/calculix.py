"""Writes the deck for CalculiX and runs it; prints P, A, Q and the number of unknowns as JSON.

    calculix.py ELEMENTS_PER_RADIUS INCREMENTS [DIRECTORY]

Contact is surface to surface by penalty. The stick slope is the number to tune: ten times as much
does not converge, and the less of it, the softer the contact is in shear.
"""

import json
import re
import subprocess
import sys
from pathlib import Path

import problem

STICK_SLOPE = 1e7  # MPa/mm
OVERCLOSURE_SLOPE = 1e9  # MPa/mm
FACES = {1: (0, 1, 2, 3), 2: (4, 7, 6, 5), 3: (0, 4, 5, 1), 4: (1, 5, 6, 2), 5: (2, 6, 7, 3), 6: (3, 7, 4, 0)}


def lines(numbers, per_line=12):
    numbers = [str(n) for n in numbers]
    return "".join(", ".join(numbers[i : i + per_line]) + ",\n" for i in range(0, len(numbers), per_line))


def write_deck(path, elements_per_radius, increments):
    points, cells, top, base, symmetry = problem.half_hemisphere(elements_per_radius)
    reach = 2 * problem.CONTACT_RADIUS
    faces = []
    for e, cell in enumerate(cells):
        for face, corners in FACES.items():
            nodes = [cell[c] for c in corners]
            if all(n in top for n in nodes) and all(
                abs(points[n, 0]) <= reach and points[n, 1] <= reach for n in nodes
            ):
                faces.append((e + 1, face))
    count = len(points)
    flat = range(count + 1, count + 9)
    with open(path, "w") as deck:
        deck.write("*HEADING\nhemisphere pressed and slid, mm N MPa\n*NODE, NSET=ALL\n")
        for n, p in enumerate(points, 1):
            deck.write(f"{n}, {p[0]:.12e}, {p[1]:.12e}, {p[2]:.12e}\n")
        w, z = 4 * problem.CONTACT_RADIUS, problem.RADIUS
        corners = [(-w, -w), (w, -w), (w, w), (-w, w)]
        for n, (x, y, z) in zip(flat, [(x, y, z) for z in (z, z + w) for x, y in corners]):
            deck.write(f"{n}, {x:.12e}, {y:.12e}, {z:.12e}\n")
        deck.write("*ELEMENT, TYPE=C3D8I, ELSET=BODY\n")
        for e, cell in enumerate(cells, 1):
            deck.write(f"{e}, " + ", ".join(str(n + 1) for n in cell) + "\n")
        deck.write(f"*ELEMENT, TYPE=C3D8, ELSET=FLAT\n{len(cells) + 1}, " + ", ".join(map(str, flat)) + "\n")
        deck.write("*NSET, NSET=BASE\n" + lines(n + 1 for n in sorted(base)))
        deck.write("*NSET, NSET=SYMMETRY\n" + lines(n + 1 for n in sorted(symmetry - base)))
        deck.write("*NSET, NSET=FLATNODES\n" + lines(flat))
        deck.write("*SURFACE, NAME=SLAVE\n" + "".join(f"{e}, S{f}\n" for e, f in faces))
        deck.write(f"*SURFACE, NAME=MASTER\n{len(cells) + 1}, S1\n")
        deck.write(
            f"""*MATERIAL, NAME=STEEL
*ELASTIC
{problem.YOUNG}, {problem.POISSON}
*PLASTIC
{problem.YIELD}, 0
{problem.YIELD + problem.HARDENING}, 1
*MATERIAL, NAME=RIGID
*ELASTIC
{problem.YOUNG}, {problem.POISSON}
*SOLID SECTION, ELSET=BODY, MATERIAL=STEEL
*SOLID SECTION, ELSET=FLAT, MATERIAL=RIGID
*SURFACE INTERACTION, NAME=INTERFACE
*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR
{OVERCLOSURE_SLOPE}
*FRICTION
{problem.FRICTION}, {STICK_SLOPE}
*CONTACT PAIR, INTERACTION=INTERFACE, TYPE=SURFACE TO SURFACE
SLAVE, MASTER
*BOUNDARY
BASE, 1, 3
SYMMETRY, 2, 2
"""
        )
        for x, z in [(0.0, -problem.DEPTH), (problem.SLIDE * problem.DEPTH, -problem.DEPTH)]:
            deck.write(
                f"""*STEP, INC=1000
*STATIC
{1 / increments}, 1, 1e-6, {1 / increments}
*BOUNDARY
FLATNODES, 1, 1, {x:.12e}
FLATNODES, 2, 2, 0
FLATNODES, 3, 3, {z:.12e}
*NODE PRINT, NSET=FLATNODES, TOTALS=ONLY
RF
*CONTACT PRINT, SLAVE=SLAVE, MASTER=MASTER
CF
*END STEP
"""
            )
    return 3 * (count - len(base)) - len(symmetry - base)


def numbers(line):
    return [float(x) for x in re.findall(r"[-+]?\d+\.\d*E[-+]\d+", line)]


def results(path):
    """(time, forces of the flat, area) of the last increment in the .dat file."""
    forces = area = time = None
    text = path.read_text().splitlines()
    for i, line in enumerate(text):
        if line.strip().startswith("total force") and "FLATNODES" in line:
            time = float(line.split("time")[1])
            forces = numbers(text[i + 2])
        if "area," in line and "normal force" in line:
            area = next(numbers(x)[0] for x in text[i + 1 :] if numbers(x))
    return time, forces, area


def main():
    elements, increments = map(int, sys.argv[1:3])
    directory = Path(sys.argv[3] if len(sys.argv) > 3 else f"calculix-{elements}")
    directory.mkdir(parents=True, exist_ok=True)
    unknowns = write_deck(directory / "slide.inp", elements, increments)
    print(json.dumps({"unknowns": unknowns}), flush=True)
    with open(directory / "log", "w") as log:
        code = subprocess.run(["ccx", "-i", "slide"], cwd=directory, stdout=log, stderr=log).returncode
    time, forces, area = results(directory / "slide.dat")
    # Those of the half, on the asperity.
    print(
        json.dumps(
            {
                "finished": code == 0 and time > 2 - 1e-6,
                "time": time,
                "P": 2 * abs(forces[2]),
                "Q": 2 * abs(forces[0]),
                "A": 2 * area if area else None,
            }
        )
    )


if __name__ == "__main__":
    main()
