"""The offline optimum: the least cost of all steps and agents together, with its certificate."""

from __future__ import annotations

from dataclasses import dataclass
from time import perf_counter
from typing import Literal, cast

import numpy as np

from ..graphs import InputError
from .arrays import Floats
from .banded import solve_banded
from .barrier import Barrier
from .certify import Certificate, certify
from .conjugate import Operator, Steady, Written, conjugate, hessian_of
from .descent import Progress
from .problem import Problem
from .solve import Method as OfTerms
from .solve import solve
from .solved import Solved
from .terms import Terms
from .whole import whole

Method = Literal["auto", "cg", "banded", "descent", "barrier", "casadi", "osqp"]
THIN = 24  # N n up to which a banded factorisation beats conjugate gradients
ROUNDS = 4  # of iterative refinement


@dataclass(frozen=True, eq=False)
class Optimum:
    """The minimiser of ``cost(x)`` over all feasible trajectories, as far as it was reached.

    Parameters
    ----------
    x : ndarray, shape (H, N, n)
        The actions.
    cost : float
        What they cost.
    gap : float
        ``cost - cost(OPT) <= gap``; so ``cost - gap`` is a lower bound on the optimum.
    error : float
        ``|x - x*| <= error``, the norm over all actions.
    residual : float
        The norm of a subgradient at x (with multipliers: of the gradient of the Lagrangian).
    method : str
        How it was computed.
    iterations : int
        Steps of the method.
    converged : bool
        Whether the method met its own criterion; the bounds hold in any case.
    seconds : float
        How long it took.
    """

    x: Floats
    cost: float
    gap: float
    error: float
    residual: float
    method: str
    iterations: int
    converged: bool
    seconds: float


def optimum(
    problem: Problem,
    *,
    tolerance: float = 1e-12,
    method: Method = "auto",
    progress: Progress | None = None,
) -> Optimum:
    """Return the offline optimum of a problem.

    Parameters
    ----------
    problem : Problem
    tolerance : float
        The relative error aimed at.
    method : str
        ``"cg"``: conjugate gradients, ``"banded"``: Cholesky in time order (both for quadratic
        costs without constraints); ``"descent"``: accelerated projected gradient; ``"barrier"``:
        an interior point method; ``"casadi"``, ``"osqp"``: other libraries. ``"auto"`` takes the
        first that applies, ``"banded"`` where few actions make up a step.
    progress : callable, optional
        See `descend`.

    Raises
    ------
    InputError
        If the method does not apply.

    References
    ----------
    Paper, Section 2 (``sec:setting``), ``cost(OPT)``.
    """
    began = perf_counter()
    terms = whole(problem)
    method = _chosen(problem) if method == "auto" else method
    fixed = np.asarray(problem.x_0)
    found: Certificate | Solved
    if method in ("cg", "banded"):
        x, taken, good = _refined(terms, fixed, method, tolerance)
        found = certify(terms, fixed, x)
    else:
        other = cast("OfTerms", method)
        found = solve(terms, fixed, tolerance=tolerance, method=other, progress=progress)
        taken, good = int(found.iterations[0]), bool(found.converged[0])
    actions = found.x.reshape(problem.H, problem.N, problem.n)
    return Optimum(
        actions,
        problem.cost(actions),
        float(found.gap[0]),
        float(found.error[0]),
        float(found.residual[0]),
        method,
        taken,
        good,
        perf_counter() - began,
    )


def _chosen(problem: Problem) -> Method:
    if not problem.feasible.projectable or isinstance(problem.node, Barrier):
        return "barrier"
    if not (problem.quadratic and problem.feasible.everywhere):
        return "descent"
    return "banded" if problem.N * problem.n <= THIN else "cg"


def _refined(
    terms: Terms, fixed: Floats, method: str, tolerance: float
) -> tuple[Floats, int, bool]:
    """Return x, steps and success: corrections ``-A^-1 g(x)`` until g no longer falls."""
    problem = terms.problem
    if not (problem.quadratic and problem.feasible.everywhere):
        raise InputError(f"method = {method}: quadratic costs without constraints are needed")
    lower, upper = terms.scale
    least, condition = float(lower.min()), float(upper.max() / lower.min())
    x = np.zeros((len(terms.free), problem.n))
    slope, taken, operator = terms.gradient(x, fixed), 0, None
    for _ in range(ROUNDS):
        size = float(np.linalg.norm(slope))
        if size <= tolerance * least * float(np.linalg.norm(x)):
            break
        if method == "banded":
            step, more = solve_banded(hessian_of(terms), slope.ravel()), 1
        else:
            operator = operator or _operator(terms)
            right = slope.reshape(problem.H, -1).T
            limit = 100 + int(50 * np.sqrt(condition))
            reduction = max(tolerance / condition, 1e-15)
            step, more = conjugate(operator, right, reduction=reduction, limit=limit)
            step = step.T
        trial = x - step.reshape(x.shape)
        fresh = terms.gradient(trial, fixed)
        if not np.linalg.norm(fresh) < size:
            break
        x, slope, taken = trial, fresh, taken + more
        if np.linalg.norm(fresh) > size / 2:
            break
    else:
        return x, taken, False
    return x, taken, True


def _operator(terms: Terms) -> Operator:
    problem = terms.problem
    return Steady.of(problem) if problem.steady else Written.of(terms, problem.H)
