r"""``le:foc``: the derivative of a solution in its boundary."""

from __future__ import annotations

import numpy as np

from ...lpc.arrays import Floats
from ...lpc.local import LocalProblem
from ..comparison import Comparison
from ._extended import Minimiser
from ._hierarchy import Hierarchy, block_norms
from ._specimen import drawn

LABEL = "le:foc"
TITLE = "the derivative of a solution in its boundary"
TOLERANCE = 1e-9  # share of the largest entry


def compare(
    local: LocalProblem,
    fixed: Floats,
    e: Floats,
    *,
    digits: int = 40,
    instance: str = "",
    seed: int | None = None,
) -> tuple[Comparison, ...]:
    r"""Compare ``d psi(zeta + theta e)/d theta`` at 0 with what the Hessian says.

    * *derivative*: the entry in which the two sides of

      .. math:: \frac{d}{d\theta} \psi(\zeta + \theta e) = M^{-1} \Big( R^{(1)} e_0
          + R^{(k-1)} e_k + \sum_{\tau=1}^{k-1} K^{(\tau)} e_\tau \Big)

      differ most. The left-hand side is a central difference of minimisers in extended precision,
      which knows gradients only; M, R, K are Hessians in floats.
    * *first level*: the largest entry of R or K outside the block of the first level
      that touches the boundary's step; exactly 0.

    For ``k = 2`` the two matrices ``R^{(1)}`` and ``R^{(k-1)}`` are two, in spite of their name.

    Parameters
    ----------
    local : LocalProblem
        Without constraints, of quadratic, log-cosh or softplus costs.
    fixed : ndarray, shape (G, n)
        zeta: the values of ``local.terms.fixed``.
    e : ndarray, shape (G, n)
        The direction.
    digits : int
        Precision of the left-hand side.
    instance, seed
        As in `Comparison`.

    References
    ----------
    Paper, ``le:foc`` and the equation that ends its proof (``eq:time-index``).
    """
    solution = Minimiser(local.terms, digits)
    left = solution.derivative(fixed, e)
    h = Hierarchy(local, solution.start(fixed), fixed)
    right = np.linalg.solve(h.M, h.cross @ e.ravel())
    at = int(np.argmax(np.abs(left - right), axis=0))
    tolerance = TOLERANCE * float(np.abs(right).max())
    about = (instance, seed)
    derivative = Comparison(
        LABEL, "derivative", float(left[at]), float(right[at]), "==", tolerance, *about
    )
    terms = local.terms
    near = np.abs(np.subtract.outer(terms.free[:, 1], terms.fixed[:, 1]))
    first, last = terms.free[:, 1].min(), terms.free[:, 1].max()
    inside = (terms.fixed[:, 1] >= first) & (terms.fixed[:, 1] <= last)
    elsewhere = near != np.where(inside, 0, 1)
    outside = float(block_norms(h.cross, h.n)[elsewhere].max(initial=0.0))
    return derivative, Comparison(LABEL, "first level", outside, 0.0, "==", 0.0, *about)


def measure(seed: int) -> tuple[Comparison, ...]:
    """Compare on a small random local problem in a random direction; none if nothing is fixed."""
    specimen = drawn(seed, k=4, r=2)
    rng = np.random.default_rng([seed, 4])
    terms = specimen.local.terms
    fixed, e = rng.standard_normal((2, len(terms.fixed), specimen.shape.n))
    return compare(specimen.local, fixed, e, instance=specimen.text, seed=seed)
