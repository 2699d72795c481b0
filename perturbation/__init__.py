"""How does a boundary error decay? Measured sensitivities beside promised ones."""

from .finite import Moved, moved
from .fit import Fit, fit
from .measure import Measurement, measure
from .promised import Promised
from .sensitivity import Sensitivity, sensitivity
from .slices import Slices
from .spec import Spec
from .units import Runner

__all__ = [
    "Fit",
    "Measurement",
    "Moved",
    "Promised",
    "Runner",
    "Sensitivity",
    "Slices",
    "Spec",
    "fit",
    "measure",
    "moved",
    "sensitivity",
]
