"""Localized Predictive Control: what every agent plays at one step."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, cast

import numpy as np

from ..graphs import InputError
from .arrays import Floats, integer
from .information import Balls, check_sight
from .locals import Locals
from .minimisers import node_minimisers
from .policy import DENSE, Policy
from .problem import Problem
from .programs import Programs
from .solve import Method
from .workers import Workers

METHODS = ("auto", "policy", "splitting", "direct", "descent", "barrier", "osqp", "casadi")


class Engine(Protocol):
    """Whatever computes the actions of one step."""

    @property
    def error(self) -> Floats:
        """Bounds on the errors of the actions of the last step, shape (N,)."""
        ...

    def step(self, t: int, before: Floats) -> Floats:
        """Return the actions of step t, shape (N, n)."""
        ...


@dataclass(frozen=True, eq=False)
class Controller:
    """LPC with prediction horizon k and communication radius r.

    At step t agent v plays the entry (t, v) of the solution of its local problem, whose boundary
    is fixed to the actions before and to the minimisers of node costs. With ``k = 1`` or
    ``r = 0`` nothing is free, and the agent plays the minimiser of its own node cost.

    Parameters
    ----------
    problem : Problem
    k : int
        Prediction horizon, at least 1.
    r : int
        Communication radius, at least 0.
    method : str
        How local problems are solved. ``"auto"`` takes ``"policy"`` (unconstrained quadratics: one
        sparse matrix a step), else ``"splitting"`` (quadratics over sets with a projection), else
        ``"descent"`` (other costs, sets with a projection), else ``"barrier"``. ``"direct"``,
        ``"osqp"`` and ``"casadi"`` solve local problem by local problem, see `solve`.
    workers : int or Workers
        Threads that share the local problems; 0 for one a core. The actions do not depend on it.
    tolerance : float
        The relative error of local solutions, where a method iterates.

    Raises
    ------
    InputError
        If k, r, the method or the tolerance is not among what is accepted.

    References
    ----------
    Paper, Algorithm 1 (``alg:LPC``).
    """

    problem: Problem
    k: int
    r: int
    method: str = "auto"
    workers: int | Workers = 1
    tolerance: float = 1e-9

    def __post_init__(self) -> None:
        check_sight(self.k, self.r)
        if self.method not in METHODS:
            raise InputError(f"method = {self.method!r}: one of {', '.join(METHODS)}", "method")
        if not 1e-14 <= self.tolerance <= 1e-2:
            raise InputError(f"tolerance = {self.tolerance}: from 1e-14 to 1e-2", "tolerance")
        if not isinstance(self.workers, Workers):
            object.__setattr__(self, "workers", Workers(self.workers))
        if self.method == "auto":
            object.__setattr__(self, "method", _suited(self.problem))
        elif self.method == "policy" and _suited(self.problem) != "policy":
            raise InputError(
                "method = policy: costs are not all quadratic, or there are constraints", "method"
            )
        elif self.method == "splitting" and _suited(self.problem) not in ("policy", "splitting"):
            raise InputError(
                "method = splitting: quadratic costs and sets with a projection are needed",
                "method",
            )

    @cached_property
    def theta(self) -> Floats:
        """The node minimisers ``argmin of f_t^v over D_t^v``, shape (H, N, n)."""
        return node_minimisers(self.problem)

    @cached_property
    def _engine(self) -> Engine:
        workers = self.workers
        if not isinstance(workers, Workers):
            raise TypeError(f"workers = {workers!r}")
        given = (self.problem, self.k, self.r, self.theta, workers)
        if self.k == 1 or self.r == 0:
            return Selfish(self.theta)
        if self.method == "policy":
            return Policy(*given)
        if self.method == "splitting":
            return _split(*given, self.tolerance)
        return Locals(*given, self.tolerance, cast("Method", self.method))

    def step(self, t: int, before: Floats) -> Floats:
        """Return the actions of all agents at step t, shape (N, n).

        Parameters
        ----------
        t : int
            The step, from 1 to H.
        before : ndarray, shape (N, n)
            The actions of step t - 1.

        Raises
        ------
        InputError
            If there is no such step, or the shape is another.
        """
        shape = (self.problem.N, self.problem.n)
        t = integer(t, "t", 1, self.problem.H)
        before = np.asarray(before)
        if before.shape != shape or before.dtype.kind not in "iuf":
            raise InputError(
                f"before: {before.dtype} of shape {before.shape}; real numbers of shape {shape} "
                "(agents, entries) are needed"
            )
        before = before.astype(np.float64)
        if not np.isfinite(before).all():
            raise InputError("before: an action is not finite")
        return self._engine.step(t, before)

    @property
    def error(self) -> Floats:
        """Bounds on the errors of the actions of the last step, shape (N,), up to rounding."""
        return self._engine.error


@dataclass(frozen=True, eq=False)
class Selfish:
    """Every agent plays the minimiser of its own node cost: LPC with k = 1 or r = 0."""

    theta: Floats

    @property
    def error(self) -> Floats:
        """Zero: there is nothing to solve."""
        return np.zeros(self.theta.shape[1])

    def step(self, t: int, before: Floats) -> Floats:
        """Return theta_t."""
        return np.array(self.theta[t - 1])


@dataclass(frozen=True, eq=False)
class Split:
    """Small local problems by splitting, those too large for dense matrices by descent."""

    small: Programs
    large: Locals

    @property
    def error(self) -> Floats:
        """Bounds on the errors of the actions of the last step."""
        return np.maximum(self.small.error, self.large.error)

    def step(self, t: int, before: Floats) -> Floats:
        """Return the actions of step t."""
        found = self.small.step(t, before)
        others = self.large.step(t, before)
        return np.where(np.isnan(others), found, others)


def _split(
    problem: Problem, k: int, r: int, theta: Floats, workers: Workers, tolerance: float
) -> Engine:
    sizes = np.diff(Balls.of(problem.network, r - 1).start) * min(k - 1, problem.H) * problem.n
    large = np.flatnonzero(sizes > DENSE)
    small = Programs(problem, k, r, theta, workers, tolerance)
    if not len(large):
        return small
    return Split(small, Locals(problem, k, r, theta, workers, tolerance, "descent", large))


def _suited(problem: Problem) -> str:
    if not problem.feasible.projectable:
        return "barrier"
    if not problem.quadratic:
        return "descent"
    return "policy" if problem.feasible.everywhere else "splitting"
