"""Weighted sums of costs, with which kinds change over steps, agents and edges."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ...graphs import InputError
from ..arrays import Floats, Ints, at, family, fits
from .cost import Cost, Curvature, Source

EPS = float(np.finfo(float).eps)
Method = Literal["value", "gradient", "hessian"]


@dataclass(frozen=True, eq=False)
class Mixture(Cost):
    """``sum_j weights_j parts_j``.

    Parameters
    ----------
    parts : sequence of Cost
        Of the same size; every one has all steps and members, or is constant in them.
    weights : sequence of array_like, shape ([[T,] I]) each
        Nonnegative, one array a part. Where a weight is 0 the part is not evaluated; with weights
        0 and 1 every step and member picks its own kind.

    Raises
    ------
    InputError
        If there are no parts, their sizes differ, or a weight is negative or not finite.
    """

    parts: tuple[Cost, ...]
    weights: tuple[Floats, ...]
    kind = "mixture"

    def __init__(self, parts: Sequence[Cost], weights: Sequence[ArrayLike]) -> None:
        if not parts or len(parts) != len(weights):
            raise InputError(
                f"mixture: {len(parts)} parts and {len(weights)} weights; one weight each is needed"
            )
        sizes = sorted({part.size for part in parts})
        if len(sizes) > 1:
            raise InputError(f"mixture: parts of {sizes} numbers; equal sizes are needed")
        arrays = tuple(family(x, 0, f"weight {j} of a mixture") for j, x in enumerate(weights))
        for j, array in enumerate(arrays):
            bad = np.argwhere(array < 0)
            if len(bad):
                t, i = bad[0]
                raise InputError(
                    f"weight {j} of a mixture at step {t + 1}, agent or edge {i}: "
                    f"{array[t, i]:g}; a weight is at least 0"
                )
        object.__setattr__(self, "parts", tuple(parts))
        object.__setattr__(self, "weights", arrays)
        object.__setattr__(self, "_curvature", self._bounds())

    def _bounds(self) -> Curvature:
        """Return the sums of the parts' bounds."""
        bounds = [part.curvature() for part in self.parts]
        try:
            shape = np.broadcast_shapes(
                *(x.shape for x in self.weights), *(b.lower.shape for b in bounds)
            )
        except ValueError as reason:
            raise InputError(f"mixture: steps or members do not fit ({reason})") from reason
        lower, upper = np.zeros(shape), np.zeros(shape)
        active, error, plain = np.zeros(shape, dtype=int), np.zeros(shape), np.full(shape, True)
        for bound, weight in zip(bounds, self.weights, strict=True):
            lower, upper = lower + weight * bound.lower, upper + weight * bound.upper
            active = active + (weight > 0)
            error = error + weight * bound.error
            plain = plain & ((weight == 0) | (weight == 1))
        alone = bool((active <= 1).all())
        error = error + np.where(plain & (active <= 1), 0.0, (len(bounds) + 1) * EPS * upper)
        used = {b.source for b, x in zip(bounds, self.weights, strict=True) if x.any()}
        source: Source = "exact" if alone and used <= {"exact"} else "bound"
        return Curvature(lower, upper, error, "claimed" if "claimed" in used else source)

    @property
    def size(self) -> int:
        """The length of w."""
        return self.parts[0].size

    @property
    def steady(self) -> bool:
        """Whether neither the weights nor the parts in use change with the step."""
        pairs = zip(self.parts, self.weights, strict=True)
        return all(len(x) == 1 and (part.steady or not x.any()) for part, x in pairs)

    def value(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the costs, shape (m,)."""
        return self._sum("value", t, i, w, ())

    def gradient(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the gradients, shape (m, size)."""
        return self._sum("gradient", t, i, w, (self.size,))

    def hessian(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the Hessians, shape (m, size, size)."""
        return self._sum("hessian", t, i, w, (self.size, self.size))

    def _sum(self, method: Method, t: Ints, i: Ints, w: Floats, shape: tuple[int, ...]) -> Floats:
        found = np.zeros((len(w), *shape))
        for part, weights in zip(self.parts, self.weights, strict=True):
            weight = at(weights, t, i)
            there = np.flatnonzero(weight)
            if len(there):
                values = getattr(part, method)(t[there], i[there], w[there])
                found[there] += weight[there].reshape(-1, *(1 for _ in shape)) * values
        return found

    def curvature(self) -> Curvature:
        """Return the sums of the bounds; exact where at most one weight is positive."""
        found: Curvature = self._curvature  # type: ignore[attr-defined]
        return found

    def check(self, H: int, count: int, size: int, name: str) -> None:
        """Raise `InputError` unless all parts and weights fit H steps and `count` members."""
        for j, (part, weight) in enumerate(zip(self.parts, self.weights, strict=True)):
            part.check(H, count, size, f"part {j} of the {name}")
            fits(weight, H, count, f"weight {j} of the {name}")
