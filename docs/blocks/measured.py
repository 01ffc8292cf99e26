"""Blocks of errors, verification and processor times."""

import json
import re
import tempfile
import time
from pathlib import Path

from .common import (
    ROOT,
    SINGLE,
    asperity,
    block,
    call,
    digits,
    error,
    example,
    machine,
    overrides,
    plain,
    program,
    signed,
    table,
    value,
)

PEERS = ROOT / "examples/peers"
PEER_NAMES = {"asperity": "asperity", "calculix": "CalculiX", "getfem": "GetFEM"}


@block("refinement", 30)
def refinement():
    """Three meshes of 4340 steel at 20 ω_c, and three numbers of angles."""
    slide = {"loading__slip_rate": 0, "loading__slip_distance": 0.2, "model__kinematics": "small"}
    rows = []
    for elements, sectors in ((8, 8), (16, 8), (32, 8), (8, 4), (8, 16)):
        run = asperity("run", SINGLE, **slide, numerics__elements_per_radius=elements, numerics__sectors=sectors)
        rows.append(
            [
                elements,
                sectors,
                f"{value(run, 'P'):.3f}",
                f"{value(run, 'Q'):.4f}",
                f"{1e9 * value(run, 'area'):.3f}",
                f"{value(run, 'mu_static'):.4f}",
                f"{value(run, 'mu'):.4f}",
                f"{error(run, 'P'):.1f} %",
                f"{error(run, 'area'):.1f} %",
                f"{error(run, 'mu'):.1f} %",
            ]
        )
    head = [
        "$n_c$",
        r"$N_\theta$",
        "$P$ (N)",
        "$Q$ (N)",
        "$A$ (10⁻⁹ m²)",
        r"$\mu_s$",
        r"$\mu$",
        "reported error of $P$",
        "of $A$",
        r"of $\mu$",
    ]
    return table(head, rows)


def titanium(interference, elements, **settings):
    """A fast slide, in which a thin layer of the contact is hot."""
    return asperity(
        "run",
        SINGLE,
        material__preset="titanium-6al4v",
        loading__interference=interference,
        loading__slip_rate=10,
        numerics__elements_per_radius=elements,
        **settings,
    )


@block("first-heat", 75)
def first_heat():
    """Titanium that softens before it slides."""
    rows = []
    for elements in (8, 12, 16):
        run = titanium(5, elements)
        rows.append([elements, f"{value(run, 'mu_static'):.4f}", f"{error(run, 'mu_static'):.1f} %"])
    return table(["$n_c$", r"$\mu_\text{static}$", "estimated error"], rows)


@block("thermal-layer", 50)
def thermal_layer():
    """Titanium where the heated layer is thin."""
    rows = []
    for elements in (8, 12, 16):
        run = titanium(50, elements, model__kinematics="small", numerics__sectors=4)
        rows.append(
            [elements, f"{value(run, 'mu'):.4f}", f"{error(run, 'mu'):.1f} %", f"{value(run, 'temperature_max'):.0f}"]
        )
    return table(["$n_c$", r"$\mu$", "estimated error", r"$T_\text{max}$ (K)"], rows)


@block("verify", 400, by_name=True)
def verify():
    """Every row of `asperity verify`."""
    return verification(asperity("verify"))


def verification(report):
    text = ""
    for group in report["groups"]:
        sources = list(dict.fromkeys(row["source"] for row in group["rows"]))
        text += f"**{group['group'].capitalize()}**: "
        text += "; ".join(f"[{n}] {source}" for n, source in enumerate(sources, 1)) + ".\n\n"
        rows = []
        for row in group["rows"]:
            reference, estimate = row["reference"], row.get("estimated_error")
            scale, unit = (100 / abs(reference), " %") if reference else (1.0, "")
            rows.append(
                [
                    row["quantity"].replace("|", "/").replace("*", "\\*"),
                    digits(row["computed"], 5),
                    digits(reference, 5),
                    "" if row["unit"] == "1" else row["unit"],
                    digits(scale * row["difference"], 2) + unit,
                    digits(scale * row["allowed_difference"], 2) + unit,
                    "–" if estimate is None else digits(scale * estimate, 2) + unit,
                    f"[{sources.index(row['source']) + 1}]",
                ]
            )
        head = ["quantity", "computed", "reference", "unit", "difference", "tolerance", "estimated error", "source"]
        text += table(head, rows) + "\n"
    rows = [row for group in report["groups"] for row in group["rows"]]
    text += f"{sum(row['passes'] for row in rows)} of {len(rows)} rows pass."
    if "stated_errors" in report:
        text += (
            f" {report['stated_errors_that_cover']} of {report['stated_errors']} estimated errors cover the difference."
        )
    return text + "\n"


@block("press", 25)
def press():
    """The press beside published fits, from the example `press_curves`."""
    cases, head = {}, None
    for line in example("press_curves").splitlines():
        numbers = re.findall(r"-?\d+(?:\.\d+)?", line)
        if "sigma_Y" in line:
            head = (line.split(",")[0], line.split()[1], numbers[-1])
            cases[head] = []
        elif head and len(numbers) == 7:
            cases[head].append([float(number) for number in numbers])
    strains = [head[2] for head in cases if head[:2] == ("frictionless", "small")]
    fits = [cases["frictionless", "small", strain] for strain in strains]
    pair = lambda row, place: f"{signed(row[place])} / {signed(row[place + 1])}"
    rows = [
        [plain(parts[0][0])] + [pair(row, 2) for row in parts] + [pair(row, 5) for row in parts] for parts in zip(*fits)
    ]
    head = [r"$\omega_0/\omega_c$"]
    head += [rf"$P$, $\sigma_Y/E^\ast = {strains[0]}$", *strains[1:], f"$A$, {strains[0]}", *strains[1:]]
    text = table(head, rows) + "\nFull stick and finite strain, from Jackson & Green:\n\n"
    middle = strains[1]
    other = [cases[key] for key in cases if key[2] == middle]
    rows = [
        [plain(parts[0][0])] + [signed(row[2]) for row in parts] + [signed(row[5]) for row in parts]
        for parts in zip(*other)
    ]
    names = [", ".join(key[:2]) + " strain" for key in cases if key[2] == middle]
    return text + table([r"$\omega_0/\omega_c$"] + [f"$P$, {n}" for n in names] + [f"$A$, {n}" for n in names], rows)


@block("peers", 10, by_name=True)
def peers():
    """asperity measured now beside the stored rows of the other codes."""
    others = [json.loads(line) for line in (PEERS / "others.jsonl").read_text().splitlines()]
    with tempfile.TemporaryDirectory() as folder:
        rows = Path(folder) / "rows.jsonl"
        call(
            PEERS / "compare.py", "--asperity", program("asperity"), "--codes", "asperity", "--rows", rows, 4, 8, 16, 24
        )
        ours = [json.loads(line) for line in rows.read_text().splitlines()]
    (ROOT / "target").mkdir(exist_ok=True)
    everything = [json.dumps(row) + "\n" for row in ours + others]
    (ROOT / "target/peers.jsonl").write_text("".join(everything))
    limits = {}
    for name in ("P", "A"):
        coarse, fine = (next(row[name] for row in ours if row["elements"] == n) for n in (16, 24))
        gain = (24 / 16) ** 1.5
        limits[name] = (gain * fine - coarse) / (gain - 1)
    lines = []
    for row in ours + others:
        seconds = f"{row['seconds']:.2g}" if row["seconds"] < 10 else f"{row['seconds']:.0f}"
        line = [PEER_NAMES[row["code"]], row["elements"], row.get("increments", "–"), row.get("unknowns", "")]
        if row.get("finished"):
            line += [
                f"{row['P']:.4f}",
                f"{signed(100 * (row['P'] / limits['P'] - 1))} %",
                f"{row['Q']:.4f}",
                f"{1e3 * row['A']:.3f}",
                f"{signed(100 * (row['A'] / limits['A'] - 1))} %",
            ]
        else:
            line += ["–", "–", "–", "–", "–"]
            seconds = f"{'more than' if row['stopped'] else 'no solution after'} {seconds}"
        main = f"{row['seconds'] * row['main']:.2g}" if "main" in row else seconds
        lines.append([*line, seconds if "main" in row else "–", main, f"{row['memory']:.0f}"])
    head = [
        "code",
        "$n_c$",
        "increments",
        "unknowns",
        "$P$ (N)",
        "error",
        "$Q$ (N)",
        "$A$ (10⁻⁹ m²)",
        "error",
        "processor time with error estimates (s)",
        "without (s)",
        "MB",
    ]
    return table(head, lines) + "\n" + machine().replace("Machine", "Machine of asperity")


@block("scaling", 55, by_name=True)
def scaling():
    """Processor time against resolution, from examples/scaling.py."""
    settings = ["model.kinematics=small", "numerics.sectors=4", "numerics.accuracy=0.1"]
    text = call(ROOT / "examples/scaling.py", "--asperity", program("asperity"), *overrides(settings))[0]
    text = text.replace("| n_c |", "| $n_c$ |")
    return text.rstrip("\n") + "\n\n" + machine()


@block("surface-times", 25, by_name=True)
def surface_times():
    """Processor time of a prediction for a rough surface."""
    scene, rows = "examples/scenes/ground-steel-surface.toml", []
    with tempfile.TemporaryDirectory() as folder:
        for name, words in (
            ("`predict`", ["predict"]),
            ("`sample`, 1000 asperities", ["sample", "--asperities", 1000]),
        ):
            command, *options = words
            line = [program("roughsurface"), command, scene, "--table", "steel-4340", *options, "--quiet"]
            begun = time.monotonic()
            _, seconds, memory = call(*line, "-o", f"{folder}/out.nc")
            rows.append([name, f"{time.monotonic() - begun:.2f}", f"{seconds:.2f}", f"{memory:.0f}"])
    return (
        table(["command", "wall time (s)", "processor time (s)", "MB"], rows)
        + "\n"
        + machine().replace("; one thread", "")
    )
