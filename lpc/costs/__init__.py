"""Costs: one kind a file. A file here is found by lying here, also in problem files."""

from typing import cast

from ..kind import kinds_of
from .callables import Callables
from .cost import Cost, Curvature, Source
from .hyperbola import Hyperbola
from .log_cosh import LogCosh
from .mixture import Mixture
from .probe import Probed, probe
from .quadratic import Quadratic
from .ridge import Ridge
from .softplus import Softplus
from .symbolic import Symbolic


def kinds() -> dict[str, type[Cost]]:
    """Return all kinds of costs, by their names in files."""
    return cast("dict[str, type[Cost]]", kinds_of(__name__))


__all__ = [
    "Callables",
    "Cost",
    "Curvature",
    "Hyperbola",
    "LogCosh",
    "Mixture",
    "Probed",
    "Quadratic",
    "Ridge",
    "Softplus",
    "Source",
    "Symbolic",
    "kinds",
    "probe",
]
