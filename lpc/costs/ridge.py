"""Sums of one convex function of linear forms: ``sum_j c_j phi(a_j . w - b_j)``."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ...graphs import InputError
from ..arrays import Floats, Ints, at, family, fits
from .cost import Cost, Curvature

EPS = float(np.finfo(float).eps)


@dataclass(frozen=True, eq=False)
class Ridge(Cost):
    """``base |w - centre|^2 / 2 + sum_j weights_j phi(directions_j . w - shifts_j)``.

    A kind of ridge cost is a subclass that names its `profile`: a convex, nonnegative phi in C^2,
    whose second derivative falls to 0 far away and is largest, `bend`, at 0.

    Parameters
    ----------
    directions : array_like, shape ([[T,] I,] J, s)
        J vectors in R^s; ``s`` is n for a node cost, 2 n for a pair.
    shifts : array_like, shape ([[T,] I,] J)
        Where the bends are. A single number stands for all.
    weights : array_like, shape ([[T,] I,] J)
        Nonnegative. A single number stands for all.
    base : array_like, shape ([[T,] I])
        The strong convexity, nonnegative.
    centre : array_like, shape ([[T,] I,] s)
        Where the strongly convex part is least. A single number stands for all entries.

    Raises
    ------
    InputError
        If shapes do not fit, a weight or the base is negative, or a value is not finite.
    """

    directions: Floats
    shifts: Floats
    weights: Floats
    base: Floats
    centre: Floats

    bend = 1.0  # the largest second derivative of phi, at 0

    def __init__(
        self,
        directions: ArrayLike,
        shifts: ArrayLike = 0.0,
        weights: ArrayLike = 1.0,
        base: ArrayLike = 0.0,
        centre: ArrayLike = 0.0,
    ) -> None:
        a = family(directions, 2, f"directions of a {self.kind} cost")
        J, s = a.shape[2:]
        if J == 0 or s == 0:
            raise InputError(f"directions of a {self.kind} cost: shape {a.shape} is empty")
        object.__setattr__(self, "directions", a)
        for name, value, axes, length in (
            ("shifts", shifts, 1, J),
            ("weights", weights, 1, J),
            ("base", base, 0, 0),
            ("centre", centre, 1, s),
        ):
            full = np.full(length, value) if axes and np.ndim(value) == 0 else value
            array = family(full, axes, f"{name} of a {self.kind} cost")
            if axes and array.shape[-1] != length:
                raise InputError(
                    f"{name} of a {self.kind} cost: {array.shape[-1]} entries; directions of "
                    f"shape {a.shape[2:]} need {length}"
                )
            if name in ("weights", "base") and array.min(initial=0.0) < 0:
                raise InputError(f"{name} of a {self.kind} cost: {array.min():g}; >= 0 is needed")
            object.__setattr__(self, name, array)
        object.__setattr__(self, "_curvature", self._bounds())

    @staticmethod
    @abstractmethod
    def profile(z: Floats) -> tuple[Floats, Floats, Floats]:
        """Return phi, its derivative and its second derivative, entry by entry."""

    def _bounds(self) -> Curvature:
        """Return the extreme eigenvalues over all w.

        The least is the base, approached far away. The largest is that of all bends together,
        attained where ``directions . w = shifts``, if there is such a w.
        """
        try:
            scaled = np.sqrt(self.bend * self.weights)[..., None] * self.directions
            base = np.broadcast_to(
                self.base, np.broadcast_shapes(self.base.shape, scaled.shape[:2])
            )
            all_of_them = np.broadcast_shapes(base.shape, self.shifts.shape[:2])
        except ValueError as reason:
            raise InputError(f"{self.kind} cost: steps or members do not fit ({reason})") from None
        s, J = self.size, scaled.shape[2]
        if J == 1:
            square = (self.directions**2).sum(axis=-1)[..., 0]
            top = self.bend * self.weights[..., 0] * square
        else:
            top = np.linalg.eigvalsh(scaled.swapaxes(-1, -2) @ scaled)[..., -1]
        upper = base + np.maximum(top, 0.0)
        error = 8 * (s + J) * EPS * upper
        if J == 1 and np.isin(self.directions, (-1.0, 0.0, 1.0)).all():
            whole = (upper - base == top) & (upper - top == base)  # nothing was rounded
            whole &= np.isin(np.frexp(square)[0], (0.0, 0.5))
            error = np.where(whole, 0.0, error)
        return Curvature(base, upper, error, "exact" if _meets(self, all_of_them) else "bound")

    @property
    def size(self) -> int:
        """The length of w."""
        return int(self.directions.shape[-1])

    @property
    def steady(self) -> bool:
        """Whether nothing that the Hessians depend on changes with the step."""
        return all(len(x) == 1 for x in (self.directions, self.shifts, self.weights, self.base))

    def value(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the costs, shape (m,)."""
        phi = self.profile(self._forms(t, i, w))[0]
        off = w - at(self.centre, t, i)
        bowl = 0.5 * at(self.base, t, i) * (off * off).sum(axis=1)
        found: Floats = bowl + (at(self.weights, t, i) * phi).sum(axis=1)
        return found

    def gradient(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the gradients, shape (m, size)."""
        slope = at(self.weights, t, i) * self.profile(self._forms(t, i, w))[1]
        bowl = at(self.base, t, i)[:, None] * (w - at(self.centre, t, i))
        found: Floats = bowl + (slope[:, None, :] @ at(self.directions, t, i))[:, 0]
        return found

    def hessian(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the Hessians, shape (m, size, size)."""
        bend = at(self.weights, t, i) * self.profile(self._forms(t, i, w))[2]
        scaled = np.sqrt(bend)[:, :, None] * at(self.directions, t, i)
        found: Floats = scaled.swapaxes(1, 2) @ scaled
        found = 0.5 * (found + found.swapaxes(1, 2))
        return found + at(self.base, t, i)[:, None, None] * np.eye(self.size)

    def _forms(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return ``directions . w - shifts``, shape (m, J)."""
        found: Floats = (at(self.directions, t, i) @ w[:, :, None])[:, :, 0]
        return found - at(self.shifts, t, i)

    def curvature(self) -> Curvature:
        """Return the base, and the largest eigenvalue with all bends together."""
        found: Curvature = self._curvature  # type: ignore[attr-defined]
        return found

    def check(self, H: int, count: int, size: int, name: str) -> None:
        """Raise `InputError` unless shapes fit H steps and `count` members."""
        if self.size != size:
            raise InputError(f"{name}: a ridge of {self.size} numbers where {size} are needed")
        for part in ("directions", "shifts", "weights", "base", "centre"):
            fits(getattr(self, part), H, count, f"{part} of the {name}")


def _meets(cost: Ridge, members: tuple[int, ...]) -> bool:
    """Whether one w has ``directions . w = shifts`` wherever weights are positive."""
    if not cost.shifts.any():
        return True
    shape = (*members, cost.shifts.shape[-1])
    kept = np.broadcast_to(cost.weights > 0, shape)
    A = np.where(kept[..., None], np.broadcast_to(cost.directions, (*shape, cost.size)), 0.0)
    b = np.where(kept, np.broadcast_to(cost.shifts, shape), 0.0)
    w = np.linalg.pinv(A) @ b[..., None]
    gap = np.abs((A @ w)[..., 0] - b)
    return bool((gap <= 1e-8 * (1e-300 + np.abs(b).max(axis=-1, keepdims=True))).all())
