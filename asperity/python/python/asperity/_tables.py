"""Tables of the single-asperity response, and interpolation in them."""

from __future__ import annotations

import os
import tempfile
from contextlib import contextmanager
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Iterable, Iterator

import numpy as np

from . import _core
from ._input import names, output
from ._results import Drawn, Estimate, Figure, dataset, drawn

if TYPE_CHECKING:
    import xarray
    from numpy.typing import ArrayLike

SHIPPED: tuple[str, ...] = tuple(_core.SHIPPED)
"""Names of the shipped tables."""

CLOSED_FORMS: tuple[str, ...] = tuple(_core.CLOSED_FORMS)
"""Names of the closed forms of the literature, for ``table="model:NAME"``."""

_UNITS = {name: unit for name, unit, _ in _core.Table.quantities()}

QUANTITIES: dict[str, str] = {name: f"{meaning} [{unit}]" for name, unit, meaning in _core.Table.quantities()}
"""Quantities of a table by name: meaning and unit."""


class Table(Drawn):
    """Response of one asperity over interference, slip rate and slip; see :func:`table`."""

    def __init__(self, core: _core.Table, name: str | None):
        self._core = core
        self.name = name
        """File or shipped name; None for a table in memory."""

    def at(
        self,
        quantity: str,
        interference: ArrayLike,
        slip_rate: ArrayLike,
        slip: ArrayLike | None = None,
        *,
        temperature: ArrayLike | None = None,
        radius: ArrayLike | None = None,
        outside: str = "raise",
    ) -> Estimate:
        """Interpolates a quantity, with its error; the arguments are broadcast against each other.

        Args:
            quantity: one of :data:`QUANTITIES`; with ``slip`` one of ``mu``, ``Q``, ``P``, ``area``,
                ``temperature_max``.
            interference: in units of that of first yield.
            slip_rate: m/s, at ``radius``.
            slip: m. Without it, the value that the table has of the whole slide.
            temperature: initial temperature, K; needed by a table of several.
            radius: m; that of the table by default. Values are scaled, with ``slip_rate * radius`` kept.
            outside: ``"raise"``, or ``"nan"`` for NaN where the table has no answer.

        Returns:
            Value and absolute error as arrays of the broadcast shape (as numbers, if all are numbers), and the unit.
            The error is that of the runs and of interpolation.

        Raises:
            InputError: no such quantity, or outside the table; ``key`` is the argument.
        """
        if outside not in ("raise", "nan"):
            raise ValueError(f'outside = {outside!r}: must be "raise" or "nan"')
        asked = [interference, slip_rate, np.nan if slip is None else slip]
        asked += [np.nan if x is None else x for x in (temperature, radius)]
        columns = np.broadcast_arrays(*(np.asarray(x, dtype=float) for x in asked))
        shape = columns[0].shape
        flat = [np.ascontiguousarray(column).ravel() for column in columns]
        keys = ("interference", "slip_rate", "slip", "temperature", "radius")
        states = SimpleNamespace(**dict(zip(keys, flat)))
        if slip is None:
            states.slip = None
        found = self._core.look_up(quantity, states, outside == "nan")
        value, error = (column.reshape(shape) for column in found)
        if shape == ():
            value, error = float(value), float(error)
        return Estimate(value, error, _UNITS[quantity])

    @property
    def axes(self) -> dict[str, np.ndarray]:
        """Grid of the table: ``interference`` in units of that of first yield, ``slip_rate`` in m/s, ``slip`` in contact
        radii, ``temperature`` in K."""
        keys = ("interference", "slip_rate", "slip", "temperature")
        return {key: np.array(axis) for key, axis in zip(keys, self._core.axes())}

    @property
    def range(self) -> dict[str, tuple[float, float]]:
        """First and last value of each axis. Below the first interference the table continues as an elastic sphere, above
        the last one towards the fully plastic limit, with errors that grow, up to :meth:`contact_limit`."""
        return {key: (float(axis[0]), float(axis[-1])) for key, axis in self.axes.items()}

    def contact_limit(self, temperature: float | None = None) -> float:
        """Interference, in units of that of first yield, at which the contact radius is 0.4 radii and the model ends."""
        return self._core.contact_limit(temperature)

    @property
    def constants(self) -> dict[str, float]:
        """Radius (m), interference of first yield (m), contact modulus (Pa), Poisson's ratio, yield strength (Pa), heat
        partition and gap conductance (W/m²/K), at the lowest temperature."""
        return self._core.constants()

    @property
    def provenance(self) -> dict[str, str]:
        """Title, program, history, fingerprint of the physics, request (TOML) and comment."""
        return self._core.provenance()

    @property
    def failures(self) -> list[tuple[str, str]]:
        """Cells that failed, and why."""
        return self._core.failures()

    def to_xarray(self) -> "xarray.Dataset":
        """The content of ``table.nc``: every quantity with its ``_error`` over (``interference``, ``slip_rate``), each
        ``_history`` also over ``slip``. Units are in the attributes. Needs xarray."""
        return dataset(self.save)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes ``table.nc``."""
        self._core.write(output(path, is_table=True))

    def plot(
        self,
        path: str | os.PathLike[str] | None = None,
        panels: str | Iterable[str] = (),
        temperature: float | None = None,
    ) -> Figure:
        """The figure that the program draws, at one initial temperature (K)."""
        place = None if path is None else output(path)
        return drawn(self._core.figure(names(panels), temperature), place)

    def _repr_svg_(self) -> str:
        return self._core.figure([], float(self.axes["temperature"][0])).svg()

    def __repr__(self) -> str:
        spans = ", ".join(f"{key} {low:g} to {high:g}" for key, (low, high) in self.range.items())
        return f"<asperity.Table {self.name or 'in memory'}: {spans}>"


def table(name: str | os.PathLike[str]) -> Table:
    """A table: one that comes with the package (:data:`SHIPPED`), or that of a file.

    Raises:
        InputError: there is no such table, or the file is damaged.
    """
    name = os.fspath(name)
    return Table(_core.load(name), name)


@contextmanager
def named(given: Table | str | os.PathLike[str]) -> Iterator[str]:
    """The table as the programs are given it; one in memory is written to a temporary file."""
    if not isinstance(given, Table):
        yield os.fspath(given)
    elif given.name is not None:
        yield given.name
    else:
        with tempfile.TemporaryDirectory(prefix="asperity-") as folder:
            path = Path(folder) / "table.nc"
            given.save(path)
            yield os.fspath(path)
