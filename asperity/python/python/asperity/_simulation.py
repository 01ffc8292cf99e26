"""One asperity: simulation and tabulation."""

from __future__ import annotations

import os
import tempfile
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any, Mapping, Sequence

from . import _core
from ._input import Document, Progress, given, output as writable, overrides as laid_over, progress as shown, warn
from ._results import Drawn, Estimate, dataset
from ._tables import Table

if TYPE_CHECKING:
    import xarray


class Run(Drawn):
    """A press and slide of one asperity: result of :func:`simulate`.

    SI units; forces, areas and energies of the whole asperity.
    """

    def __init__(self, core: _core.Run, inputs: Sequence[str] = ()):
        self._core, self._inputs = core, inputs
        scalars = core.scalars()
        self.scalars: dict[str, Estimate] = {name: Estimate(x, dx, unit) for name, x, dx, unit, _ in scalars}
        """Scalars by name, such as ``scalars["mu"]``: value, error and unit."""
        self.meanings: dict[str, str] = {name: meaning for name, *_, meaning in scalars}
        """What each scalar is, in words."""

    def __getitem__(self, name: str) -> Estimate:
        return self.scalars[name]

    @property
    def scene(self) -> str:
        """The scene as TOML, with every default filled in."""
        return self._core.scene()

    @property
    def steady(self) -> bool:
        """Whether friction is steady at the end of the slide."""
        return self._core.steady()

    @property
    def inception(self) -> str:
        """The criterion by which sliding inception was found."""
        return self._core.inception()

    @property
    def notes(self) -> list[str]:
        """What the program chose, and why."""
        return self._core.notes()

    @property
    def incomplete(self) -> str | None:
        """Why the run ended before its end; None if it is complete."""
        return self._core.incomplete()

    @cached_property
    def dataset(self) -> "xarray.Dataset":
        """The content of ``run.nc``: histories over ``step_press`` and ``step``, scalars ``NAME_end`` or ``NAME`` with
        ``_error``, fields over (``snapshot``, ``theta``, ``r``). Units are in the attributes. Needs xarray."""
        return dataset(self.save)

    def to_xarray(self) -> "xarray.Dataset":
        """The same as :attr:`dataset`."""
        return self.dataset

    def save(self, path: str | os.PathLike[str]) -> None:
        """Writes ``run.nc``, the file of ``asperity run``."""
        self._core.write(writable(path, self._inputs), "asperity.simulate (Python)")

    def save_body(self, directory: str | os.PathLike[str], whole: bool = False) -> Path:
        """Writes displacement, stress, plastic strain and temperature of the body for ParaView.

        Args:
            directory: made if it does not exist.
            whole: the whole body, not only the half that is simulated.

        Returns:
            The collection to be opened, ``body.pvd``. The run needs ``simulate(..., body=True)``.
        """
        return self._core.write_body(Path(directory), whole)

    def __repr__(self) -> str:
        head = f"<asperity.Run{'' if self.incomplete is None else ', incomplete: ' + self.incomplete}>"
        return "\n".join([head, *(f"  {name:18}{estimate}" for name, estimate in self.scalars.items())])


def simulate(
    scene: Document,
    *,
    overrides: Mapping[str, Any] | None = None,
    fields_at: Sequence[float] = (),
    body: bool = False,
    threads: int | None = None,
    progress: Progress = None,
) -> Run:
    """Presses one asperity and slides it: ``asperity run``.

    Args:
        scene: a dictionary of sections, TOML as text, or the path of a scene file; the chapter "Scene" of the book has
            the keys.
        overrides: values laid over the scene by key, such as ``{"loading.slip_rate": 10.0}``.
        fields_at: slips in contact radii, summed over the steps of a programme, at which fields are recorded in addition
            to the start of the slide, half slip, full slip and the end of each step.
        body: record the fields of the body for :meth:`Run.save_body`.
        threads: number of threads, by default that of processors. Results do not depend on it.
        progress: True for a bar, or a function of stage, share done (0 to 1) and a remark.

    Returns:
        A :class:`Run`: scalars with errors, histories, fields, figures, equal to those of the program bit for bit.

    Raises:
        InputError: the scene is not valid; ``file``, ``key`` and ``reason`` say why.
        RunError: it did not converge; ``run`` has the steps before.
    """
    with shown(progress) as show:
        document = given(scene)
        core = _core.simulate(document, laid_over(overrides), [float(s) for s in fields_at], body, threads, show)
    warn(core.warnings())
    return Run(core, document.files)


def tabulate(
    request: Document,
    output: str | os.PathLike[str] | None = None,
    *,
    overrides: Mapping[str, Any] | None = None,
    jobs: int | None = None,
    resume: bool = False,
    progress: Progress = None,
) -> Table:
    """Simulates a grid of interferences and slip rates: ``asperity tabulate``.

    An interrupt (Ctrl-C, or that of a notebook) stops it; finished cells are kept in the journal ``OUTPUT.part``, from
    which the same call with ``resume=True`` continues.

    Args:
        request: a dictionary, TOML or a path: a scene with a section ``[table]``; the chapter "Request" of the book has
            the keys.
        output: file of the table. Without one the table is in memory only, and an interrupt loses it.
        overrides: values laid over the request by key.
        jobs: number of threads, by default that of processors. Results do not depend on it.
        resume: continue an interrupted tabulation; a complete table is read as it is.
        progress: True for a bar, or a function of stage, share done (0 to 1) and a remark.

    Returns:
        The :class:`Table`; cells that failed are in its ``failures``.

    Raises:
        InputError: the request is not valid, or the journal is of another one.
        RunError: the table cannot be written.
    """
    with tempfile.TemporaryDirectory(prefix="asperity-") as folder, shown(progress) as show:
        place = Path(folder) / "table.nc" if output is None else writable(output, is_table=True)
        try:
            core = _core.tabulate(given(request), place, laid_over(overrides), jobs, resume, show)
        except KeyboardInterrupt:
            if output is not None:
                kept = f"finished cells are kept in {place}.part; to continue, call with resume=True"
                raise KeyboardInterrupt(kept) from None
            raise
    warn(core.warnings())
    warn(f"failed: {at}: {reason}" for at, reason in core.failures())
    return Table(core, None if output is None else os.fspath(output))
