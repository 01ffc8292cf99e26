"""Blocks of the comparison with published friction."""

import functools
import json
import re
import tempfile
from pathlib import Path

from .common import block, call, example, exported, overrides, plain, program, table

LIKE = ("counterface.preset=steel-1045", "counterface.elastic=false")
BODIES = [
    ("rigid, isothermal", ()),
    ("conducts heat like the asperity", LIKE),
    ("the same, strain rate", (*LIKE, "material.rate.law=johnson-cook")),
]
# Standard deviation of the heights, m, and summits per nominal area, 1/m2.
ROUGHNESSES = [("0.1 µm", 0.1e-6, 4e9), ("1 µm", 1e-6, 4e8)]


@functools.cache
def folder():
    """A folder for tables; it lasts as long as this process."""
    return tempfile.TemporaryDirectory()


def tabulated(scene, *settings):
    """The table of a request in `examples/scenes`."""
    path = Path(folder().name, f"{scene}-{len(settings)}.nc")
    line = ("tabulate", f"examples/scenes/{scene}.toml", *overrides(settings), "-o", path, "--quiet")
    call(program("asperity"), *line)
    return path


def predicted(surface, path, *settings):
    """Friction of a surface in `examples/scenes` over pressure and slip rate."""
    scene = f"examples/scenes/{surface}.toml"
    output = Path(folder().name, "friction.nc")
    line = ("predict", scene, "--table", path, *overrides(settings), "-o", output, "--json", "--quiet")
    return json.loads(call(program("roughsurface"), *line)[0])["friction"]


def with_error(point, name):
    return f"{point[name]['value']:.3f} ± {point[name]['error']:.3f}"


def cases(text):
    """Rows of the example `static_friction`: law, H/E and elements before the columns."""
    case = []
    for line in text.splitlines():
        words = line.split()
        if "elements" in line:
            law, hardening, elements = line.split(", ")
            case = [law, hardening.removeprefix("H = ").removesuffix(" E"), elements.split()[0]]
        elif len(words) == 8 and re.fullmatch(r"[\d.]+", words[0]):
            yield [words[0], *case, *("–" if word in ("-", "0.000") else word for word in words[1:])]


@block("static-friction", 55)
def static_friction():
    """Thresholds of the stiffness beside published static friction, from the example `static_friction`."""
    order = {"full-stick": 0, "shear-strength": 1}
    rows = sorted(cases(example("static_friction")), key=lambda row: (float(row[0]), order[row[1]], row[2], row[3]))
    head = [r"$\omega_0/\omega_c$", "law", "$H/E$", "elements", "10 %", "5 %", "2 %", "1 %", "at the end", "Brizmer et al."]
    return table(head, [row[:10] for row in rows])


@block("first-failure", 15)
def first_failure():
    """Static friction around first yield beside Kogut & Etsion, from the same example."""
    text, _, _ = call(program("examples") / "static_friction", "light")
    rows = [[row[0], row[7], row[10]] for row in cases(text)]
    return table([r"$\omega_0/\omega_c$", r"$\mu_s$ at shear strength", "Kogut & Etsion"], rows)


@block("dry-steel", 55)
def dry_steel():
    """Sliding friction of a dry steel surface up to 80 m/s: three counterfaces, two roughnesses."""
    rows = []
    for name, settings in BODIES:
        path = tabulated("dry-steel-table", *settings)
        for label, deviation, density in ROUGHNESSES:
            surface = (f"surface.heights.std={deviation}", f"surface.asperity_density={density}")
            points = predicted("dry-steel-surface", path, *surface)
            slow, fast = points[0], points[-1]
            ratio = fast["mu"]["value"] / slow["mu"]["value"]
            hot = [f"{fast[name]['value']:.0f} K" for name in ("temperature_mean", "temperature_max")]
            rows.append([name, label, *(with_error(point, "mu") for point in points), f"{ratio:.2f}", *hot])
    rates = [f"{plain(point['slip_rate'])} m/s" for point in points]
    head = ["counterface", r"$\sigma_s$", *rates, r"$\mu(80)/\mu(0.01)$", "mean $T$ at 80 m/s", "largest $T$"]
    return table(head, rows)


@block("warm-steel", 3)
def warm_steel():
    """One asperity of the same table that is warm as a whole."""
    settings = ("table.temperature=[298.0,800.0]", "table.interference=[16.0,250.0]", "table.slip_rate=[0.1,10.0]")
    path, rows = tabulated("dry-steel-table", *settings), {}
    for cell in exported(path):
        key = (float(cell["interference"]), float(cell["slip_rate"]))
        mu = f"{float(cell['mu']):.3f} ± {float(cell['mu_error']):.3f}"
        rows.setdefault(key, []).append(mu)
    head = [r"$\omega_0/\omega_c$", "$V$", r"$\mu$ at 298 K", "at 800 K"]
    return table(head, [[plain(omega), f"{plain(rate)} m/s", *values] for (omega, rate), values in rows.items()])


@block("granite", 80)
def granite():
    """Sliding friction of the granite example over the slip rate, with two counterfaces."""
    like = ("elastic=false", "thermal_conductivity=2.8", "density=2650.0", "specific_heat=830.0", "thermal_expansion=8e-6")
    rows = []
    for name, settings in (BODIES[0], (BODIES[1][0], [f"counterface.{key}" for key in like])):
        points = predicted("granite-fault", tabulated("granite-asperity-table", *settings))
        for pressure in dict.fromkeys(point["pressure"] for point in points):
            row = [point for point in points if point["pressure"] == pressure]
            rows.append([name, f"{pressure / 1e6:g} MPa", *(with_error(point, "mu") for point in row)])
    rates = [f"{plain(point['slip_rate'])} m/s" for point in row]
    return table(["counterface", r"$\bar p$", *rates], rows)
