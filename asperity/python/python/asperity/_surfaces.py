"""Rough surfaces: measured topography, friction, finite surfaces."""

from __future__ import annotations

import json
import os
from functools import cached_property
from pathlib import Path
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any, Iterable, Mapping

import numpy as np

from . import _core
from ._errors import InputError
from ._input import Document, Numbers, Progress, given, names, numbers, output, overrides as laid_over, progress as shown, warn
from ._results import Drawn, Result, dataset
from ._tables import Table, named

if TYPE_CHECKING:
    import xarray

_METRES = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "µm": 1e-6, "μm": 1e-6, "nm": 1e-9}


class Characterization(Drawn):
    """Summits of a measured topography: result of :func:`characterize`."""

    def __init__(self, core: _core.Characterization, inputs: Iterable[str | os.PathLike[str]] = ()):
        self._core, self._inputs = core, inputs
        self.summary: dict[str, Any] = json.loads(core.json())
        """Moments, summits, cut-offs and slopes, in SI units: the JSON of ``roughsurface characterize``."""

    @property
    def surface(self) -> str:
        """The surface file (TOML): summits of the moments, with Gaussian heights."""
        return self._core.surface_file(None)

    def on(self, other: Characterization) -> Characterization:
        """Both rough faces of a contact: ``--other-face`` of ``roughsurface``.

        The summits are those of the sum of the heights, which slides on a smooth flat. Both must have been characterised
        with the same ``cutoff``.

        Raises:
            InputError: the cut-offs differ.
        """
        both = Characterization(self._core.on(other._core), [*self._inputs, *other._inputs])
        # Those of each face have been warned of.
        warn(said for said in both.warnings if said not in self.warnings and not said.startswith("other face: "))
        return both

    def save(self, path: str | os.PathLike[str], summits: str = "moments") -> None:
        """Writes the surface file.

        Args:
            summits: ``"moments"``, or ``"found"`` for the summits found one by one, whose heights are written to a file
                ``.heights.txt`` beside it.
        """
        path = output(path, self._inputs)
        if summits not in ("moments", "found"):
            raise ValueError(f'summits = {summits!r}: must be "moments" or "found"')
        heights = None
        if summits == "found":
            reason = None
            if self.summary["points"][0] == 1:
                reason = "peaks of a profile are no summits"
            elif "two_faces" in self.summary:
                reason = "they are of one face; of two they follow from the moments"
            if reason:
                raise InputError(f'summits="found": {reason}', None, "summits", reason)
            heights = output(path.with_suffix(".heights.txt"), self._inputs)
            _core.write_bytes(heights, self._core.heights_file().encode())
        _core.write_bytes(path, self._core.surface_file(heights and heights.name).encode())

    def __str__(self) -> str:
        return self._core.text()

    __repr__ = __str__


def characterize(
    topography: Any,
    *,
    pixel: float | tuple[float, float] | None = None,
    unit: str = "m",
    periodic: bool | None = None,
    cutoff: float | None = None,
    detrend: str | None = None,
    window: str | None = None,
) -> Characterization:
    """Summits of a measured topography: ``roughsurface characterize``.

    Args:
        topography: an array of heights, shape (rows, columns) or (points,); an object of SurfaceTopography (anything with
            ``heights()`` and ``pixel_size``); or the path of a file. NaN and masked points have no height.
        pixel: distance of the points, m, or (between rows, between points of a row). For an object its ``pixel_size``.
        unit: of the heights of an array: ``"m"``, ``"mm"``, ``"um"`` or ``"nm"``; ``pixel`` is in m. For an object its
            ``unit``, of heights and pixels.
        periodic: the topography continues at its other side. For an object its ``is_periodic``.
        cutoff: short-wavelength cut-off (Gaussian, ISO 16610), m; by default where the data end to be reliable.
        detrend: ``"mean"``, ``"plane"`` or ``"quadratic"``; by default the plane, of a periodic topography the mean.
        window: ``"hann"`` (default) or ``"none"``.

    Returns:
        A :class:`Characterization`, to be given to :func:`predict` and :func:`sample`.

    Raises:
        InputError: the topography or an argument is not usable.
    """
    if isinstance(topography, (str, os.PathLike)):
        treatment = (bool(periodic), cutoff, detrend, window)
        scale = None if unit == "m" else _metres(unit)
        core = _core.characterize_file(Path(topography), pixel, scale, treatment)
    else:
        heights, pixels, whole = _heights(topography, pixel, unit)
        treatment = (bool(whole if periodic is None else periodic), cutoff, detrend, window)
        name = getattr(topography, "name", None) or "array"
        core = _core.characterize_heights(str(name), heights, pixels, treatment)
    warn(core.warnings())
    return Characterization(core, [topography] if isinstance(topography, (str, os.PathLike)) else ())


def _refused(key: str, reason: str) -> InputError:
    """The exception for an argument."""
    return InputError(f"{key}: {reason}", None, key, reason)


def _metres(unit: str) -> float:
    if unit not in _METRES:
        raise _refused("unit", f"{unit!r} must be one of {', '.join(_METRES)}")
    return _METRES[unit]


def _heights(topography: Any, pixel: Any, unit: str) -> tuple[np.ndarray, tuple[float, float], bool]:
    """Heights in m as rows, their distances in m, and whether the topography is periodic."""
    periodic = False
    if hasattr(topography, "heights"):
        scale = _metres(getattr(topography, "unit", None) or unit)
        if pixel is None and not hasattr(topography, "pixel_size"):
            uneven = "its points are not at equal distances; to_uniform() of SurfaceTopography makes them so"
            raise _refused("topography", uneven)
        if pixel is None:
            pixel = tuple(scale * float(step) for step in np.atleast_1d(topography.pixel_size))
        periodic = bool(getattr(topography, "is_periodic", False))
        topography = topography.heights()
    else:
        scale = _metres(unit)
    if isinstance(topography, np.ma.MaskedArray):
        topography = topography.astype(float).filled(np.nan)
    heights = scale * np.asarray(topography, dtype=float)
    if pixel is None:
        raise _refused("pixel", "is needed: the distance of the points in m")
    if heights.ndim not in (1, 2):
        raise _refused("topography", f"has {heights.ndim} dimensions; a map has two, a profile one")
    steps = np.broadcast_to(np.asarray(pixel, dtype=float), (2,))
    return np.ascontiguousarray(np.atleast_2d(heights)), (float(steps[0]), float(steps[1])), periodic


class _Predicted(Result):
    """Result with a netCDF file."""

    _command: str

    def __init__(self, core: _core.Friction | _core.Samples, inputs: Iterable[str | os.PathLike[str]] = ()):
        self._core, self._inputs = core, [*inputs, *core.inputs()]
        self.summary: dict[str, Any] = json.loads(core.json())
        """Every number with value, error and unit: the JSON of the program."""

    def to_xarray(self) -> "xarray.Dataset":
        """The same as ``dataset``."""
        return self.dataset

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes the netCDF file of the program."""
        self._core.write(output(path, self._inputs), self._command)

    def __str__(self) -> str:
        return self._core.text()

    __repr__ = __str__


class Friction(_Predicted, Drawn):
    """Friction of a rough surface over pressure and slip rate: result of :func:`predict`."""

    _command = "asperity.predict (Python)"

    @cached_property
    def dataset(self) -> "xarray.Dataset":
        """The content of ``friction.nc``: ``mu_static``, ``mu`` and others with ``_error`` over (``pressure``,
        ``slip_rate``), flash-heating parameters over ``pressure``. Units are in the attributes. Needs xarray."""
        return dataset(self.save)

    def report(self, path: str | os.PathLike[str]) -> None:
        """Writes the report as one HTML file."""
        _core.write_bytes(output(path, self._inputs), self._core.report(self._command).encode())


class Samples(_Predicted):
    """Friction of finite surfaces drawn at random: result of :func:`sample`."""

    _command = "asperity.sample (Python)"

    @cached_property
    def dataset(self) -> "xarray.Dataset":
        """The content of ``mc.nc``, the file of ``roughsurface sample``: ``mu`` and others over (``pressure``, ``slip_rate``,
        ``realization``), with their statistics. Needs xarray."""
        return dataset(self.save)


def _files(surface: Any, table: Any) -> list[str | os.PathLike[str]]:
    """The files that the arguments of a prediction are read from."""
    of_surface = surface._inputs if isinstance(surface, Characterization) else given(surface).files
    name = table.name if isinstance(table, Table) else table
    return [*of_surface, *([] if name is None else [name])]


def _question(surface: Any, table: str, query: Mapping[str, Any], overrides: Any, **more: Any) -> SimpleNamespace:
    measured = surface._core if isinstance(surface, Characterization) else None
    document = None if measured is not None else given(surface)
    values = {key: numbers(asked) for key, asked in query.items()}
    return SimpleNamespace(
        surface=document, measured=measured, table=table, overrides=laid_over(overrides), **values, **more
    )


def predict(
    surface: Document | Characterization,
    table: Table | str | os.PathLike[str],
    *,
    pressure: Numbers | None = None,
    separation: Numbers | None = None,
    slip_rate: Numbers | None = None,
    overrides: Mapping[str, Any] | None = None,
    compare: str | Iterable[str] = (),
    allow_missing: bool = False,
    extrapolate: bool = False,
    tolerance: float | None = None,
    threads: int | None = None,
    progress: Progress = None,
) -> Friction:
    """Static and sliding friction of a rough surface: ``roughsurface predict``.

    Args:
        surface: a dictionary, TOML or the path of a surface file (the chapter "Surface" of the book has the keys), or a
            :class:`Characterization`.
        table: a :class:`Table`, a file, a shipped name, or ``"model:NAME"`` for a closed form.
        pressure: nominal pressures, Pa, in place of those of the surface.
        separation: in place of pressures: distances of the flat from the reference plane of the heights, m.
        slip_rate: m/s.
        overrides: values laid over the surface by key, such as ``{"query.hold": "separation"}``.
        compare: closed forms to compare with (:data:`CLOSED_FORMS`), or ``"all"``.
        allow_missing: interpolate around cells of the table that failed.
        extrapolate: keep mean pressure and friction of contacts too large for their asperities instead of refusing.
        tolerance: relative error of integrals and pressures, 1e-6 by default.
        threads: number of threads, by default that of processors. Results do not depend on it.
        progress: True for a bar, or a function of stage, share done (0 to 1) and a remark.

    Returns:
        A :class:`Friction`, equal to the result of the program bit for bit.

    Raises:
        InputError: surface, table or query are not valid, or the table does not cover the query.
        RunError: a separation was not found.
    """
    models = list(_core.CLOSED_FORMS) if "all" in names(compare) else names(compare)
    if unknown := [model for model in models if model not in _core.CLOSED_FORMS]:
        raise _refused("compare", f"{unknown[0]!r} must be among {', '.join(_core.CLOSED_FORMS)}, or all")
    with named(table) as name, shown(progress) as show:
        query = {"pressure": pressure, "separation": separation, "slip_rate": slip_rate}
        question = _question(
            surface, name, query, overrides, allow_missing=allow_missing, extrapolate=extrapolate, tolerance=tolerance
        )
        core = _core.predict(question, models, threads, show)
    warn(core.warnings())
    return Friction(core, _files(surface, table))


def sample(
    surface: Document | Characterization,
    table: Table | str | os.PathLike[str],
    *,
    asperities: int,
    realizations: int = 200,
    seed: int = 1,
    slip: float | None = None,
    pressure: Numbers | None = None,
    separation: Numbers | None = None,
    slip_rate: Numbers | None = None,
    overrides: Mapping[str, Any] | None = None,
    allow_missing: bool = False,
    extrapolate: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Samples:
    """Friction of finite surfaces with heights drawn at random: ``roughsurface sample``.

    Args:
        asperities: asperities of one surface, in contact or not; at least 2.
        realizations: surfaces to draw; at least 2.
        seed: the same seed gives the same surfaces.
        slip: at which friction is read, m; by default where :func:`predict` ends.

    The other arguments are those of :func:`predict`.

    Returns:
        :class:`Samples`, equal to the result of the program bit for bit.
    """
    for key, count in (("asperities", asperities), ("realizations", realizations)):
        if count < 2:
            raise InputError(f"{key} = {count}: must be at least 2", None, key, "must be at least 2")
    with named(table) as name, shown(progress) as show:
        query = {"pressure": pressure, "separation": separation, "slip_rate": slip_rate}
        question = _question(
            surface, name, query, overrides, allow_missing=allow_missing, extrapolate=extrapolate, tolerance=None
        )
        core = _core.sample(question, (asperities, realizations, seed), slip, threads, show)
    warn(core.warnings())
    return Samples(core, _files(surface, table))
