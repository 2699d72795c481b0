"""The minimiser of some terms, by the method that suits their costs and sets."""

from __future__ import annotations

from dataclasses import replace
from typing import Literal

import numpy as np

from ..graphs import InputError
from .arrays import Floats
from .barrier import Barrier
from .certify import Copies, certify
from .descent import Progress, descend
from .interior import follow
from .linear import solve_copies
from .solved import Solved
from .terms import Terms

Method = Literal["auto", "direct", "descent", "barrier", "casadi", "osqp"]
LARGEST = 20_000  # unknowns of a copy up to which "auto" factorises its Hessian


def solve(
    terms: Terms,
    fixed: Floats,
    *,
    start: Floats | None = None,
    tolerance: float = 1e-11,
    method: Method = "auto",
    progress: Progress | None = None,
) -> Solved:
    """Return ``argmin cost(x)`` over ``x_j in D_j`` for every copy.

    Parameters
    ----------
    terms : Terms
    fixed : ndarray, shape (G, n)
        Values of ``terms.fixed``.
    start : ndarray, shape (F, n), optional
        A guess; 0 if omitted.
    tolerance : float
        The relative error aimed at.
    method : str
        ``"direct"`` (quadratic costs, no constraints), ``"descent"`` (sets with a projection),
        ``"barrier"`` (any set with an interior; also for problems `with_barrier`), ``"casadi"``
        and ``"osqp"`` (other libraries), or ``"auto"``: the first of these that applies. With the
        first three what a copy returns depends, bit for bit, on nothing but its own data.
    progress : callable, optional
        See `descend`.

    Raises
    ------
    InputError
        If the method does not apply.
    """
    start = np.zeros((len(terms.free), terms.problem.n)) if start is None else start
    if not len(terms.free):
        none = np.zeros(0)
        count = np.zeros(0, dtype=np.int64)
        return Solved(start, none, none, none, count, count.astype(bool), "nothing to do")
    method = _chosen(terms) if method == "auto" else method
    if method == "direct":
        return _direct(terms, fixed, start)
    if method == "descent":
        found = descend(terms, fixed, start, tolerance=tolerance, progress=progress)
        return Solved(**vars(found), method=method)
    if method == "barrier":
        return _central(terms, fixed, start, tolerance)
    if method in ("osqp", "casadi"):
        return _adapted(terms, fixed, start, tolerance, method)
    there = "auto, direct, descent, barrier, casadi, osqp"
    raise InputError(f"method = {method!r}: one of {there}", "method")


def _chosen(terms: Terms) -> Method:
    problem = terms.problem
    if not problem.feasible.projectable or isinstance(problem.node, Barrier):
        return "barrier"
    largest = np.bincount(Copies.of(terms).row).max() * problem.n
    if problem.quadratic and problem.feasible.everywhere and largest <= LARGEST:
        return "direct"
    return "descent"


def _central(terms: Terms, fixed: Floats, start: Floats, tolerance: float) -> Solved:
    """Return the end of the central path, or the point of the strength of the problem's barrier."""
    problem = terms.problem
    node = problem.node
    if not isinstance(node, Barrier):
        return follow(terms, fixed, start, tolerance=tolerance)
    without = replace(problem, node=node.node, feasible=node.feasible)
    inner = replace(terms, problem=without)
    found = follow(inner, fixed, start, tolerance=tolerance, strength=node.strength)
    known = certify(terms, fixed, found.x)
    return replace(found, residual=known.residual, error=known.error, gap=known.gap)


def _direct(terms: Terms, fixed: Floats, start: Floats) -> Solved:
    """Return ``x - H^-1 g(x)``, and that once more: one step of iterative refinement."""
    if not (terms.problem.quadratic and terms.problem.feasible.everywhere):
        text = "method = direct: quadratic costs without constraints are needed"
        raise InputError(text, "method")
    copies, x = Copies.of(terms), start
    matrix = terms.hessian(x, fixed)[0]
    for _ in range(2):
        x = x - solve_copies(copies, matrix, terms.gradient(x, fixed))
    found = certify(terms, fixed, x)
    C = len(copies.label)
    taken, good = np.full(C, 2), np.ones(C, dtype=bool)
    return Solved(found.x, found.residual, found.error, found.gap, taken, good, "direct")


def _adapted(terms: Terms, fixed: Floats, start: Floats, tolerance: float, method: str) -> Solved:
    """Return what another library answers, certified here where there are projections."""
    if method == "osqp":
        from .adapters.osqp import minimise
    else:
        from .adapters.casadi import minimise
    x = minimise(terms, fixed, start=start, tolerance=tolerance)
    C = len(Copies.of(terms).label)
    taken, good = np.zeros(C, dtype=np.int64), np.ones(C, dtype=bool)
    if terms.problem.feasible.projectable:
        found = certify(terms, fixed, x)
        return Solved(found.x, found.residual, found.error, found.gap, taken, good, method)
    unknown = np.full(C, np.nan)
    return Solved(x, unknown, unknown, unknown, taken, good, method)
