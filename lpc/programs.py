"""LPC on quadratic problems over projectable sets: a small quadratic program an agent."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from .arrays import Floats, Ints, at
from .blocks import Blocks
from .cohorts import Cohort, cohorts
from .policy import DENSE, cohort_size
from .problem import Problem
from .projection import projection
from .sharing import Labels
from .sides import Data, sides
from .splitting import Reflections
from .workers import Workers


@dataclass(frozen=True, eq=False)
class Prepared:
    """What the programs of one cohort keep from step to step."""

    sides: sparse.csr_array
    reflections: Reflections
    which: Ints


class Programs:
    """The actions of LPC on quadratic problems with a projectable set for every action.

    Agents whose local problem has more than `policy.DENSE` free numbers are left out (NaN).

    Each agent solves its quadratic program by splitting (`Reflections`); equal Hessians are
    inverted once, and those of a time-invariant problem once for all steps whose window ends
    before the horizon.

    Parameters
    ----------
    problem : Problem
        Quadratic, with projectable sets.
    k, r : int
        Prediction horizon ``>= 2`` and communication radius ``>= 1``.
    theta : ndarray, shape (H, N, n)
        The node minimisers.
    workers : Workers
        Who solves the programs.
    tolerance : float
        The error of an action, relative to the largest entry of the local solution.
    """

    def __init__(
        self,
        problem: Problem,
        k: int,
        r: int,
        theta: Floats,
        workers: Workers,
        tolerance: float,
    ) -> None:
        self._problem, self._k, self._workers, self._tolerance = problem, k, workers, tolerance
        self._blocks = Blocks.of(problem)
        self._labels = Labels(self._blocks)
        self._data = Data(self._blocks.linear, theta)
        self._cohorts = [
            cohort
            for cohort in cohorts(problem, r, cohort_size(problem, k))
            if cohort.ball.shape[1] * min(k - 1, problem.H) * problem.n <= DENSE
        ]
        self._kept: dict[int, Prepared] = {}
        self.error = np.zeros(problem.N)

    def step(self, t: int, before: Floats) -> Floats:
        """Return the actions of all agents at step t, shape (N, n); `error` bounds their errors."""
        m = min(self._k - 1, self._problem.H - t + 1)
        vector = self._data.vector(t, m, before)
        actions = np.full(before.shape, np.nan)
        self.error = np.zeros(len(before))

        def solve(index: int) -> None:
            agents = self._cohorts[index].agents
            actions[agents], self.error[agents] = self._solve(index, t, m, vector)

        list(self._workers.map(solve, range(len(self._cohorts))))
        return actions

    def _solve(self, index: int, t: int, m: int, vector: Floats) -> tuple[Floats, Floats]:
        cohort, n = self._cohorts[index], self._problem.n
        ready = self._prepared(index, t, m)
        A, b = cohort.ball.shape
        steps = np.broadcast_to(t + np.arange(m)[:, None], (A, m, b)).reshape(A, m * b)
        members = np.broadcast_to(cohort.ball[:, None, :], (A, m, b)).reshape(A, m * b)
        onto = projection(self._problem.feasible, steps, members, n)
        q = (ready.sides @ vector).reshape(A, m * b * n)
        x, error = ready.reflections.solve(ready.which, q, onto, self._tolerance)
        return x[:, :n], error

    def _prepared(self, index: int, t: int, m: int) -> Prepared:
        inside = self._blocks.steady and t + m <= self._problem.H
        if inside and index in self._kept:
            return self._kept[index]
        cohort = self._cohorts[index]
        representative, which = self._labels.distinct(cohort, t, m)
        some = cohort.subset(representative)
        floor = self._floor(some, t, m)
        reflections = Reflections.of(some.matrices(self._blocks, t, m), floor)
        found = Prepared(
            sides(cohort, self._blocks, self._data, t, m),
            reflections,
            which,
        )
        if inside:
            self._kept[index] = found
        return found

    def _floor(self, cohort: Cohort, t: int, m: int) -> Floats:
        """Return the least strong convexity of the node costs of every local problem."""
        curvature = self._problem.node.curvature()
        least, ball = curvature.lower - curvature.error, cohort.ball
        found = np.full(len(ball), np.inf)
        for j in range(m):
            lower = at(least, np.full(ball.size, t + j), ball.ravel())
            found = np.minimum(found, lower.reshape(ball.shape).min(axis=1))
        return found
