"""How does a boundary error decay? Measured sensitivities beside promised ones."""

from .finite import Moved, moved
from .fit import Fit, fit
from .found import Found, replay
from .measure import Measurement, measure
from .promised import Promised
from .search import search
from .searched import Searched, searched
from .sensitivity import Sensitivity, sensitivity
from .slices import Slices
from .spec import Spec
from .sweep import sweep
from .target import Target
from .units import Runner
from .worst import Worst, worst

__all__ = [
    "Fit",
    "Found",
    "Measurement",
    "Moved",
    "Promised",
    "Runner",
    "Searched",
    "Sensitivity",
    "Slices",
    "Spec",
    "Target",
    "Worst",
    "fit",
    "measure",
    "moved",
    "replay",
    "search",
    "searched",
    "sensitivity",
    "sweep",
    "worst",
]
