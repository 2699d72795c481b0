"""The operator whose largest eigenvalue is the worst ratio of LPC, minus 1."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..lpc.arrays import Floats
from ..lpc.information import check_sight
from ..lpc.problem import Problem
from ..lpc.workers import Workers
from .deviation import Deviation
from .energy import Energy
from .inverse import Solve, solver


@dataclass(frozen=True, eq=False)
class Pencil:
    """The operator whose largest eigenvalue is the worst ``CR - 1``::

        P = T Q^{-1} K M^{-1} T' M.

    LPC strays by ``delta = T D`` and pays ``|delta|_M^2 / 2`` too much; the optimum costs
    ``D'(Q + Q K^+ Q) D / 2`` at the least for this D (`Energy`), and the pseudo-inverse of this
    form is ``Q^{-1} K M^{-1}``. So with ``M = R R'`` the ratio is the largest eigenvalue of
    ``R' T Q^{-1} K M^{-1} T' R``, and P is similar to it: selfadjoint and nonnegative in the inner
    product of M. No matrix is singular, and no two nearly equal numbers are subtracted.

    *The ratio cannot be unbounded.* The optimum costs at least ``|D|_Q^2 / 2``: data that cost it
    nothing have D = 0, and LPC then pays nothing either (``T 0 = 0``). More than that,
    ``CR - 1 <= |M^{1/2} T Q^{-1/2}|^2``. A policy that is no function of D could be unbounded.
    """

    energy: Energy
    deviation: Deviation
    solve: Solve

    @classmethod
    def of(
        cls,
        problem: Problem,
        k: int,
        r: int,
        workers: Workers | None = None,
        progress: Callable[[str], None] | None = None,
    ) -> Pencil:
        """Return the operator of a quadratic, unconstrained problem."""
        check_sight(k, r)
        energy = Energy.of(problem)
        deviation = Deviation.of(energy.problem, k, r, workers, progress)
        return cls(energy, deviation, solver(energy))

    def pull(self, w: Floats) -> Floats:
        """Return ``y = M^{-1} T' w``: the optimum of the data that w answers to."""
        return self.solve(self.deviation.adjoint(w))

    def push(self, y: Floats) -> Floats:
        """Return ``T Q^{-1} K y``: how far LPC strays where the optimum is y."""
        return self.deviation.apply(self.energy.gap(y))

    def norm(self, delta: Floats) -> float:
        """Return ``|delta|_M``."""
        size = float(np.abs(delta).max())
        if not 0 < size < np.inf:
            return size
        unit = delta / size  # squares neither overflow nor vanish
        return size * float(np.sqrt(unit @ (self.energy.hessian @ unit)))

    def ratio(self, y: Floats) -> float:
        """Return ``cost(LPC)/cost(OPT) - 1`` where the optimum is y."""
        return float((self.norm(self.push(y)) / np.sqrt(2 * self.energy.optimum(y))) ** 2)
