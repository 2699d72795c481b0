"""Minimisers of local problems in extended precision, from gradients alone."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, cast

import mpmath
import numpy as np
from numpy.typing import NDArray

from ...graphs import InputError, NearsightError
from ...lpc.arrays import Floats, at
from ...lpc.costs import Cost, LogCosh, Quadratic, Softplus
from ...lpc.costs.ridge import Ridge
from ...lpc.solve import solve
from ...lpc.terms import Terms

Wide = NDArray[np.object_]  # of mpmath numbers
STEPS = 60  # of the iteration; each gains about ten digits


@dataclass(frozen=True, eq=False)
class Minimiser:
    """``psi``: the free actions of some terms as a function of the fixed ones.

    Parameters
    ----------
    terms : Terms
        Without constraints, of quadratic, log-cosh or softplus costs.
    digits : int
        Decimal digits that are computed with, at least 20.

    Raises
    ------
    InputError
        If a cost is of another kind, or there are too few digits.
    """

    terms: Terms
    digits: int = 40

    def __post_init__(self) -> None:
        if self.digits < 20:
            raise InputError(f"digits = {self.digits}: at least 20 are needed", "digits")
        p = self.terms.problem
        for cost in (p.node, p.temporal, p.spatial):
            if not isinstance(cost, Quadratic | LogCosh | Softplus):
                raise InputError(f"a {cost.kind} cost: quadratic, log_cosh or softplus is needed")

    def start(self, fixed: Floats) -> Floats:
        """Return the minimiser in floats, shape (F, n)."""
        return solve(self.terms, fixed, tolerance=1e-12).x

    def derivative(self, fixed: Floats, e: Floats) -> Floats:
        """Return the central difference of the minimiser in direction e, shape (F n,).

        With a step of a third of the digits its error is two thirds of the digits down.
        """
        x = self.start(fixed)
        inverse = np.linalg.inv(self.terms.hessian(x, fixed)[0].toarray())
        with mpmath.workdps(self.digits):
            step = mpmath.mpf(10) ** (-self.digits // 3)
            ends = [self._solve(x, fixed + sign * step * e, inverse) for sign in (1, -1)]
            found = (ends[0] - ends[1]) / (2 * step)
            return np.array([float(z) for z in found.ravel()])

    def gradient(self, x: Wide, fixed: Wide) -> Wide:
        """Return the gradient in the free actions, shape (F, n)."""
        terms, n = self.terms, self.terms.problem.n
        t, v = terms.free[:, 1:].T
        found = slope(terms.problem.node, t, v, x)
        values: Wide = np.concatenate([x, fixed])
        for pairs in (terms.temporal, terms.spatial):
            w: Any = pairs.arguments(cast("Any", values))
            parts = slope(pairs.cost, pairs.t, pairs.i, w).reshape(len(w), 2, n)
            for end in range(2):
                mine = pairs.ends[:, end] < len(x)
                np.add.at(found, pairs.ends[mine, end], parts[mine, end])
        return found

    def _solve(self, x: Floats, fixed: Wide, inverse: Floats) -> Wide:
        """Iterate ``x <- x - H^{-1} gradient`` with one H, that at the start."""
        found: Wide = x + mpmath.mpf(0)
        goal = mpmath.mpf(10) ** (3 - self.digits)
        for _ in range(STEPS):
            change = (inverse @ self.gradient(found, fixed).ravel()).reshape(found.shape)
            found = found - change
            if max(abs(z) for z in change.ravel()) <= goal:
                return found
        raise NearsightError(f"no minimiser to {self.digits} digits after {STEPS} steps")


def slope(cost: Cost, t: Any, i: Any, w: Wide) -> Wide:
    """Return the gradients of a cost in the arithmetic of w, shape (m, size)."""
    if not isinstance(cost, Ridge):
        return np.asarray(cost.gradient(t, i, cast("Any", w)), dtype=np.object_)
    rise = mpmath.tanh if isinstance(cost, LogCosh) else _logistic
    forms = (at(cost.directions, t, i) @ w[:, :, None])[:, :, 0] - at(cost.shifts, t, i)
    rises = np.array([rise(z) for z in forms.ravel()], dtype=object).reshape(forms.shape)
    bowl = at(cost.base, t, i)[:, None] * (w - at(cost.centre, t, i))
    found: Wide = (
        bowl + ((at(cost.weights, t, i) * rises)[:, None, :] @ at(cost.directions, t, i))[:, 0]
    )
    return found


def _logistic(z: Any) -> Any:
    return 1 / (1 + mpmath.exp(-z))
