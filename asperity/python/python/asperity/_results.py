"""What results have in common: files, datasets, figures."""

from __future__ import annotations

import os
import tempfile
from pathlib import Path
from typing import TYPE_CHECKING, Any, Callable, Iterable, NamedTuple

from ._input import names, output

if TYPE_CHECKING:
    import xarray


class Estimate(NamedTuple):
    """A number with its error: ``value ± error`` in ``unit``. Both may be arrays of one shape."""

    value: Any
    """The number, or an array."""
    error: Any
    """Its absolute error, the half-width of its 95 % interval."""
    unit: str
    """In UDUNITS notation; ``"1"`` for a pure number."""

    def __str__(self) -> str:
        unit = "" if self.unit == "1" else f" {self.unit}"
        if isinstance(self.value, float):
            return f"{self.value:.5g} ± {self.error:.2g}{unit}"
        return f"{self.value} ± {self.error}{unit}"


def dataset(write: Callable[[Path], Any]) -> "xarray.Dataset":
    """The file that ``write`` makes, as a dataset in memory."""
    try:
        import xarray
    except ImportError as error:
        raise ImportError("datasets need xarray and netCDF4: pip install 'asperity[datasets]'") from error
    with tempfile.TemporaryDirectory(prefix="asperity-") as folder:
        path = Path(folder) / "result.nc"
        write(path)
        return xarray.load_dataset(path, decode_times=False)


class Figure:
    """A figure of the project as SVG, which notebooks show."""

    def __init__(self, svg: str):
        self.svg = svg

    def _repr_svg_(self) -> str:
        return self.svg

    def __repr__(self) -> str:
        return f"<asperity.Figure, {len(self.svg)} characters of SVG>"


def drawn(figure: Any, path: Path | None) -> Figure:
    """A figure of the compiled module, also written to ``path`` if there is one."""
    if path is not None:
        figure.save(path)
    return Figure(figure.svg())


class Result:
    """A result of the compiled module."""

    _core: Any
    _inputs: Iterable[str | os.PathLike[str]] = ()

    @property
    def warnings(self) -> list[str]:
        """Limitations of the result."""
        return self._core.warnings()


class Drawn(Result):
    """A result with a figure."""

    def plot(self, path: str | os.PathLike[str] | None = None, panels: str | Iterable[str] = ()) -> Figure:
        """The figure that the programs draw.

        Args:
            path: file to draw it to as well, ``.svg``, ``.png`` or ``.pdf``.
            panels: names of panels; all by default.
        """
        place = None if path is None else output(path, self._inputs)
        return drawn(self._core.figure(names(panels)), place)

    def _repr_svg_(self) -> str:
        return self._core.figure([]).svg()
