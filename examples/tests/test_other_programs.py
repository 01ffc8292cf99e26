"""The commands on the first screen of the README, and the lines for other programs in the book."""

import re
import subprocess
from pathlib import Path

import pytest
import scipy.io
import xarray

ROOT = Path(__file__).resolve().parents[2]
COARSE = ["numerics.elements_per_radius=4", "numerics.sectors=4", "loading.slip_distance=0.1"]


def blocks(page):
    """Language and text of the code blocks of a page."""
    text = (ROOT / page).read_text(encoding="utf-8")
    return re.findall(r"^```(sh|python)\n(.*?)^```$", text, flags=re.M | re.S)


def shell(command):
    done = subprocess.run(["bash", "-euo", "pipefail", "-c", command], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture
def folder(tmp_path, monkeypatch):
    """A folder in which the paths of the repository are valid."""
    for name in ("examples", "roughsurface"):
        (tmp_path / name).symlink_to(ROOT / name)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_lines_for_other_programs(folder, capsys):
    coarse = " ".join(f"--set {value}" for value in COARSE)
    shell(f"asperity run examples/scenes/single-asperity.toml -o run.nc --vtu fields --quiet {coarse}")
    shell("roughsurface predict examples/scenes/ground-steel-surface.toml --table steel-4340 -o friction.nc --quiet")
    names: dict = {}
    printed = ""
    for language, code in blocks("docs/src/other-programs.md"):
        if language == "sh":
            printed += shell(code)
        else:
            exec(compile(code, "other-programs.md", "exec"), names)
    printed += capsys.readouterr().out
    for expected in ("von_mises_stress", "summits found", "pressure"):
        assert expected in printed, expected
    assert "asperity_density" in (folder / "surface.toml").read_text()
    assert xarray.load_dataset("table.nc").status.values.max() == 0
    friction = xarray.load_dataset("friction.nc")
    assert (scipy.io.loadmat("friction.mat")["mu"][:, :, 0] == friction.mu.values).all()


def test_commands_of_the_first_screen(folder):
    language, commands = blocks("README.md")[0]
    assert language == "sh" and [line.split()[0] for line in commands.splitlines()] == ["asperity", "roughsurface"]
    shell(commands)
    for name in re.findall(r"[\w-]+\.(?:nc|png)", commands):
        assert (folder / name).stat().st_size > 1000, name
