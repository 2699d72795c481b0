"""Feasible sets: one kind a file. A file here is found by lying here, also in problem files."""

from typing import cast

from ..kind import kinds_of
from .ball import Ball
from .box import Box
from .constraints import Constraints
from .convex import Convex
from .everywhere import Everywhere
from .feasible import FeasibleSet
from .functions import Functions


def kinds() -> dict[str, type[FeasibleSet]]:
    """Return all kinds of feasible sets, by their names in files."""
    return cast("dict[str, type[FeasibleSet]]", kinds_of(__name__))


__all__ = [
    "Ball",
    "Box",
    "Constraints",
    "Convex",
    "Everywhere",
    "FeasibleSet",
    "Functions",
    "kinds",
]
