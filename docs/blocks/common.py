"""What the blocks have in common: their list, the programs that they run, and Markdown."""

import csv
import json
import os
import platform
import re
import subprocess
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent.parent
SINGLE = "examples/scenes/single-asperity.toml"
METALS = ["steel-4340", "steel-1045", "steel-304", "aluminium-6061", "copper", "titanium-6al4v"]
TABLES = [name + kind for kind in ("", "-rigid", "-rate") for name in METALS]
blocks = {}


def block(name, seconds, by_name=False):
    """Registers a function that returns the Markdown of a block; `seconds` of processor time."""

    def register(function):
        blocks[name] = (function, seconds, by_name)
        return function

    return register


# Programs


def program(name):
    """The path of a program; `ASPERITY_PROGRAMS` is the folder."""
    return Path(os.environ["ASPERITY_PROGRAMS"]) / name


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
        line = [program("asperity"), command, *words, "--json", "--quiet"]
        if command == "run":
            line += ["-o", f"{folder}/run.nc", "--timings"]
        line += overrides(f"{key.replace('__', '.')}={value}" for key, value in settings.items())
        text, seconds, memory = call(*line, threads=threads)
        return json.loads(text), seconds, memory


def value(run, name):
    return run["summary"][name]["value"]


def error(run, name):
    """Estimated error relative to the value, %."""
    return 100 * run["summary"][name]["error"] / abs(value(run, name))


def example(name):
    return call(program("examples") / name)[0]


def overrides(settings):
    """Options of a command for settings `section.key=value`."""
    return [word for setting in settings for word in ("--set", setting)]


def exported(name):
    """Cells of a table, as dictionaries of text."""
    with tempfile.TemporaryDirectory() as folder:
        call(program("asperity"), "table", "export", name, "-o", f"{folder}/table.csv", "--quiet")
        with open(f"{folder}/table.csv", newline="") as file:
            return [{key.split(" [")[0]: cell for key, cell in row.items()} for row in csv.DictReader(file)]


def shipped(name):
    """Cells of a shipped table: a list of rows by interference, of dictionaries by slip rate."""
    rows = {}
    for cell in exported(name):
        numbers = {}
        for key, text in cell.items():
            try:
                numbers[key] = float(text)
            except ValueError:
                pass
        rows.setdefault(numbers["interference"], []).append(numbers)
    return [sorted(row, key=lambda cell: cell["slip_rate"]) for _, row in sorted(rows.items())]


def table_info(name):
    """JSON of `asperity table info`."""
    return json.loads(call(program("asperity"), "table", "info", name, "--json")[0])


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
    """An interference or a slip rate: three digits without trailing zeros."""
    return f"{float(f'{number:.3g}'):g}"


def machine():
    model = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        found = re.search(r"^model name\s*:\s*(.*)$", info.read_text(), re.MULTILINE)
        model = found.group(1).strip() if found else model
    return f"Machine: {model}, {os.cpu_count()} cores, {platform.system()}; one thread.\n"
