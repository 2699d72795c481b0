"""Projections of many points of one cohort, their bounds looked up once."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from .arrays import Floats, Ints, at
from .sets import Box, FeasibleSet

Chosen = Ints | NDArray[np.bool_]


class Projection(Protocol):
    """The projection of A points of ``m n`` numbers onto products of m sets of R^n."""

    def __call__(self, w: Floats, out: Floats) -> None:
        """Write the nearest points to `out`."""
        ...

    def some(self, kept: Chosen) -> Projection:
        """Return the projection of some of the points."""
        ...


@dataclass(frozen=True, eq=False)
class Clip:
    """Onto boxes: bounds of shape (A, m n)."""

    lower: Floats
    upper: Floats

    def __call__(self, w: Floats, out: Floats) -> None:
        """Clip."""
        np.clip(w, self.lower, self.upper, out=out)

    def some(self, kept: Chosen) -> Clip:
        """Return the projection of some of the points."""
        return Clip(self.lower[kept], self.upper[kept])


@dataclass(frozen=True, eq=False)
class Onto:
    """Onto any projectable sets: steps and agents of shape (A, m)."""

    feasible: FeasibleSet
    t: Ints
    v: Ints

    def __call__(self, w: Floats, out: Floats) -> None:
        """Project action by action."""
        A, m = self.t.shape
        found = self.feasible.project(self.t.ravel(), self.v.ravel(), w.reshape(A * m, -1))
        out[...] = found.reshape(w.shape)

    def some(self, kept: Chosen) -> Onto:
        """Return the projection of some of the points."""
        return Onto(self.feasible, self.t[kept], self.v[kept])


def projection(feasible: FeasibleSet, t: Ints, v: Ints, n: int) -> Projection:
    """Return the projection for actions of steps t and agents v, shape (A, m), in R^n."""
    if not isinstance(feasible, Box):
        return Onto(feasible, t, v)
    lower, upper = (
        np.broadcast_to(at(bound, t.ravel(), v.ravel()), (t.size, n)).reshape(len(t), -1)
        for bound in (feasible.lower, feasible.upper)
    )
    return Clip(lower, upper)
