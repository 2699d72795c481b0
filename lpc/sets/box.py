"""Boxes ``lower <= y <= upper``."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...graphs import InputError
from ..arrays import Floats, Ints, at, family, fits
from .feasible import FeasibleSet


@dataclass(frozen=True, eq=False)
class Box(FeasibleSet):
    """``lower <= y <= upper``, entry by entry; bounds may be infinite.

    Parameters
    ----------
    lower, upper : array_like, shape ([[T,] N,] n)
        Leading axes (steps, agents) are left out, or of length 1, where nothing changes. A single
        number stands for all n entries.

    Raises
    ------
    InputError
        If a box is empty or a bound is NaN.
    """

    lower: Floats
    upper: Floats
    kind = "box"
    projectable = True

    def __init__(self, lower: ArrayLike, upper: ArrayLike) -> None:
        low, high = (
            family(np.atleast_1d(np.asarray(b)), 1, f"{name} bound of a box", infinite=True)
            for b, name in ((lower, "lower"), (upper, "upper"))
        )
        try:
            empty = np.asarray((low > high) | (low == np.inf) | (high == -np.inf))
        except ValueError as error:
            raise InputError(f"box: bounds of shapes {low.shape} and {high.shape}") from error
        if empty.any():
            t, v, j = np.argwhere(empty)[0]
            a, b = (np.broadcast_to(x, empty.shape)[t, v, j] for x in (low, high))
            raise InputError(
                f"box at step {t + 1}, agent {v}: no number is between {a:g} and {b:g}; "
                "lower <= upper is needed"
            )
        object.__setattr__(self, "lower", low)
        object.__setattr__(self, "upper", high)

    def violation(self, t: Ints, v: Ints, y: Floats) -> Floats:
        """Return the largest overstepping of a bound, shape (m,)."""
        low, high = at(self.lower, t, v), at(self.upper, t, v)
        found: Floats = np.maximum(low - y, y - high).max(axis=1, initial=-np.inf)
        return found

    def project(self, t: Ints, v: Ints, y: Floats) -> Floats:
        """Return the points clipped, shape (m, n)."""
        return np.minimum(np.maximum(y, at(self.lower, t, v)), at(self.upper, t, v))

    def constraints(self, t: Ints, v: Ints, y: Floats) -> tuple[Floats, Floats, Floats]:
        """Return ``lower - y`` and ``y - upper`` with their derivatives, p = 2 n."""
        m, n = y.shape
        g = np.concatenate([at(self.lower, t, v) - y, y - at(self.upper, t, v)], axis=1)
        there = np.isfinite(g)
        signs = np.concatenate([-np.eye(n), np.eye(n)])
        return g, np.where(there[:, :, None], signs, 0.0), np.zeros((m, 2 * n, n, n))

    def interior(self, t: Ints, v: Ints) -> Floats:
        """Return the middle of every box, or 1 within its only finite bound, shape (m, n)."""
        low, high = np.broadcast_arrays(at(self.lower, t, v), at(self.upper, t, v))
        thin = np.argwhere(low >= high)
        if len(thin):
            at_t, at_v = np.broadcast_to(t, len(low))[thin[0, 0]], v[thin[0, 0]]
            raise InputError(f"box at step {at_t}, agent {at_v}: its interior is empty")
        with np.errstate(invalid="ignore"):
            middle = np.where(np.isfinite(low) & np.isfinite(high), low + (high - low) / 2, 0.0)
        middle = np.where(np.isfinite(low) & ~np.isfinite(high), low + 1.0, middle)
        found: Floats = np.where(~np.isfinite(low) & np.isfinite(high), high - 1.0, middle)
        return found

    def check(self, H: int, N: int, n: int) -> None:
        """Raise `InputError` unless shapes fit H steps, N agents and n entries."""
        for name in ("lower", "upper"):
            bound: Floats = getattr(self, name)
            fits(bound, H, N, f"{name} bound of the box")
            if bound.shape[-1] not in (1, n):
                raise InputError(f"{name} bound of the box: {bound.shape[-1]} entries, not n = {n}")
