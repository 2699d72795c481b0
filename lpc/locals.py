"""LPC on any problem: the local problems of many agents, each a copy of its own."""

from __future__ import annotations

import numpy as np

from ..graphs import NearsightError
from .arrays import Floats, Ints
from .information import Balls
from .problem import Problem
from .solve import Method, solve
from .terms import Terms
from .workers import Workers

TOGETHER = 20_000  # free actions of the local problems that are solved side by side


class Locals:
    """The actions of LPC for general convex costs and sets.

    Parameters
    ----------
    problem : Problem
    k, r : int
        Prediction horizon ``>= 2`` and communication radius ``>= 1``.
    theta : ndarray, shape (H, N, n)
        The node minimisers, the values at the boundary.
    workers : Workers
        Who solves the local problems.
    tolerance : float
        The relative error aimed at, see `solve`.
    method : Method
        The solver, see `solve`.
    agents : ndarray of int, optional
        Only these agents; all if omitted.
    """

    def __init__(
        self,
        problem: Problem,
        k: int,
        r: int,
        theta: Floats,
        workers: Workers,
        tolerance: float,
        method: Method = "auto",
        agents: Ints | None = None,
    ) -> None:
        self._problem, self._k, self._theta, self._workers = problem, k, theta, workers
        self._tolerance, self._method = tolerance, method
        self._inner = Balls.of(problem.network, r - 1)
        chosen = np.arange(problem.N) if agents is None else agents
        sizes = np.diff(self._inner.start)[chosen] * min(k - 1, problem.H)
        self._parts = np.split(chosen, np.flatnonzero(np.diff(np.cumsum(sizes) // TOGETHER)) + 1)
        self._full: dict[int, Terms] = {}
        self.error = np.zeros(problem.N)

    def step(self, t: int, before: Floats) -> Floats:
        """Return the actions of the agents at step t, shape (N, n); others have NaN."""
        m = min(self._k - 1, self._problem.H - t + 1)
        actions = np.full(before.shape, np.nan)
        self.error = np.zeros(len(before))

        def play(index: int) -> None:
            agents = self._parts[index]
            terms = self._terms(index, t, m)
            chosen, error = self._solve(terms, len(agents), t, before)
            actions[agents], self.error[agents] = chosen, error

        list(self._workers.map(play, range(len(self._parts))))
        return actions

    def _solve(self, terms: Terms, copies: int, t: int, before: Floats) -> tuple[Floats, Floats]:
        step, agent = terms.fixed[:, 1], terms.fixed[:, 2]
        known = np.where(
            (step < t)[:, None], before[agent], self._theta[np.maximum(step, 1) - 1, agent]
        )
        start = self._theta[terms.free[:, 1] - 1, terms.free[:, 2]]
        found = solve(terms, known, start=start, tolerance=self._tolerance, method=self._method)
        if not found.converged.all():
            v = np.unique(terms.free[:, 0])[int(found.converged.argmin())]
            raise NearsightError(
                f"step {t}, agent {v}: the local problem was not solved by {found.method}, error "
                f"{np.max(found.error):.2g}; try another method or tolerance"
            )
        # copies are named after their agents
        here = (terms.free[:, 1] == t) & (terms.free[:, 2] == terms.free[:, 0])
        # an error that is not known is no error of 0
        error = np.where(np.isnan(found.error), np.inf, found.error)
        return found.x[here], np.broadcast_to(error, (copies,))

    def _terms(self, index: int, t: int, m: int) -> Terms:
        """Return the local problems of one part; those of full windows differ in t only."""
        if t + m <= self._problem.H and index in self._full:
            kept = self._full[index]
            return kept.later(t - int(kept.free[0, 1]))
        agents = self._parts[index]
        members = [self._inner.ball(int(v)) for v in agents]
        counts = [len(ball) for ball in members]
        ball, owner = np.concatenate(members), np.repeat(agents, counts)
        steps = np.repeat(np.arange(t, t + m), len(ball))
        found = Terms.of(
            self._problem, np.stack([np.tile(owner, m), steps, np.tile(ball, m)], axis=1)
        )
        if t + m <= self._problem.H:
            self._full[index] = found
        return found
