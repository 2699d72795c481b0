"""The exact worst case of LPC over all targets and starting points of a quadratic network."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular
from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigsh

from ..graphs import InputError, NearsightError
from ..lpc.arrays import Floats
from ..lpc.costs import Quadratic
from ..lpc.information import Balls
from ..lpc.problem import Problem
from ..lpc.workers import Workers
from .pencil import Pencil

Progress = Callable[[str], None]
METHODS = ("auto", "dense", "lanczos")
SMALL = 1000  # unknowns up to which the whole spectrum is computed
LEAST = 1e-290  # below, a ratio minus 1 may be 0 for want of smaller numbers
OVERFLOW = "numbers overflow: couplings so much stronger than the node costs are out of range"


@dataclass(frozen=True, eq=False)
class WorstCase:
    """``sup over (x_0, theta) of cost(LPC)/cost(OPT) - 1`` on one quadratic network.

    Parameters
    ----------
    problem : Problem
        The worst instance, from ``x_0 = 0``; its optimum costs 1 (0 where nothing is coupled).
    k, r : int
        Prediction horizon and communication radius.
    cr_minus_one : float
        The ratio of that instance minus 1: it is attained.
    residual : float
        An eigenvalue of the operator P of `Pencil` lies within this distance above or below, up
        to rounding (couplings of 1e-8 beside others of 1e8 lose all digits of a 1e-42). That no
        eigenvalue is larger is computed where `method` is ``"dense"``; where it is ``"lanczos"``
        the iteration converges to the largest from almost every start, which is no proof.
    method : str
        ``"dense"``: the whole spectrum; ``"lanczos"``: an iteration; ``"exact"``: P = 0,
        or less than `LEAST`.
    reason : str
        Why the ratio is 1 whatever the data, where P = 0, or why it cannot be told from 1; else
        empty.
    """

    problem: Problem
    k: int
    r: int
    cr_minus_one: float
    residual: float
    method: str
    reason: str = ""


def worst_case(
    problem: Problem,
    k: int,
    r: int,
    *,
    method: str = "auto",
    tolerance: float = 1e-8,
    seed: int = 0,
    workers: int = 1,
    progress: Progress | None = None,
) -> WorstCase:
    """Return the largest ratio over all data of a quadratic network, and an instance that has it.

    Nothing is stored but sparse matrices: the policies of LPC, the forms of `Energy`, and a
    factorisation of M or the vectors of an iteration in its place.

    Parameters
    ----------
    problem : Problem
        Quadratic and unconstrained; its targets and x_0, and the centres of its pair costs, play
        no part: no choice of any of them is worse than the instance found.
    k, r : int
        Prediction horizon ``>= 1`` and communication radius ``>= 0``.
    method : {"auto", "dense", "lanczos"}
        ``"auto"``: the whole spectrum of small networks.
    tolerance : float
        Of the iteration: the residual relative to the eigenvalue. The error is of second order,
        but where other eigenvalues crowd near the largest, as on long rings, it may be as large.
    seed : int
        Of its first vector.
    workers : int
        Threads for the policies.
    progress : callable, optional
        Called with a short text now and then.

    Raises
    ------
    InputError
        If the problem is not quadratic, has constraints, or an argument is out of range.
    NearsightError
        If the iteration did not converge.

    Examples
    --------
    >>> import nearsight as ns
    >>> from nearsight.lpc import instance
    >>> ring = instance(ns.parse_graph("ring:13"), 12, ns.Parameters(1, 1, 1, 0.5))
    >>> f"{worst_case(ring, 3, 2).cr_minus_one:.4e}"
    '6.9643e-03'
    """
    if method not in METHODS:
        raise InputError(f"method = {method!r}: one of {', '.join(METHODS)}", "method")
    if not 0 < tolerance <= 1e-2:
        raise InputError(f"tolerance = {tolerance}: above 0, at most 0.01", "tolerance")
    pencil = Pencil.of(problem, k, r, Workers(workers), progress)
    start = np.random.default_rng(seed).normal(size=pencil.energy.size)
    strayed = pencil.norm(pencil.push(start))
    if not np.isfinite(strayed):
        raise NearsightError(OVERFLOW)
    if strayed == 0:
        return _nothing(pencil, k, r, start)
    size = pencil.energy.size
    if method == "auto" or size == 1:  # one number is no subspace to iterate in
        method = "dense" if size <= SMALL else "lanczos"
    dense = method == "dense"
    z = _dense(pencil) if dense else _lanczos(pencil, start, tolerance, progress)
    y = pencil.pull(pencil.energy.hessian @ (z / pencil.norm(z)))
    value = pencil.ratio(y)
    if not np.isfinite(value):
        raise NearsightError(OVERFLOW)
    residual = pencil.norm(pencil.push(y) - value * z / pencil.norm(z))
    y = y / np.sqrt(pencil.energy.optimum(y))
    return WorstCase(pencil.energy.instance(y), k, r, value, residual, method)


def _nothing(pencil: Pencil, k: int, r: int, y: Floats) -> WorstCase:
    """Return the answer where LPC plays the optimum of all data, as far as numbers can tell."""
    problem, cost = pencil.energy.problem, pencil.energy.optimum(y)
    coupled = pencil.energy.couplings.count_nonzero() > 0
    reason, residual = "k and r reach everything: LPC plays the optimum", 0.0
    if not coupled:
        reason = "nothing is coupled: the optimum costs nothing, and neither does LPC"
    elif not _everything(problem, k, r):
        reason, residual = f"below {LEAST:g}: these couplings are as good as none", LEAST
    y = y / np.sqrt(cost) if cost > 0 else y
    return WorstCase(pencil.energy.instance(y), k, r, 0.0, residual, "exact", reason)


def _everything(problem: Problem, k: int, r: int) -> bool:
    """Return whether every local problem holds all that is coupled to its agent."""
    in_time = k > problem.H or not _acts(problem.temporal)
    if not _acts(problem.spatial):
        return in_time
    return in_time and bool(Balls.of(problem.network, r).distance.max() < r)


def _acts(cost: object) -> bool:
    return isinstance(cost, Quadratic) and bool(cost.matrix.any())


def _dense(pencil: Pencil) -> Floats:
    """Return the vector z of the largest eigenvalue, from all of ``R' T Q^{-1} K M^{-1} T' R``."""
    R = np.linalg.cholesky(pencil.energy.hessian.toarray())
    back = pencil.solve(pencil.deviation.adjoint(R))
    form = R.T @ pencil.push(back)
    top = np.linalg.eigh(0.5 * (form + form.T))[1][:, -1]
    found: Floats = solve_triangular(R, top, lower=True, trans="T")
    return found


def _lanczos(pencil: Pencil, start: Floats, tolerance: float, progress: Progress | None) -> Floats:
    """Return the vector z of the largest eigenvalue of P, by ARPACK.

    ARPACK's shift-and-invert mode iterates ``F M`` for a symmetric F given as an inverse, with
    inner products of M: here ``F = T Q^{-1} K M^{-1} T'``, so that its operator is P.
    """
    M, count = pencil.energy.hessian, 0

    def inverse(w: Floats) -> Floats:
        nonlocal count
        count += 1
        if progress is not None:
            progress(f"worst case, iteration {count}")
        return pencil.push(pencil.pull(w.ravel()))

    F = LinearOperator(M.shape, matvec=inverse, dtype=np.float64)
    try:
        vectors = eigsh(
            M,  # for its shape only
            k=1,
            M=M,
            sigma=0.0,
            OPinv=F,
            which="LM",
            v0=inverse(M @ start),
            tol=tolerance,
            ncv=min(len(start), 64),
        )[1]
    except ArpackNoConvergence as error:
        raise NearsightError(
            f"the iteration for the worst case did not converge: {error}"
        ) from error
    found: Floats = vectors[:, 0]
    return found
