"""What every solver of terms returns."""

from __future__ import annotations

from dataclasses import dataclass

from .arrays import Floats, Ints
from .slope import Booleans


@dataclass(frozen=True, eq=False)
class Solved:
    """Minimisers with their certificates; C copies.

    Parameters
    ----------
    x : ndarray, shape (F, n)
        The free actions; feasible.
    residual : ndarray, shape (C,)
        The norm of a subgradient at x; with multipliers, of the gradient of the Lagrangian.
    error : ndarray, shape (C,)
        A bound on ``|x - x*|``.
    gap : ndarray, shape (C,)
        A bound on ``cost(x) - cost(x*)``.
    iterations : ndarray of int, shape (C,)
        Steps of the method.
    converged : ndarray of bool, shape (C,)
        Whether the method met its own criterion; `error` and `gap` hold in any case.
    method : str
        The method that was used.
    """

    x: Floats
    residual: Floats
    error: Floats
    gap: Floats
    iterations: Ints
    converged: Booleans
    method: str
