"""The exact worst case of LPC over all targets and starting points of a quadratic network."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.linalg import solve_triangular
from scipy.sparse.linalg import ArpackNoConvergence, LinearOperator, eigsh

from ..graphs import InputError, NearsightError
from ..lpc.arrays import Floats
from ..lpc.information import check_sight
from ..lpc.problem import Problem
from ..lpc.workers import Workers
from .deviation import Deviation
from .energy import Energy
from .inverse import Solve, solver

Progress = Callable[[str], None]
METHODS = ("auto", "dense", "lanczos")
SMALL = 1000  # unknowns up to which the whole spectrum is computed


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
        to rounding. That no eigenvalue is larger is computed where `method` is ``"dense"``;
        where it is ``"lanczos"`` the iteration converges to the largest from almost every start,
        which is no proof.
    method : str
        ``"dense"``: the whole spectrum; ``"lanczos"``: an iteration; ``"exact"``: P = 0.
    reason : str
        Why the ratio is 1 whatever the data, where P = 0; else empty.
    """

    problem: Problem
    k: int
    r: int
    cr_minus_one: float
    residual: float
    method: str
    reason: str = ""


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
        progress: Progress | None = None,
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
        return float(np.sqrt(delta @ (self.energy.hessian @ delta)))

    def ratio(self, y: Floats) -> float:
        """Return ``cost(LPC)/cost(OPT) - 1`` where the optimum is y."""
        return 0.5 * self.norm(self.push(y)) ** 2 / self.energy.optimum(y)


def worst_case(
    problem: Problem,
    k: int,
    r: int,
    *,
    method: str = "auto",
    tolerance: float = 1e-5,
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
        Of the iteration: the residual relative to the eigenvalue. The error of the eigenvalue
        is of second order, in all cases seen below 1e-8 by default.
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
    if pencil.norm(pencil.push(start)) == 0:
        return _nothing(pencil, k, r, start)
    size = pencil.energy.size
    if method == "auto" or size == 1:  # one number is no subspace to iterate in
        method = "dense" if size <= SMALL else "lanczos"
    dense = method == "dense"
    z = _dense(pencil) if dense else _lanczos(pencil, start, tolerance, progress)
    y = pencil.pull(pencil.energy.hessian @ (z / pencil.norm(z)))
    value = pencil.ratio(y)
    if not np.isfinite(value):
        raise NearsightError("the numbers of this network overflow: rescale its costs")
    residual = pencil.norm(pencil.push(y) - value * z / pencil.norm(z))
    y = y / np.sqrt(pencil.energy.optimum(y))
    return WorstCase(pencil.energy.instance(y), k, r, value, residual, method)


def _nothing(pencil: Pencil, k: int, r: int, y: Floats) -> WorstCase:
    """Return the answer where LPC plays the optimum of all data."""
    cost = pencil.energy.optimum(y)
    reason = "k and r reach everything: LPC plays the optimum"
    if cost == 0:
        reason = "nothing is coupled: the optimum costs nothing, and neither does LPC"
    y = y / np.sqrt(cost) if cost > 0 else y
    return WorstCase(pencil.energy.instance(y), k, r, 0.0, 0.0, "exact", reason)


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
