"""What the tests share: coarse scenes, the programs, comparison of files."""

import os
import subprocess
from pathlib import Path

import pytest
import xarray

ROOT = Path(__file__).resolve().parents[3]

SCENE = {
    "material": {"preset": "copper"},
    "asperity": {"radius": 1e-3},
    "loading": {"interference": 5, "slip_rate": 1.0, "slip_distance": 0.05},
    "numerics": {"elements_per_radius": 4, "sectors": 4},
}

REQUEST = {
    "material": {"preset": "copper"},
    "asperity": {"radius": 1e-3},
    "loading": {"slip_distance": 0.02},
    "numerics": {"elements_per_radius": 4, "sectors": 4},
    "table": {"interference": [2, 4], "slip_rate": [0, 1]},
}

SURFACE = """
[surface]
asperity_density = 1e8
asperity_radius = 1e-3
heights = { distribution = "gaussian", std = 0.4e-6 }
[query]
pressure = [1e6, 1e7]
slip_rate = [0.1, 1.0]
"""

#: Of the machine and the command, not of the result.
NOT_COMPARED = ["wall_time", "time_spent"]


def toml(document: dict) -> str:
    """A file of one level of sections."""
    import json

    sections = document.items()
    keys = lambda section: "".join(f"{key} = {json.dumps(value)}\n" for key, value in section.items())
    return "".join(f"[{name}]\n{keys(section)}" for name, section in sections)


def run(*arguments: object) -> str:
    """Runs one of the programs, which are in the path."""
    command = [os.fspath(a) if isinstance(a, os.PathLike) else str(a) for a in arguments]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def content(path: Path) -> xarray.Dataset:
    dataset = xarray.load_dataset(path, decode_times=False).drop_vars(NOT_COMPARED, errors="ignore")
    # The checksum of a table includes its history and times.
    for name in ("history", "checksum"):
        dataset.attrs.pop(name, None)
    return dataset


def assert_same(one: Path, other: Path) -> None:
    """Equal in every variable, attribute and bit."""
    xarray.testing.assert_identical(content(one), content(other))


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    return tmp_path
