"""Input in the forms that Python users have it, and the display of progress."""

from __future__ import annotations

import json
import os
import sys
import warnings
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Callable, Iterable, Iterator, Mapping, NamedTuple, Sequence, Union

import numpy as np

from . import _core
from ._errors import ModelWarning

Document = Union[Mapping[str, Any], str, "os.PathLike[str]"]
"""A dictionary of sections, TOML as text, or the path of a file."""

Numbers = Union[float, Sequence[float], np.ndarray, str]
"""A number, several, or a range as the programs take it: ``"1e5..1e7"``, ``"1e5..1e7:9"``, ``"1MPa"``."""

Progress = Union[bool, None, Callable[[str, float, str], Any]]
"""True for a bar, or a function of the stage, the share of it that is done (0 to 1) and a remark."""


class Given(NamedTuple):
    """A document for the compiled module: kind is "path", "text" or "dict", the latter two as TOML."""

    kind: str
    content: str

    @property
    def files(self) -> list[str]:
        return [self.content] if self.kind == "path" else []


def given(document: Document) -> Given:
    """The document with its kind; a text of several lines, or with a ``=`` and not the name of a TOML file, is TOML."""
    if isinstance(document, Mapping):
        return Given("dict", "".join(f"{_toml(key)} = {_toml(value)}\n" for key, value in _entries(document)))
    if isinstance(document, str) and ("\n" in document or "=" in document and not document.endswith(".toml")):
        return Given("text", document)
    if isinstance(document, (str, os.PathLike)):
        return Given("path", os.fspath(document))
    raise TypeError(f"a dict, TOML text or a path is needed, not {type(document).__name__}")


def overrides(values: Mapping[str, Any] | None) -> list[str]:
    """Values by key as the option ``--set`` of the programs takes them."""
    return [f"{key}={_toml(value)}" for key, value in _entries(values or {})]


def _entries(values: Mapping[str, Any]) -> list[tuple[str, Any]]:
    """TOML has no None: such keys are left out."""
    return [(key, value) for key, value in values.items() if value is not None]


def _toml(value: Any) -> str:
    """As a TOML value on one line."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, int):
        return str(value)
    if isinstance(value, float):
        # Python and TOML write numbers alike, inf and nan too.
        return repr(value)
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_toml(key)} = {_toml(item)}" for key, item in _entries(value)) + " }"
    if isinstance(value, Sequence):
        return "[" + ", ".join(map(_toml, value)) + "]"
    raise TypeError(f"{type(value).__name__} has no equivalent in TOML")


def numbers(values: Numbers | None) -> str | list[float] | None:
    if values is None or isinstance(values, str):
        return values
    return np.atleast_1d(np.asarray(values, dtype=float)).ravel().tolist()


def names(given: str | Iterable[str]) -> list[str]:
    return [given] if isinstance(given, str) else list(given)


def warn(sentences: Iterable[str]) -> None:
    """Limitations of a result, each as a :class:`ModelWarning` at the caller of the package."""
    for sentence in sentences:
        warnings.warn(sentence, ModelWarning, stacklevel=3)


def output(
    path: str | os.PathLike[str], inputs: Iterable[str | os.PathLike[str]] = (), *, is_table: bool = False
) -> Path:
    """The path, if a file can be written there without replacing one of the inputs or data; a table may replace others."""
    _core.check_output(os.fspath(path), [os.fspath(file) for file in inputs if os.path.exists(file)], is_table)
    return Path(path)


@contextmanager
def progress(asked: Progress) -> Iterator[Callable[[str, float, str], Any] | None]:
    """The function to be called with the progress: that of the user, or one that moves a bar of tqdm."""
    if asked is None or asked is False:
        yield None
    elif callable(asked):
        yield asked
    else:
        bar = _bar()
        try:
            yield bar.show
        finally:
            bar.close()


def _bar() -> Any:
    try:
        from tqdm.auto import tqdm
    except ImportError:
        return _Line()
    return _Bar(tqdm(total=100, unit="%", bar_format="{desc} {bar} {n:.0f} % {elapsed}{postfix}"))


class _Bar:
    def __init__(self, bar: Any):
        self.bar = bar

    def show(self, stage: str, done: float, remark: str) -> None:
        self.bar.set_description_str(stage, refresh=False)
        self.bar.set_postfix_str(remark, refresh=False)
        self.bar.n = 100 * done
        self.bar.refresh()

    def close(self) -> None:
        self.bar.close()


class _Line:
    """One line that is overwritten, where tqdm is not installed."""

    def show(self, stage: str, done: float, remark: str) -> None:
        print(f"\r{stage} {100 * done:3.0f} % {remark}\033[K", end="", file=sys.stderr, flush=True)

    def close(self) -> None:
        print(file=sys.stderr)
