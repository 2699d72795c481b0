"""OSQP: quadratic costs over boxes, by operator splitting and a polished active set."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from ...graphs import InputError, NearsightError
from ..arrays import Floats, at
from ..sets import Box
from ..terms import Terms


def minimise(
    terms: Terms, fixed: Floats, *, start: Floats | None = None, tolerance: float = 1e-9
) -> Floats:
    """Return ``argmin cost(x)`` for quadratic costs over a box or everywhere, shape (F, n).

    Parameters
    ----------
    terms : Terms
    fixed : ndarray, shape (G, n)
    start : ndarray, shape (F, n), optional
        A guess: the step from there is what OSQP looks for, so that a good one helps.
    tolerance : float
        OSQP's absolute and relative tolerance, at least 1e-10; polishing goes further.

    Raises
    ------
    InputError
        If OSQP is not installed, or the problem is of another kind.
    NearsightError
        If OSQP does not succeed.

    References
    ----------
    B. Stellato et al., OSQP: an operator splitting solver for quadratic programs (2020).
    """
    try:
        import osqp
    except ImportError as error:
        text = "method = osqp: not installed; pip install osqp (the extra qp)"
        raise InputError(text, "method") from error
    problem, shape = terms.problem, (len(terms.free), terms.problem.n)
    box = problem.feasible
    if not problem.quadratic or not (isinstance(box, Box) or box.everywhere):
        raise InputError("method = osqp: quadratic costs over a box are needed", "method")
    base = np.zeros(shape) if start is None else start
    lower, upper = np.full(shape, -np.inf), np.full(shape, np.inf)
    if isinstance(box, Box):
        t, v = terms.free[:, 1], terms.free[:, 2]
        lower = np.broadcast_to(at(box.lower, t, v), shape) - base
        upper = np.broadcast_to(at(box.upper, t, v), shape) - base
    solver = osqp.OSQP()
    accuracy = max(tolerance, 1e-10)
    solver.setup(
        sparse.csc_matrix(sparse.triu(terms.hessian(base, fixed)[0], format="csc")),
        terms.gradient(base, fixed).ravel(),
        sparse.eye(base.size, format="csc"),
        lower.ravel(),
        upper.ravel(),
        verbose=False,
        polishing=False,
        eps_abs=accuracy,
        eps_rel=accuracy,
        max_iter=100_000,
    )
    found = solver.solve(raise_error=False)
    x, y = found.x, found.y
    if ((x - lower.ravel() < -y) | (upper.ravel() - x < y)).any():  # else it complains in print
        solver.update_settings(polishing=True)
        found = solver.solve(raise_error=False)
    if found.info.status != "solved":
        raise NearsightError(
            f"OSQP: {found.info.status} after {found.info.iter} iterations; ask for less accuracy "
            "(tolerance), or use method = descent"
        )
    answer: Floats = base + found.x.reshape(shape)
    return answer
