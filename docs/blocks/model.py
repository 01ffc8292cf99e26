"""Blocks of the model and of the shipped tables."""

import re

from .common import (
    METALS,
    SINGLE,
    TABLES,
    asperity,
    block,
    error,
    example,
    machine,
    plain,
    shipped,
    signed,
    table,
    table_info,
    timed,
    value,
)


@block("kinematics", 10)
def kinematics():
    """Small against finite strain, 4340 steel over two contact radii without heat."""
    rows = []
    for interference in (20, 50, 100):
        runs = [
            asperity(
                "run",
                SINGLE,
                loading__interference=interference,
                loading__slip_rate=0,
                model__kinematics=strain,
                numerics__elements_per_radius=8,
                numerics__sectors=4,
            )
            for strain in ("small", "finite")
        ]
        change = [100 * (value(runs[1], name) / value(runs[0], name) - 1) for name in ("mu", "P", "area")]
        rows.append(
            [interference, f"{value(runs[0], 'mu'):.4f}", f"{value(runs[1], 'mu'):.4f}"]
            + [f"{signed(percent)} %" for percent in change]
        )
    head = [r"$\omega_0/\omega_c$", r"$\mu$, small", r"$\mu$, finite", r"change of $\mu$", "of $P$", "of $A$"]
    return table(head, rows)


@block("transition", 1)
def transition():
    """Static friction of 4340 steel without heat beside the elastic limit."""
    rows = []
    for line in example("elastic_to_plastic").splitlines():
        numbers = re.findall(r"\d+\.\d+", line)
        if len(numbers) == 6:
            omega, friction, error, limit, load, area = numbers
            rows.append([plain(float(omega)), f"{friction} ± {error}", limit, load, area])
    head = [
        r"$\omega_0/\omega_c$",
        r"$\mu_s$",
        r"elastic limit $\sqrt{3}/(2 C \sqrt{\omega^\ast})$",
        "$P/P_0$",
        "$A/A_0$",
    ]
    return table(head, rows)


@block("slip-rate", 1)
def slip_rate():
    """What the slip rate changes of 4340 steel, and the energy of inception."""
    rows = []
    for line in example("slip_rate_effects").splitlines():
        numbers = re.findall(r"[+-]?\d+\.\d+", line)
        if len(numbers) == 12:
            omega, fixed, fixed_error, fall, fall_error, *shares, like, like_error, ratio, ratio_error = numbers
            rows.append(
                [plain(float(omega)), f"{signed(100 * float(fixed))} ± {100 * float(fixed_error):.1f} %"]
                + [f"{100 * float(fall):.1f} ± {100 * float(fall_error):.1f} %"]
                + [f"{float(share):.0f} %".replace("-", "−") for share in shares]
                + [f"{100 * float(like):.1f} ± {100 * float(like_error):.1f} %"]
                + [f"{ratio} ± {ratio_error}"]
            )
    head = [
        r"$\omega_0/\omega_c$",
        r"change of $\mu_s$",
        r"fall $\ln \mu(0)/\mu(V)$ at 10 m/s",
        "strength",
        "area",
        "load",
        "fall on a like body",
        "$G/G_{IIc}$",
    ]
    return table(head, rows)


@block("metals", 2)
def metals():
    """The shipped tables without heat: static friction, and load and area after the slide."""
    rows, omegas = [], (0.1, 1.2, 4, 32)
    for name in METALS:
        cells = [row_at(name, omega)[0] for omega in omegas]
        static = [f"{cell['mu_static']:.3f} ± {cell['mu_static_error']:.3f}" for cell in cells]
        ratio = lambda cell, quantity: f"{cell[quantity] / cell[quantity + '_press']:.3f}"
        rows.append([name, *static, ratio(cells[2], "P"), ratio(cells[3], "P"), ratio(cells[2], "area")])
    head = [
        "table",
        *[rf"$\mu_s$ at ${omega}\omega_c$" for omega in omegas],
        rf"$P/P_0$ at ${omegas[2]}\omega_c$",
        rf"at ${omegas[3]}\omega_c$",
        rf"$A/A_0$ at ${omegas[2]}\omega_c$",
    ]
    return table(head, rows)


def row_at(name, omega):
    """Cells of a shipped table at an interference."""
    return next(row for row in shipped(name) if row[0]["interference"] == omega)


@block("rate", 2)
def rate():
    """The shipped tables without rate law: what the slip rate changes from 0 on."""
    rows, omegas = [], (0.1, 4, 32)
    for name in [name for name in TABLES if not name.endswith("-rate")]:
        line = [name]
        for omega in omegas:
            cells = row_at(name, omega)
            for quantity in ("mu_static", "mu", "P"):
                line.append(f"{signed(100 * (cells[-1][quantity] / cells[0][quantity] - 1))} %")
        rows.append(line)
    names = (r"\mu_s", r"\mu", "P")
    head = ["table"] + [rf"${quantity}$ at ${omega}\omega_c$" for omega in omegas for quantity in names]
    return table(head, rows)


@block("rate-law", 30)
def rate_law():
    """Friction at 20 ω_c on a like body, without and with the rate law of the presets."""
    rows = []
    for metal in METALS:
        rate = {"material__rate": '{ law = "johnson-cook" }'}
        row = [metal]
        results = []
        press = {"loading__press_slip_distance": 1}
        for radius, settings in ((1e-3, {}), (1e-3, rate), (1e-4, rate), (1e-4, rate | press)):
            run = asperity(
                "run",
                SINGLE,
                material__preset=metal,
                counterface__preset=metal,
                counterface__elastic="false",
                asperity__radius=radius,
                loading__interference=20,
                loading__slip_rate=1e-3 / radius,
                **settings,
            )
            results.append([value(run, "mu_static"), value(run, "mu")])
        for quantity in (0, 1):
            without, *with_law = (result[quantity] for result in results)
            row += [f"{without:.3f}"] + [f"{signed(100 * (mu / without - 1))} %" for mu in with_law]
        rows.append(row)
    head = ["metal"]
    for name in (r"$\mu_s$", r"$\mu$"):
        head += [f"{name}, no rate law", "with, $R$ = 1 mm", "0.1 mm", "0.1 mm, press with rate"]
    return table(head, rows)


@block("junction-strength", 130)
def junction_strength():
    """Copper with the strength of the virgin and of the hardened metal at the interface."""
    rows = []
    for omega in (1, 10, 100):
        runs = [
            asperity(
                "run",
                SINGLE,
                material__preset="copper",
                loading__interference=omega,
                loading__slip_rate=1,
                interface__strength=strength,
            )
            for strength in ("initial", "current")
        ]
        shown = [
            f"{value(run, name):.3f} ± {value(run, name) * error(run, name) / 100:.3f}"
            for name in ("mu_static", "mu")
            for run in runs
        ]
        rows.append([omega, *shown])
    names = [f"{name}, {metal}" for name in (r"$\mu_s$", r"$\mu$") for metal in ("virgin", "hardened")]
    return table([r"$\omega_0/\omega_c$", *names], rows)


@block("rate-steps", 4)
def rate_steps():
    """A contact through steps of the slip rate, a hold and a reversal."""
    rows, case = [], ""
    for line in example("rate_steps").splitlines():
        name, numbers = line[:25].strip(), line[25:].split()
        if len(numbers) == 5:
            before, direct, end, slip, temperature = (number.replace("-", "−") for number in numbers)
            held = name.startswith("hold")
            name = name.replace("a0", "$a_0$").replace("-", "−")
            rows.append([case, name, before, "" if held else direct, end, "" if held else slip, temperature])
        elif not line.startswith("step"):
            case = line.replace("C =", "$C_r$ =")
    head = ["case", "step", "before", "all slips", "end", "half slip", "temperature"]
    return table(head, rows)


@block("rate-step-superposition", 20)
def rate_step_superposition():
    """A contact after a step of the slip rate: a run, and the superposition of the slides of a table."""
    rows = []
    head, *lines = example("rate_step_superposition").splitlines()
    slips = re.findall(r"x = (\S+)", head)
    for line in lines:
        case, numbers = line.split(" a₀", 1)
        metal, omega, rates = case.split(None, 2)
        _, slow, _, fast, _, _, before = rates.split()
        *values, worst = numbers.split()
        pairs = [f"{a} / {b}" for a, b in zip(values[::2], values[1::2])]
        cells = [f"{q}; {p}" for q, p in zip(pairs[::2], pairs[1::2])]
        rows.append([metal, omega, f"{slow} to {fast}", before, *cells, worst])
    head = ["metal", r"$\omega_0/\omega_c$", "m/s", "slip before, $a_0$"]
    return table([*head, *[f"$x = {slip} a_0$" for slip in slips], "difference over change"], rows)


@block("no-end-state", 130)
def no_end_state():
    """Body and interface of equal strength, from the example of that name."""
    rows = []
    for line in example("no_end_state").splitlines()[2:]:
        name, numbers = line[:24].strip(), line[24:].split()
        if numbers:
            rows.append([name.replace("f_τ", r"$f_\tau$"), *[numbers[i] for i in (0, 1, 4, 5, 8, 9)]])
    head = ["case", "slip 0.02, 6 elements", "12", "slip 0.1, 6", "12", "slip 0.3, 6", "12"]
    return table(head, rows)


@block("robustness", 600, by_name=True)
def robustness():
    """How the robustness suite ends."""
    suite = asperity("verify", "--robustness")
    count = [[name, suite[name]] for name in ("solved", "refused", "failed")]
    refused = [
        [f"`{case['case']}`", case["reason"].replace("|", "/")]
        for case in suite["cases"]
        if case["verdict"] != "solved"
    ]
    return table(["verdict", "cases"], count) + "\n" + table(["case that is not solved", "reason"], refused)


TABLE_QUANTITIES = ["mu_static", "mu", "mu_steady", "Q", "P", "area", "G", "G_weakening", "temperature_max"]


def percent(share):
    """In per cent."""
    if share > 1:
        return "> 100"
    return f"{100 * share:.1f}" if share < 0.2 else f"{100 * share:.0f}"


def by_table(cell):
    """A row for each shipped table, `cell` of each quantity."""
    rows = []
    for name in TABLES:
        quantities = table_info(name)["quantities"]
        rows.append([f"`{name}`", *[cell(quantities[quantity]) for quantity in TABLE_QUANTITIES]])
    return table(["table", *[f"`{quantity}`" for quantity in TABLE_QUANTITIES]], rows)


@block("cell-errors", 1)
def cell_errors():
    """Median and largest estimated error of the cells of the shipped tables, %."""
    return by_table(lambda q: f"{percent(q['relative_error_median'])} / {percent(q['relative_error_largest'])}")


@block("between-errors", 1)
def between_errors():
    """Median and largest error of the shipped tables half-way between their points, %."""
    return by_table(lambda q: f"{percent(q['between_error_median'])} / {percent(q['between_error_largest'])}")


@block("table-times", 1)
def table_times():
    """Wall time of the cells of the shipped tables, as they were computed."""
    rows = []
    for name in TABLES:
        seconds = [cell["wall_time"] for row in shipped(name) for cell in row]
        rows.append((sum(seconds), f"`{name}`", len(seconds), max(seconds)))
    rows = [
        [name, f"{total:.0f}", f"{total / cells:.1f}", f"{longest:.0f}"] for total, name, cells, longest in sorted(rows)
    ]
    return table(["table", "all cells (s)", "one cell (s)", "longest cell (s)"], rows)


@block("cell-times", 5, by_name=True)
def cell_times():
    """Processor time and memory of one cell."""
    rows = []
    for omega in (0.1, 1, 20, 100):
        run, seconds, memory = timed("run", SINGLE, threads=1, loading__interference=omega)
        account = run["account"]
        strain = "finite" if account["finite_strain"] else "small"
        rows.append(
            [omega, account["elements_per_radius"], account["sectors"], strain, f"{seconds:.1f}", f"{memory:.0f}"]
        )
    head = [r"$\omega_0/\omega_c$", "$n_c$", r"$N_\theta$", "strain", "processor time (s)", "memory (MB)"]
    return table(head, rows) + "\n" + machine()
