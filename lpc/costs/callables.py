"""Costs given as Python functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...graphs import InputError
from ..arrays import Floats, Ints, family, fits
from .claim import claim
from .cost import Cost, Curvature
from .probe import probe

Function = Callable[[Ints, Ints, Floats], Floats]


@dataclass(frozen=True, eq=False)
class Callables(Cost):
    """A convex function in C^2 given as Python functions; it cannot be saved.

    Parameters
    ----------
    size : int
        The length of w: n for a node cost, 2 n for a pair.
    value, gradient, hessian : callable
        From steps t (m,), members i (m,) and points w (m, size) to arrays of shapes (m,),
        (m, size) and (m, size, size). A point's result must depend on that point only.
    lower, upper : array_like, shape ([[T,] I])
        Bounds on the eigenvalues of the Hessian, as far as the author knows; samples test them.
    steady : bool
        Whether the Hessians, as functions of w, are the same at all steps.

    Raises
    ------
    InputError
        If the size is not a positive integer, a function is not callable, or not
        ``0 <= lower <= upper``.
    """

    functions: tuple[Function, Function, Function]
    lower: Floats
    upper: Floats
    kind = "callables"

    def __init__(
        self,
        size: int,
        value: Function,
        gradient: Function,
        hessian: Function,
        lower: ArrayLike,
        upper: ArrayLike,
        steady: bool = False,
    ) -> None:
        if isinstance(size, bool) or int(size) != size or size < 1:
            raise InputError(f"size = {size} of a cost: an integer >= 1 is needed", "size")
        for name, part in (("value", value), ("gradient", gradient), ("hessian", hessian)):
            if not callable(part):
                raise InputError(f"{name} of a cost: a function of t, i and w is needed", name)
        object.__setattr__(self, "functions", (value, gradient, hessian))
        object.__setattr__(self, "_size", int(size))
        object.__setattr__(self, "_steady", bool(steady))
        for name, bound in (("lower", lower), ("upper", upper)):
            object.__setattr__(self, name, family(bound, 0, f"{name} curvature of a cost"))
        object.__setattr__(
            self, "_curvature", claim(self.lower, self.upper, "cost made of functions")
        )

    def fields(self) -> dict[str, Any]:
        """Refuse: Python functions have no place in a file."""
        raise InputError(
            "a cost made of Python functions cannot be saved; Symbolic, a formula, can"
        )

    @property
    def size(self) -> int:
        """The length of w."""
        found: int = self._size  # type: ignore[attr-defined]
        return found

    @property
    def steady(self) -> bool:
        """What the author says."""
        found: bool = self._steady  # type: ignore[attr-defined]
        return found

    def value(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the costs, shape (m,)."""
        return np.asarray(self.functions[0](t, i, w), dtype=np.float64)

    def gradient(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the gradients, shape (m, size)."""
        return np.asarray(self.functions[1](t, i, w), dtype=np.float64)

    def hessian(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the Hessians, shape (m, size, size)."""
        return np.asarray(self.functions[2](t, i, w), dtype=np.float64)

    def curvature(self) -> Curvature:
        """Return what the author says."""
        found: Curvature = self._curvature  # type: ignore[attr-defined]
        return found

    def check(self, H: int, count: int, size: int, name: str) -> None:
        """Raise `InputError` unless shapes fit, and a few samples agree with what is claimed."""
        if self.size != size:
            raise InputError(f"{name}: functions of {self.size} numbers where {size} are needed")
        for key in ("lower", "upper"):
            fits(getattr(self, key), H, count, f"{key} curvature of the {name}")
        if count:
            probe(self, H, count, name, samples=64)
