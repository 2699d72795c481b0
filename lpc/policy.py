"""LPC on unconstrained quadratic problems: one sparse matrix a step."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from .arrays import Floats, Ints
from .blocks import Blocks
from .cohorts import Cohort, cohorts
from .problem import Problem
from .sharing import Labels
from .sides import Data, sides
from .workers import Workers

DENSE = 600  # local problems with more free numbers are solved sparsely
TOGETHER = 1 << 22  # numbers in the matrices of one cohort: 32 MiB


class Policy:
    """The actions of LPC as a linear map of the data, for unconstrained quadratic problems.

    The local solution is ``M^{-1} R vector``; only its entries at (t, v) are played, so that with
    ``W = M^{-1} E``, E the unit vectors of (t, v), every agent's action is the row ``W' R`` of one
    sparse matrix. A time-invariant problem has one such matrix for all steps whose window ends
    before the horizon.

    Parameters
    ----------
    problem : Problem
        Quadratic and unconstrained.
    k, r : int
        Prediction horizon ``>= 2`` and communication radius ``>= 1``.
    theta : ndarray, shape (H, N, n)
        The node minimisers.
    workers : Workers
        Who builds the matrices of cohorts.
    """

    def __init__(self, problem: Problem, k: int, r: int, theta: Floats, workers: Workers) -> None:
        self._problem, self._k, self._r, self._workers = problem, k, r, workers
        self._blocks = Blocks.of(problem)
        self._labels = Labels(self._blocks)
        self._data = Data(self._blocks.linear, theta)
        self._cohorts = list(cohorts(problem, r, cohort_size(problem, k)))
        self._full: sparse.csr_array | None = None
        self.error = np.zeros(problem.N)  # a direct solution: rounding only

    def step(self, t: int, before: Floats) -> Floats:
        """Return the actions of all agents at step t, shape (N, n), after the actions `before`."""
        m = min(self._k - 1, self._problem.H - t + 1)
        found: Floats = self.matrix(t) @ self._data.vector(t, m, before)
        return found.reshape(before.shape)

    def matrix(self, t: int) -> sparse.csr_array:
        """Return the matrix of step t: rows the actions (N n), columns as in `sides.Data`."""
        m = min(self._k - 1, self._problem.H - t + 1)
        if not (self._blocks.steady and t + m <= self._problem.H):
            return self._build(t, m)
        if self._full is None:
            self._full = self._build(t, m)
        return self._full

    def _build(self, t: int, m: int) -> sparse.csr_array:
        def rows(cohort: Cohort) -> sparse.csr_array:
            pull = sides(cohort, self._blocks, self._data, t, m)
            return _first(cohort, self._blocks, self._labels, t, m) @ pull

        parts = list(self._workers.map(rows, self._cohorts))
        return in_order(parts, [c.agents for c in self._cohorts], self._problem.n)


def cohort_size(problem: Problem, k: int) -> int:
    """Return how many members the balls of a cohort may have, for matrices of moderate size."""
    numbers = min(k - 1, problem.H) * problem.n  # of one member
    return max(1, TOGETHER // (32 * numbers**2))


def _first(cohort: Cohort, blocks: Blocks, labels: Labels, t: int, m: int) -> sparse.csr_array:
    """Return the rows (t, v) of ``M^{-1}`` for every agent v, side by side on a diagonal."""
    n = blocks.linear.shape[2]
    A, size = len(cohort.agents), m * cohort.ball.shape[1] * n
    representative, which = labels.distinct(cohort, t, m)
    found = np.stack(list(_columns(cohort.subset(representative), blocks, t, m)))[which]
    indptr = np.arange(A * n + 1) * size
    columns = (np.arange(A) * size)[:, None, None] + np.arange(size)
    columns = np.broadcast_to(columns, (A, n, size)).ravel()
    values = found.swapaxes(1, 2).ravel()
    return sparse.csr_array((values, columns, indptr), shape=(A * n, A * size))


def _columns(cohort: Cohort, blocks: Blocks, t: int, m: int) -> Iterator[Floats]:
    """Yield the first n columns of every ``M^{-1}``, shape (m b n, n)."""
    n = blocks.linear.shape[2]
    size = m * cohort.ball.shape[1] * n
    unit = np.eye(size, n)
    if size > DENSE:
        for a in range(len(cohort.agents)):
            yield splu(cohort.subset(np.array([a])).matrix(blocks, t, m)).solve(unit)
        return
    per = max(1, TOGETHER // size**2)
    for first in range(0, len(cohort.agents), per):
        some = cohort.subset(np.arange(first, min(first + per, len(cohort.agents))))
        yield from np.linalg.solve(some.matrices(blocks, t, m), unit)


def in_order(parts: list[sparse.csr_array], agents: list[Ints], n: int) -> sparse.csr_array:
    """Stack the rows of cohorts, n an agent, in the order of the agents."""
    stacked = sparse.csr_array(sparse.vstack(parts, format="csr"))
    order = np.argsort(np.concatenate(agents))
    rows = (order[:, None] * n + np.arange(n)).ravel()
    return stacked[rows]
