"""Balls ``|y - centre| <= radius``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...graphs import InputError
from ..arrays import Floats, Ints, at, family, fits
from .feasible import FeasibleSet


@dataclass(frozen=True, eq=False)
class Ball(FeasibleSet):
    """``|y - centre| <= radius`` in the Euclidean norm.

    Parameters
    ----------
    centre : array_like, shape ([[T,] N,] n)
        A single number stands for all n entries.
    radius : array_like, shape ([[T,] N])
        At least 0; infinite where there is no constraint.

    Raises
    ------
    InputError
        If a centre is not finite, or a radius is negative or NaN.
    """

    centre: Floats
    radius: Floats
    kind = "ball"
    projectable = True

    def __init__(self, centre: ArrayLike, radius: ArrayLike) -> None:
        middle = family(np.atleast_1d(np.asarray(centre)), 1, "centre of a ball")
        size = family(radius, 0, "radius of a ball", infinite=True)
        bad = np.argwhere(size < 0)
        if len(bad):
            t, v = bad[0]
            raise InputError(
                f"radius of a ball at step {t + 1}, agent {v}: {size[t, v]:g}; >= 0 is needed"
            )
        object.__setattr__(self, "centre", middle)
        object.__setattr__(self, "radius", size)

    def violation(self, t: Ints, v: Ints, y: Floats) -> Floats:
        """Return the distance from the centre minus the radius, shape (m,)."""
        return _length(y - at(self.centre, t, v)) - at(self.radius, t, v)

    def project(self, t: Ints, v: Ints, y: Floats) -> Floats:
        """Return the points pulled straight towards the centre, shape (m, n)."""
        centre, radius = at(self.centre, t, v), at(self.radius, t, v)
        off = y - centre
        away = _length(off)
        outside = away > radius
        share = np.where(outside, radius, 0.0) / np.where(outside, away, 1.0)
        return np.where(outside[:, None], centre + share[:, None] * off, y)

    def constraints(self, t: Ints, v: Ints, y: Floats) -> tuple[Floats, Floats, Floats]:
        """Return ``|y - centre|^2 - radius^2`` with its derivatives, p = 1."""
        n = y.shape[1]
        off, radius = y - at(self.centre, t, v), at(self.radius, t, v)
        away = _length(off)
        there = np.isfinite(radius)[:, None]
        g = np.where(there, ((away - radius) * (away + radius))[:, None], -np.inf)
        slope = np.where(there, 2 * off, 0.0)[:, None, :]
        bend = np.where(there[:, :, None, None], 2 * np.eye(n), 0.0)
        return g, slope, bend

    def interior(self, t: Ints, v: Ints) -> Floats:
        """Return the centres, shape (m, n)."""
        radius = np.broadcast_to(at(self.radius, t, v), len(t))
        thin = np.flatnonzero(~(radius > 0))
        if len(thin):
            raise InputError(
                f"ball at step {t[thin[0]]}, agent {v[thin[0]]}: its interior is empty"
            )
        return np.array(at(self.centre, t, v))

    def check(self, H: int, N: int, n: int) -> None:
        """Raise `InputError` unless shapes fit H steps, N agents and n entries."""
        fits(self.centre, H, N, "centre of the ball")
        fits(self.radius, H, N, "radius of the ball")
        if self.centre.shape[-1] not in (1, n):
            raise InputError(f"centre of the ball: {self.centre.shape[-1]} entries, not n = {n}")


def _length(y: Floats) -> Floats:
    """Return the Euclidean norms of rows, without overflow."""
    found: Floats = np.hypot.reduce(np.abs(y), axis=1)
    return found
