"""Friction for other programs."""

from __future__ import annotations

import io
import json
import os
import tempfile
from contextlib import ExitStack
from pathlib import Path
from typing import Any, Iterable

import numpy as np

from . import _core
from ._input import output
from ._surfaces import Friction

_LAW = ("mu_0", "mu_inf", "V_star", "n")


def export(
    friction: Friction | str | os.PathLike[str] | Iterable[Friction | str | os.PathLike[str]],
    path: str | os.PathLike[str],
    *,
    law: bool = False,
) -> None:
    """Writes friction for other programs: ``roughsurface export``, and ``.mat`` for MATLAB and Octave.

    Args:
        friction: a :class:`Friction` over pressures or its file; several that have an initial temperature each.
        path: file to write. Its extension decides on the format: ``.inp`` for Abaqus, ``.txt`` for COMSOL, ``.csv`` for
            tables, ``.json`` for the fitted law, ``.mat`` with scipy.
        law: values of the fitted rate law, ten slip rates a decade, in place of the values computed.

    A ``.mat`` file has ``mu`` and ``mu_error`` (1) over pressure, slip rate and temperature, the axes ``pressure`` (Pa),
    ``slip_rate`` (m/s) and ``temperature`` (K; NaN with a closed form), and of the fitted law ``mu_0``, ``mu_inf`` (1),
    ``V_star`` (m/s) and ``n`` (1) over pressure and temperature, NaN where none is fitted:
    ``mu_inf + (mu_0 - mu_inf)/(1 + (V/V_star)^n)``.

    Raises:
        InputError: the extension is not known, or the results do not fit together.
    """
    given = [friction] if isinstance(friction, (Friction, str, os.PathLike)) else list(friction)
    path = output(path, [one for one in given if not isinstance(one, Friction)])
    with ExitStack() as stack:
        folder = Path(stack.enter_context(tempfile.TemporaryDirectory(prefix="asperity-")))
        files = [_file(one, folder / f"friction-{number}.nc") for number, one in enumerate(given)]
        table = _core.friction_table(files, law)
    _core.write_bytes(path, _mat(table) if path.suffix.lower() == ".mat" else table.text(path).encode())


def _file(friction: Friction | str | os.PathLike[str], path: Path) -> Path:
    if not isinstance(friction, Friction):
        return Path(friction)
    friction.save(path)
    return path


def _mat(table: Any) -> bytes:
    """The file in memory, so that an error of writing is that of the caller."""
    try:
        from scipy.io import savemat
    except ImportError as error:
        raise ImportError("a .mat file needs scipy: pip install 'asperity[matlab]'") from error
    pressures, slip_rates, temperatures = map(np.array, table.axes())
    shape = (len(temperatures), len(pressures), len(slip_rates))
    mu, mu_error = (np.moveaxis(np.reshape(values, shape), 0, -1) for values in table.mu())
    laws = json.loads(table.text("laws.json"))["laws"]
    # None is NaN.
    column = lambda key: np.array([law.get(key, {}).get("value") for law in laws], dtype=float)
    content = {key: column(key).reshape(shape[:2]).T for key in _LAW}
    content |= {"pressure": pressures[:, None], "slip_rate": slip_rates[None, :], "temperature": temperatures[:, None]}
    file = io.BytesIO()
    savemat(file, content | {"mu": mu, "mu_error": mu_error}, do_compression=True)
    return file.getvalue()
