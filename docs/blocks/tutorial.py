"""The session of the tutorial: each block is the output of the command above it on the page."""

import functools
import subprocess
import sys
import tempfile
from pathlib import Path

from .common import ROOT, block, program

CHARACTERIZE = "characterize lapped-face.txt --pixel 2um --unit um -o face.toml"
PREDICT = "predict face.toml --table steel-4340 --contact-life steady --pressure 1e6 --slip-rate 0.1..10:5 -o friction.nc"
SAMPLE = "sample face.toml --table steel-4340 --contact-life steady --asperities 20000 --seed 1 -o mc.nc"
CUTOFF = (
    "predict lapped-face.txt --pixel 2um --unit um --material steel-4340 --contact-life steady --pressure 1e6 --slip-rate 1"
    " -o cutoff.nc"
)


@functools.cache
def folder():
    """A folder with the map; it lasts as long as this process."""
    made = tempfile.TemporaryDirectory()
    subprocess.run([sys.executable, ROOT / "examples/lapped_face.py", "lapped-face.txt"], cwd=made.name, check=True)
    return made


def output(command):
    """What `roughsurface COMMAND` prints, with its warnings."""
    words = [program("roughsurface"), *command.split()]
    run = subprocess.run(words, cwd=folder().name, check=True, text=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    return f"```text\n{run.stderr}{run.stdout.rstrip()}\n```"


def of_surface(command):
    """The same for a command that reads the surface file."""
    if not Path(folder().name, "face.toml").exists():
        output(CHARACTERIZE)
    return output(command)


@block("tutorial-surface", 1)
def surface():
    return output(CHARACTERIZE)


@block("tutorial-friction", 1)
def friction():
    return of_surface(PREDICT)


@block("tutorial-cutoff", 1)
def cutoff():
    text = output(CUTOFF)
    return "```text\n" + text[text.index("Influence of the cut-off") :]


@block("tutorial-scatter", 35)
def scatter():
    return of_surface(SAMPLE)
