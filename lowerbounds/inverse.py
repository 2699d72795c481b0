"""Solutions of ``M x = b`` for the Hessian of the whole cost."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy import sparse

from ..lpc.arrays import Floats, spread
from ..lpc.linear import factorised
from .energy import Energy

DIRECT = 20_000  # unknowns up to which M is factorised
THIN = 400_000  # the same on rings, paths and trees, whose factors stay sparse
ACCURATE = 1e-15  # relative error of the iteration, before rounding

Solve = Callable[[Floats], Floats]


def solver(energy: Energy, direct: bool | None = None) -> Solve:
    """Return the function ``b -> M^{-1} b``, b of shape (H N n, ...).

    Parameters
    ----------
    energy : Energy
        Of the network.
    direct : bool, optional
        Whether to factorise M, or to iterate; by the size of the factors if omitted.
    """
    M, network = energy.hessian, energy.problem.network
    if direct is None:
        few = network.edges <= network.vertices + 2
        direct = energy.size <= (THIN if few else DIRECT)
    if direct:
        factor = factorised(M)
        return lambda b: np.asarray(factor.solve(np.ascontiguousarray(b)))
    problem = energy.problem
    lower = problem.node.curvature().lower[:, :, None]
    below = spread(lower, problem.H, problem.N).repeat(problem.n, axis=2).ravel()
    return _chebyshev(M, below)


def _chebyshev(M: sparse.csr_array, below: Floats) -> Solve:
    """Return Chebyshev's iteration for M, scaled to a unit diagonal.

    ``x'Mx >= sum below_i x_i^2``, so the eigenvalues of the scaled matrix C are at least
    ``min below_i/M_ii``, and at most its largest absolute row sum. The iteration knows beforehand
    how many steps it needs, ``log(2/error)/log((sqrt(kappa) + 1)/(sqrt(kappa) - 1))``, and takes
    no inner products: some dozens of them at most, on every network.

    References
    ----------
    Saad, Iterative Methods for Sparse Linear Systems (2003), Algorithm 12.1.
    """
    scale = 1.0 / np.sqrt(M.diagonal())
    C = sparse.csr_array(M.multiply(scale[:, None]).multiply(scale))
    low = 0.999 * float((below * scale**2).min())
    high = float(abs(C).sum(axis=1).max())
    middle, half = 0.5 * (high + low), 0.5 * (high - low)
    root = np.sqrt(high / low)
    steps = int(np.ceil(np.log(2.0 / ACCURATE) / np.log((root + 1.0) / (root - 1.0))))

    def iterated(b: Floats) -> Floats:
        weights = scale.reshape(-1, *(1,) * (b.ndim - 1))
        rest = weights * b
        step, found = rest / middle, np.zeros_like(rest)
        rho = half / middle
        for _ in range(steps):
            found += step
            rest = rest - C @ step
            after = 1.0 / (2.0 * middle / half - rho)
            step = after * rho * step + 2.0 * after / half * rest
            rho = after
        result: Floats = weights * (found + step)
        return result

    return iterated
