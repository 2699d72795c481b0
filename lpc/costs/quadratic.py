"""Quadratic costs: ``(w - c)' P (w - c) / 2 + b`` with blocks as arrays."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ...graphs import InputError
from ..arrays import Floats, Ints, at, family, fits
from .cost import Cost, Curvature


@dataclass(frozen=True, eq=False)
class Quadratic(Cost):
    """``(w - centre)' matrix (w - centre) / 2 + offset``.

    Parameters
    ----------
    matrix : array_like, shape ([[T,] I,] s, s)
        Symmetric, positive semidefinite; ``s`` is n for a node cost, 2 n for a pair. Leading axes
        (steps T, agents or edges I) are left out, or of length 1, where nothing changes.
    centre : array_like, shape ([[T,] I,] s)
        Where the cost is least.
    offset : array_like, shape ([[T,] I])
        The least cost, at least 0: costs are nonnegative.

    Raises
    ------
    InputError
        If the shapes do not fit, a matrix is not symmetric or not positive semidefinite, an
        offset is negative, or a value is not finite; the message says at which step and member.
    """

    matrix: Floats
    centre: Floats
    offset: Floats
    kind = "quadratic"

    def __init__(self, matrix: ArrayLike, centre: ArrayLike = 0.0, offset: ArrayLike = 0.0) -> None:
        P = family(matrix, 2, "matrix of a quadratic cost")
        s = P.shape[-1]
        if np.ndim(centre) == 0:
            centre = np.full(s, centre, dtype=np.float64)
        c = family(centre, 1, "centre of a quadratic cost")
        if P.shape[-2] != s or c.shape[-1] != s or s == 0:
            raise InputError(
                f"quadratic cost: matrices of {P.shape[-2:]} and centres of {c.shape[-1:]}; "
                "square matrices and centres of the same length are needed"
            )
        object.__setattr__(self, "matrix", _symmetric(P))
        object.__setattr__(self, "centre", c)
        object.__setattr__(self, "offset", family(offset, 0, "offset of a quadratic cost"))
        object.__setattr__(self, "_curvature", spectrum(self.matrix, "matrix of a quadratic cost"))
        if self.offset.min(initial=0.0) < 0:
            raise InputError(f"offset = {self.offset.min():g}: costs are nonnegative")

    @property
    def size(self) -> int:
        """The length of w."""
        return int(self.matrix.shape[-1])

    @property
    def steady(self) -> bool:
        """Whether there is one matrix for all steps."""
        return len(self.matrix) == 1

    def value(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the costs, shape (m,)."""
        off = w - at(self.centre, t, i)
        moved = (at(self.matrix, t, i) @ off[:, :, None])[:, :, 0]
        found: Floats = 0.5 * (off * moved).sum(axis=1) + at(self.offset, t, i)
        return found

    def gradient(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the gradients, shape (m, size)."""
        off = w - at(self.centre, t, i)
        found: Floats = (at(self.matrix, t, i) @ off[:, :, None])[:, :, 0]
        return found

    def hessian(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the matrices, shape (m, size, size)."""
        return at(self.matrix, t, i)

    def curvature(self) -> Curvature:
        """Return the least and the largest eigenvalue of every matrix."""
        found: Curvature = self._curvature  # type: ignore[attr-defined]
        return found

    def check(self, H: int, count: int, size: int, name: str) -> None:
        """Raise `InputError` unless shapes fit H steps and `count` members."""
        if self.size != size:
            raise InputError(f"{name}: a quadratic of {self.size} numbers where {size} are needed")
        for part in ("matrix", "centre", "offset"):
            fits(getattr(self, part), H, count, f"{part} of the {name}")

    @cached_property
    def linear(self) -> Floats:
        """``matrix centre``, minus the gradient at 0, shape (T, I, size)."""
        found: Floats = (self.matrix @ self.centre[..., None])[..., 0]
        return found


def _symmetric(P: Floats) -> Floats:
    """Return the matrices, exactly symmetric; raise `InputError` where they are far from it."""
    gap = np.abs(P - P.swapaxes(-1, -2)).max(axis=(-2, -1))
    scale = np.abs(P).max(axis=(-2, -1))
    bad = gap > 1e-12 * scale
    if bad.any():
        t, i = np.argwhere(bad)[0]
        raise InputError(
            f"matrix of a quadratic cost at step {t + 1}, agent or edge {i}: not symmetric, "
            f"entries differ by {gap[t, i]:g}"
        )
    P = 0.5 * (P + P.swapaxes(-1, -2))
    P.setflags(write=False)
    return P


def spectrum(P: Floats, what: str, entries: Floats | float = 0.0) -> Curvature:
    """Return the extreme eigenvalues of symmetric matrices, shape (T, I) each.

    Parameters
    ----------
    P : ndarray, shape (T, I, s, s)
    what : str
        What the matrices are, for messages.
    entries : float or ndarray, shape (T, I)
        By how much an entry may be off.

    Raises
    ------
    InputError
        If an eigenvalue is negative.
    """
    s = P.shape[-1]
    values = P[..., 0] if s == 1 else np.linalg.eigvalsh(P)
    # LAPACK's symmetric eigenvalues are off by at most a small multiple of eps |P|; s = 1 is exact
    rounding = 0.0 if s == 1 else 4 * s * np.finfo(float).eps
    error = rounding * np.abs(values).max(axis=-1) + s * entries
    lower, upper = values[..., 0], values[..., -1]
    slack = 4 * s * np.finfo(float).eps * np.abs(values).max(axis=-1) + s * entries
    bad = lower < -slack
    if bad.any():
        t, i = np.argwhere(bad)[0]
        raise InputError(
            f"{what} at step {t + 1}, agent or edge {i}: not convex, "
            f"eigenvalue {lower[t, i]:g}; a positive semidefinite matrix is needed"
        )
    return Curvature(np.maximum(lower, 0.0), np.maximum(upper, 0.0), error, "exact")
