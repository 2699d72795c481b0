"""All of R^n."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..arrays import Floats, Ints
from .feasible import FeasibleSet


@dataclass(frozen=True)
class Everywhere(FeasibleSet):
    """No constraints: every set is all of R^n."""

    kind = "everywhere"
    projectable = True
    everywhere = True

    def violation(self, t: Ints, v: Ints, y: Floats) -> Floats:
        """Return zeros."""
        return np.zeros(len(y))

    def project(self, t: Ints, v: Ints, y: Floats) -> Floats:
        """Return the points themselves."""
        return y

    def constraints(self, t: Ints, v: Ints, y: Floats) -> tuple[Floats, Floats, Floats]:
        """Return no constraints."""
        m, n = y.shape
        return np.zeros((m, 0)), np.zeros((m, 0, n)), np.zeros((m, 0, n, n))

    def interior(self, t: Ints, v: Ints) -> Floats:
        """Return the origin, as one number that broadcasts: shape (m, 1)."""
        return np.zeros((len(t), 1))

    def check(self, H: int, N: int, n: int) -> None:
        """Accept any sizes."""
