#!/usr/bin/env python3
"""Writes the measured numbers of the book anew: the blocks between `<!-- begin: NAME -->` and `<!-- end -->`.

    docs/numbers.py [--programs DIRECTORY] [BLOCK]...      the blocks given; without any, all that are not "by name"
    docs/numbers.py --list                                 every block, its pages and its time
    docs/numbers.py --check                                fails if a page has a block that is not known, or none for it

Each block is the output of the command that its page names. Blocks "by name" hold processor times, for which the
machine must be idle, or take minutes. The programs are those in DIRECTORY; without it they are built first, to
${CARGO_TARGET_DIR:-target}/release. Standard library only.
"""

import argparse
import csv
import json
import os
import platform
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
SINGLE = "examples/scenes/single-asperity.toml"
METALS = ["steel-4340", "steel-1045", "steel-304", "aluminium-6061", "copper", "titanium-6al4v"]
PEERS = ROOT / "examples/peers"
PEER_NAMES = {"asperity": "asperity", "calculix": "CalculiX", "getfem": "GetFEM"}
programs = ROOT / "target/release"
blocks = {}


def block(name, seconds, by_name=False):
    """Registers a function that returns the Markdown of a block; `seconds` of processor time."""

    def register(function):
        blocks[name] = (function, seconds, by_name)
        return function

    return register


# Programs


def call(*words, threads=None):
    """Standard output of a program and the processor time that it took, s."""
    environment = dict(os.environ)
    if threads:
        environment["RAYON_NUM_THREADS"] = str(threads)
    with tempfile.TemporaryFile() as output:
        process = subprocess.Popen([str(word) for word in words], stdout=output, env=environment, cwd=ROOT)
        _, status, usage = os.wait4(process.pid, 0)
        if status:
            raise SystemExit(f"failed: {' '.join(map(str, words))}")
        output.seek(0)
        return output.read().decode(), usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1e3


def asperity(command, *words, **settings):
    """JSON of `asperity COMMAND`; settings are `section__key=value`."""
    return timed(command, *words, **settings)[0]


def timed(command, *words, threads=None, **settings):
    """The same with processor time, s, and memory, MB."""
    with tempfile.TemporaryDirectory() as folder:
        line = [programs / "asperity", command, *words, "--json", "--quiet"]
        if command == "run":
            line += ["-o", f"{folder}/run.nc", "--timings"]
        for key, value in settings.items():
            line += ["--set", f"{key.replace('__', '.')}={value}"]
        text, seconds, memory = call(*line, threads=threads)
        return json.loads(text), seconds, memory


def value(run, name):
    return run["summary"][name]["value"]


def error(run, name):
    """Estimated error relative to the value, %."""
    return 100 * run["summary"][name]["error"] / abs(value(run, name))


def example(name):
    return call(programs / "examples" / name)[0]


def shipped(name):
    """Cells of a shipped table: a list of rows by interference, of dictionaries by slip rate."""
    with tempfile.TemporaryDirectory() as folder:
        call(programs / "asperity", "table", "export", name, "-o", f"{folder}/table.csv", "--quiet")
        with open(f"{folder}/table.csv", newline="") as file:
            cells = [{key.split(" [")[0]: cell for key, cell in row.items()} for row in csv.DictReader(file)]
    rows = {}
    for cell in cells:
        numbers = {}
        for key, text in cell.items():
            try:
                numbers[key] = float(text)
            except ValueError:
                pass
        rows.setdefault(numbers["interference"], []).append(numbers)
    return [sorted(row, key=lambda cell: cell["slip_rate"]) for _, row in sorted(rows.items())]


# Markdown


def table(head, rows):
    lines = ["| " + " | ".join(str(cell) for cell in line) + " |" for line in [head, *rows]]
    lines.insert(1, "|" + "---|" * len(head))
    return "\n".join(lines) + "\n"


def minus(text):
    return text.replace("-", "−")


def signed(number, digits=1):
    text = f"{number:+.{digits}f}"
    return minus(text) if float(text) else f"{0:.{digits}f}"


def digits(number, count):
    """So many digits."""
    mantissa, _, exponent = f"{number:.{count}g}".partition("e")
    return minus(f"{mantissa}e{int(exponent)}" if exponent else mantissa)


def plain(number):
    """An interference or a slip rate: two digits without trailing zeros."""
    return f"{float(f'{number:.2g}'):g}"


def machine():
    model = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        found = re.search(r"^model name\s*:\s*(.*)$", info.read_text(), re.MULTILINE)
        model = found.group(1).strip() if found else model
    return f"Machine: {model}, {os.cpu_count()} cores, {platform.system()}; one thread.\n"


# Blocks: model


@block("kinematics", 5)
def kinematics():
    """Small against finite strain, 4340 steel over two contact radii without heat."""
    rows = []
    for interference in (20, 50, 100):
        runs = [
            asperity("run", SINGLE, loading__interference=interference, loading__slip_rate=0,
                     model__kinematics=strain, numerics__elements_per_radius=8, numerics__sectors=4)
            for strain in ("small", "finite")
        ]  # fmt: skip
        change = [100 * (value(runs[1], name) / value(runs[0], name) - 1) for name in ("mu", "P", "area")]
        rows.append([interference, f"{value(runs[0], 'mu'):.4f}", f"{value(runs[1], 'mu'):.4f}"]
                    + [f"{signed(percent)} %" for percent in change])  # fmt: skip
    head = [r"$\omega_0/\omega_c$", r"$\mu$, small", r"$\mu$, finite", r"change of $\mu$", "of $P$", "of $A$"]
    return table(head, rows)


@block("transition", 1)
def transition():
    """Static friction of 4340 steel without heat beside the elastic limit."""
    rows = []
    for line in example("elastic_to_plastic").splitlines():
        numbers = re.findall(r"\d+\.\d+", line)
        if len(numbers) == 6:
            omega, friction, doubt, limit, load, area = numbers
            rows.append([plain(float(omega)), f"{friction} ± {doubt}", limit, load, area])
    head = [r"$\omega_0/\omega_c$", r"$\mu_s$", r"elastic limit $\sqrt{3}/(2 C \sqrt{\omega^\ast})$",
            "$P/P_0$", "$A/A_0$"]  # fmt: skip
    return table(head, rows)


@block("metals", 2)
def metals():
    """The shipped tables without heat: static friction, and load and area after the slide."""
    rows = []
    for name in METALS:
        cells = [row[0] for row in shipped(name)]
        static = [f"{cells[i]['mu_static']:.3f} ± {cells[i]['mu_static_error']:.3f}" for i in (0, 2, 4, 7)]
        ratio = lambda cell, quantity: f"{cell[quantity] / cell[quantity + '_press']:.3f}"
        rows.append([name, *static, ratio(cells[4], "P"), ratio(cells[7], "P"), ratio(cells[4], "area")])
    at = [plain(cells[i]["interference"]) for i in (0, 2, 4, 7)]
    head = ["table", *[rf"$\mu_s$ at ${omega}\omega_c$" for omega in at], rf"$P/P_0$ at ${at[2]}\omega_c$",
            rf"at ${at[3]}\omega_c$", rf"$A/A_0$ at ${at[2]}\omega_c$"]  # fmt: skip
    return table(head, rows)


@block("rate", 2)
def rate():
    """The shipped tables: what the slip rate changes."""
    rows = []
    for name in METALS:
        line = [name]
        for i in (0, 4, 7):
            cells = shipped(name)[i]
            for quantity in ("mu_static", "mu", "P"):
                line.append(f"{signed(100 * (cells[-1][quantity] / cells[0][quantity] - 1))} %")
        rows.append(line)
        omegas = [plain(row[0]["interference"]) for row in shipped(name)]
    names = (r"\mu_s", r"\mu", "P")
    head = ["table"] + [rf"${quantity}$ at ${omegas[i]}\omega_c$" for i in (0, 4, 7) for quantity in names]
    return table(head, rows)


@block("no-end-state", 240)
def no_end_state():
    """Body and interface of equal strength, from the example of that name."""
    rows = []
    for line in example("no_end_state").splitlines()[2:]:
        name, numbers = line[:24].strip(), line[24:].split()
        if numbers:
            rows.append([name.replace("f_τ", r"$f_\tau$"), *[numbers[i] for i in (0, 1, 4, 5, 8, 9)]])
    head = ["case", "slip 0.02, 6 elements", "12", "slip 0.1, 6", "12", "slip 0.3, 6", "12"]
    return table(head, rows)


@block("robustness", 900, by_name=True)
def robustness():
    """How the robustness suite ends."""
    suite = asperity("verify", "--robustness")
    count = [[name, suite[name]] for name in ("solved", "refused", "failed")]
    refused = [[f"`{case['case']}`", case["reason"].replace("|", "/")]
               for case in suite["cases"] if case["verdict"] != "solved"]  # fmt: skip
    return table(["verdict", "cases"], count) + "\n" + table(["case that is not solved", "reason"], refused)


# Blocks: use

TABLE_QUANTITIES = ["mu_static", "mu", "Q", "P", "area", "G", "temperature_max"]


def table_info(name):
    return json.loads(call(programs / "asperity", "table", "info", name, "--json")[0])


def by_table(cell):
    """A row for each shipped table, `cell` of each quantity."""
    rows = []
    for name in METALS:
        quantities = table_info(name)["quantities"]
        rows.append([f"`{name}`", *[cell(quantities[quantity]) for quantity in TABLE_QUANTITIES]])
    return table(["table", *[f"`{quantity}`" for quantity in TABLE_QUANTITIES]], rows)


@block("cell-errors", 1)
def cell_errors():
    """Median and largest estimated error of the cells of the shipped tables, %."""
    return by_table(lambda q: f"{100 * q['relative_error_median']:.1f} / {100 * q['relative_error_largest']:.1f}")


@block("interpolation-errors", 1)
def interpolation_errors():
    """Largest error of interpolation of the shipped tables, %."""
    return by_table(lambda q: f"{100 * q['interpolation_error_largest']:.1f}")


@block("table-times", 1)
def table_times():
    """Wall time of the cells of the shipped tables, as they were computed."""
    rows = []
    for name in METALS:
        seconds = [cell["wall_time"] for row in shipped(name) for cell in row]
        rows.append((sum(seconds), f"`{name}`", len(seconds), max(seconds)))
    rows = [[name, f"{total:.0f}", f"{total / cells:.1f}", f"{longest:.0f}"] for total, name, cells, longest in sorted(rows)]
    return table(["table", "all cells (s)", "one cell (s)", "longest cell (s)"], rows)


@block("cell-times", 40, by_name=True)
def cell_times():
    """Processor time and memory of one cell."""
    rows = []
    for omega in (0.1, 1, 20, 100):
        run, seconds, memory = timed("run", SINGLE, threads=1, loading__interference=omega)
        account = run["account"]
        strain = "finite" if account["finite_strain"] else "small"
        rows.append([omega, account["elements_per_radius"], account["sectors"], strain, f"{seconds:.1f}", f"{memory:.0f}"])
    head = [r"$\omega_0/\omega_c$", "$n_c$", r"$N_\theta$", "strain", "processor time (s)", "memory (MB)"]
    return table(head, rows) + "\n" + machine()


# Blocks: method


@block("refinement", 37)
def refinement():
    """Three meshes of 4340 steel at 20 ω_c, and three numbers of angles."""
    slide = {"loading__slip_rate": 0, "loading__slip_distance": 0.2, "model__kinematics": "small"}
    rows = []
    for elements, sectors in ((8, 8), (16, 8), (32, 8), (8, 4), (8, 16)):
        run = asperity("run", SINGLE, **slide, numerics__elements_per_radius=elements, numerics__sectors=sectors)
        rows.append([elements, sectors, f"{value(run, 'P'):.3f}", f"{value(run, 'Q'):.4f}",
                     f"{1e9 * value(run, 'area'):.3f}", f"{value(run, 'mu_static'):.4f}", f"{value(run, 'mu'):.4f}",
                     f"{error(run, 'P'):.1f} %", f"{error(run, 'area'):.1f} %", f"{error(run, 'mu'):.1f} %"])  # fmt: skip
    head = ["$n_c$", r"$N_\theta$", "$P$ (N)", "$Q$ (N)", "$A$ (10⁻⁹ m²)", r"$\mu_s$", r"$\mu$",
            "estimated error of $P$", "of $A$", r"of $\mu$"]  # fmt: skip
    return table(head, rows)


@block("thermal-layer", 36)
def thermal_layer():
    """Titanium where the heated layer is thin."""
    rows = []
    for elements in (8, 12, 16):
        run = asperity("run", SINGLE, material__preset="titanium-6al4v", loading__interference=50,
                       loading__slip_rate=10, model__kinematics="small", numerics__elements_per_radius=elements,
                       numerics__sectors=4)  # fmt: skip
        rows.append([elements, f"{value(run, 'mu'):.4f}", f"{error(run, 'mu'):.1f} %",
                     f"{value(run, 'temperature_max'):.0f}"])  # fmt: skip
    return table(["$n_c$", r"$\mu$", "estimated error", r"$T_\text{max}$ (K)"], rows)


# Blocks: measured


@block("verify", 300, by_name=True)
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
            rows.append([
                row["quantity"].replace("|", "/").replace("*", "\\*"), digits(row["computed"], 5), digits(reference, 5),
                "" if row["unit"] == "1" else row["unit"], digits(scale * row["difference"], 2) + unit,
                digits(scale * row["allowed_difference"], 2) + unit,
                "–" if estimate is None else digits(scale * estimate, 2) + unit, f"[{sources.index(row['source']) + 1}]",
            ])  # fmt: skip
        head = ["quantity", "computed", "reference", "unit", "difference", "tolerance", "estimated error", "source"]
        text += table(head, rows) + "\n"
    rows = [row for group in report["groups"] for row in group["rows"]]
    text += f"{sum(row['passes'] for row in rows)} of {len(rows)} rows pass."
    if "stated_errors" in report:
        text += f" {report['stated_errors_that_cover']} of {report['stated_errors']} estimated errors cover the difference."
    return text + "\n"


@block("press", 15)
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
        [plain(parts[0][0])] + [pair(row, 2) for row in parts] + [pair(row, 5) for row in parts]
        for parts in zip(*fits)
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
        call(PEERS / "compare.py", "--asperity", programs / "asperity", "--codes", "asperity", "--rows", rows,
             4, 8, 16, 24)  # fmt: skip
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
        line = [PEER_NAMES[row["code"]], row["elements"], row.get("unknowns", "")]
        if row.get("finished"):
            line += [f"{row['P']:.4f}", f"{signed(100 * (row['P'] / limits['P'] - 1))} %", f"{row['Q']:.4f}",
                     f"{1e3 * row['A']:.3f}", f"{signed(100 * (row['A'] / limits['A'] - 1))} %"]  # fmt: skip
        else:
            line += ["–", "–", "–", "–", "–"]
            seconds = f"more than {seconds}"
        main = f"{row['seconds'] * row['main']:.2g}" if "main" in row else seconds
        lines.append([*line, seconds if "main" in row else "–", main, f"{row['memory']:.0f}"])
    head = ["code", "$n_c$", "unknowns", "$P$ (N)", "error", "$Q$ (N)", "$A$ (10⁻⁹ m²)", "error",
            "processor time with error estimates (s)", "without (s)", "MB"]  # fmt: skip
    return table(head, lines) + "\n" + machine().replace("Machine", "Machine of asperity")


@block("times", 30, by_name=True)
def times():
    """Processor time of single runs."""
    cases = [(f"default accuracy, {omega} ω_c", {"loading__interference": omega}) for omega in (1, 20, 100)]
    fine = {"numerics__elements_per_radius": 16, "numerics__sectors": 8}
    cases += [(f"16 elements, 8 angles, 20 ω_c, {strain} strain", {**fine, "model__kinematics": strain})
              for strain in ("small", "finite")]  # fmt: skip
    rows = []
    for name, settings in cases:
        run, seconds, memory = timed("run", SINGLE, threads=1, **settings)
        main = seconds * run["timings"]["main_run"] / run["timings"]["total"]
        account = run["account"]
        rows.append([name, account["elements_per_radius"], account["sectors"], account["unknowns"],
                     f"{main:.1f}", f"{seconds:.1f}", f"{memory:.0f}"])  # fmt: skip
    head = ["case", "$n_c$", r"$N_\theta$", "unknowns", "main run (s)", "with errors (s)", "MB"]
    return table(head, rows) + "\n" + machine()


@block("scaling", 60, by_name=True)
def scaling():
    """Processor time against resolution, from examples/scaling.py."""
    settings = ["model.kinematics=small", "numerics.sectors=4", "numerics.accuracy=0.1"]
    words = [word for setting in settings for word in ("--set", setting)]
    text = call(ROOT / "examples/scaling.py", "--asperity", programs / "asperity", *words)[0]
    text = text.replace("| n_c |", "| $n_c$ |")
    return text.rstrip("\n") + "\n\n" + machine()


@block("surface-times", 5, by_name=True)
def surface_times():
    """Processor time of a prediction for a rough surface."""
    scene, rows = "examples/scenes/ground-steel-surface.toml", []
    with tempfile.TemporaryDirectory() as folder:
        for name, words in (
            ("`predict`", ["predict"]),
            ("`sample`, 1000 asperities", ["sample", "--asperities", 1000]),
        ):
            command, *options = words
            line = [programs / "roughsurface", command, scene, "--table", "steel-4340", *options, "--quiet"]
            begun = time.monotonic()
            _, seconds, memory = call(*line, "-o", f"{folder}/out.nc")
            rows.append([name, f"{time.monotonic() - begun:.2f}", f"{seconds:.2f}", f"{memory:.0f}"])
    return table(["command", "wall time (s)", "processor time (s)", "MB"], rows) + "\n" + machine().replace(
        "; one thread", ""
    )


# Pages

MARKED = re.compile(r"(<!-- begin: ([\w-]+) -->\n).*?(<!-- end -->)", re.DOTALL)


def pages():
    found = [*sorted((ROOT / "docs/src").rglob("*.md")), ROOT / "README.md", PEERS / "README.md"]
    return {page: page.read_text() for page in found}


def check():
    """Blocks by page; ends with a message if pages and blocks do not agree."""
    places, wrong = {}, []
    for page, text in pages().items():
        name = page.relative_to(ROOT)
        if text.count("<!-- begin: ") != len(MARKED.findall(text)) or text.count("<!-- end -->") != text.count("<!-- begin: "):
            wrong.append(f"{name}: a block without end")
        for _, found, _ in MARKED.findall(text):
            places.setdefault(found, []).append(str(name))
    wrong += [f"{', '.join(places[name])}: no block is called {name}" for name in places if name not in blocks]
    wrong += [f"no page has the block {name}" for name in blocks if name not in places]
    if wrong:
        raise SystemExit("\n".join(wrong))
    return places


def write(name):
    function, _, _ = blocks[name]
    begun = os.times()
    content = function()
    for page, text in pages().items():
        changed = MARKED.sub(lambda m: f"{m[1]}\n{content}\n{m[3]}" if m[2] == name else m[0], text)
        if changed != text:
            page.write_text(changed)
    ended = os.times()
    spent = sum(ended[:4]) - sum(begun[:4])
    print(f"{name:<16} {spent:6.1f} s of processor time, {ended[4] - begun[4]:6.1f} s of wall time", flush=True)


def main():
    global programs
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("blocks", nargs="*", metavar="BLOCK", help="see --list")
    parser.add_argument("--programs", type=Path)
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--check", action="store_true")
    arguments = parser.parse_args()
    unknown = [name for name in arguments.blocks if name not in blocks]
    if unknown:
        parser.error(f"no block is called {', '.join(unknown)}; --list prints them")
    places = check()
    if arguments.list:
        for name, (function, seconds, by_name) in blocks.items():
            print(f"{name:<16} {seconds:4} s{', by name' if by_name else '':<9}  {', '.join(places[name])}")
    if arguments.list or arguments.check:
        return
    if arguments.programs:
        programs = arguments.programs.resolve()
    else:
        subprocess.run(["cargo", "build", "--locked", "--release", "--workspace", "--bins", "--examples"], cwd=ROOT,
                       check=True)  # fmt: skip
        programs = Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release"
    for name in arguments.blocks or [name for name, (_, _, by_name) in blocks.items() if not by_name]:
        write(name)


if __name__ == "__main__":
    sys.exit(main())
