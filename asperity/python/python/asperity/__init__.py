"""Friction of rough surfaces from thermomechanical simulation of one asperity.

``simulate`` presses and slides one asperity, ``tabulate`` a grid of them, ``table`` interpolates, ``characterize`` finds the
summits of a measured topography, ``predict`` and ``sample`` give the friction of a surface, ``export`` writes it for other programs. SI
units and kelvin throughout; every number has an error estimate. Results are those of the programs ``asperity`` and ``roughsurface``, bit for bit.

    >>> import asperity
    >>> steel = asperity.table("steel-4340")
    >>> round(steel.at("mu", interference=40.0, slip_rate=1.0).value, 1)
    0.2
"""

from ._core import __version__
from ._errors import AsperityError, InputError, ModelWarning, RunError
from ._export import export
from ._results import Estimate, Figure
from ._simulation import Run, simulate, tabulate
from ._surfaces import Characterization, Friction, Samples, characterize, predict, sample
from ._tables import CLOSED_FORMS, QUANTITIES, SHIPPED, Table, table

__all__ = [
    "AsperityError",
    "CLOSED_FORMS",
    "Characterization",
    "Estimate",
    "Figure",
    "Friction",
    "InputError",
    "ModelWarning",
    "QUANTITIES",
    "Run",
    "RunError",
    "SHIPPED",
    "Samples",
    "Table",
    "__version__",
    "characterize",
    "export",
    "predict",
    "sample",
    "simulate",
    "table",
    "tabulate",
]
