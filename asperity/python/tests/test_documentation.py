"""Every example in Python of the README, of the book and of the package runs."""

import doctest
import re
import warnings

import pytest
from conftest import ROOT

import asperity

PAGES = ["README.md", "docs/src/python.md"]


def blocks(text: str) -> list[str]:
    return re.findall(r"^```python\n(.*?)^```$", text, flags=re.M | re.S)


@pytest.mark.parametrize("page", PAGES)
def test_examples_run(page, folder):
    (folder / "examples").symlink_to(ROOT / "examples")
    found = blocks((ROOT / page).read_text(encoding="utf-8"))
    assert found
    names: dict = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", asperity.ModelWarning)
        for block in found:
            exec(compile(block, page, "exec"), names)


def test_doctests():
    assert doctest.testmod(asperity).attempted > 0 == doctest.testmod(asperity).failed


def test_everything_is_documented():
    for name in asperity.__all__:
        item = getattr(asperity, name)
        if callable(item):
            assert item.__doc__, name
