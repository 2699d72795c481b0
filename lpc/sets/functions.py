"""Convex sets given by Python functions."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ...graphs import InputError
from ..arrays import Floats, Ints
from .convex import Convex

Function = Callable[[Ints, Ints, Floats], Floats]


@dataclass(frozen=True, eq=False)
class Functions(Convex):
    """``{y : g_j(y) <= 0 for all j}`` with g given as Python functions; it cannot be saved.

    Parameters
    ----------
    size : int
        The number n of entries of y.
    value, gradient, hessian : callable
        From steps t (m,), agents v (m,) and points y (m, n) to arrays of shapes (m, p),
        (m, p, n) and (m, p, n, n). A point's result must depend on that point only.
    constant : bool
        Whether the sets are the same for all steps and agents.

    Raises
    ------
    InputError
        If the size is not a positive integer or a function is not callable.
    """

    functions: tuple[Function, Function, Function]
    kind = "functions"

    def __init__(
        self,
        size: int,
        value: Function,
        gradient: Function,
        hessian: Function,
        constant: bool = False,
    ) -> None:
        if isinstance(size, bool) or int(size) != size or size < 1:
            raise InputError(f"size = {size} of a feasible set: an integer >= 1 is needed", "size")
        for name, part in (("value", value), ("gradient", gradient), ("hessian", hessian)):
            if not callable(part):
                raise InputError(f"{name} of constraints: a function of t, v and y is needed", name)
        object.__setattr__(self, "functions", (value, gradient, hessian))
        object.__setattr__(self, "_size", int(size))
        object.__setattr__(self, "_constant", bool(constant))

    def fields(self) -> dict[str, Any]:
        """Refuse: Python functions have no place in a file."""
        raise InputError(
            "a feasible set made of Python functions cannot be saved; Constraints, formulas, can"
        )

    @property
    def size(self) -> int:
        """The number of entries of y."""
        found: int = self._size  # type: ignore[attr-defined]
        return found

    @property
    def constant(self) -> tuple[bool, bool]:
        """What the author says, for steps and agents."""
        same: bool = self._constant  # type: ignore[attr-defined]
        return same, same

    def name(self, j: int) -> str:
        """Return the number of the constraint."""
        return f"constraint {j}"

    def constraints(self, t: Ints, v: Ints, y: Floats) -> tuple[Floats, Floats, Floats]:
        """Return ``g`` (m, p), its gradients (m, p, n) and Hessians (m, p, n, n)."""
        g, slope, bend = (np.asarray(f(t, v, y), dtype=np.float64) for f in self.functions)
        return g, slope, bend
