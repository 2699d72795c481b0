"""Solutions of ``M x = b`` for the Hessian of the whole cost."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import LinearOperator, cg

from ..graphs import NearsightError
from ..lpc.arrays import Floats
from ..lpc.linear import factorised

DIRECT = 20_000  # unknowns up to which M is factorised

Solve = Callable[[Floats], Floats]


def solver(M: sparse.csr_array, direct: bool | None = None) -> Solve:
    """Return the function ``b -> M^{-1} b``.

    M is definite and well conditioned, at most ``(l_f + 2 l_T + Delta l_S)/mu``, on every network:
    above `DIRECT` unknowns conjugate gradients need some dozens of products, and no memory.

    Parameters
    ----------
    M : csr_array, shape (m, m)
    direct : bool, optional
        Whether to factorise; by the size if omitted.
    """
    if M.shape[0] <= DIRECT if direct is None else direct:
        factor = factorised(M)
        return lambda b: np.asarray(factor.solve(np.ascontiguousarray(b)))
    scale = 1.0 / M.diagonal()
    near = LinearOperator(M.shape, matvec=lambda b: scale * b.ravel(), dtype=np.float64)

    def iterated(b: Floats) -> Floats:
        found, failed = cg(M, b, rtol=1e-13, maxiter=20_000, M=near)
        if failed:
            raise NearsightError(f"conjugate gradients did not converge in {failed} iterations")
        return np.asarray(found)

    return iterated
