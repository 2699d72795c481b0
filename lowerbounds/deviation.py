"""How far LPC strays from the optimum, as a linear map that subtracts nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..lpc.arrays import Floats
from ..lpc.policy import Policy
from ..lpc.problem import Problem
from ..lpc.workers import Workers


@dataclass(frozen=True, eq=False)
class Step:
    """One step of LPC: ``delta_t = before delta_{t-1} + ahead (D_t, ..., D_{t+m})``.

    Parameters
    ----------
    before : csr_array, shape (N n, N n)
    ahead : csr_array, shape (N n, (m + 1) N n)
        From D at the boundary of every local problem; zero in its interior.
    """

    before: sparse.csr_array
    ahead: sparse.csr_array


@dataclass(frozen=True, eq=False)
class Deviation:
    """``T: D = theta - x*  ->  delta = x - x*`` for LPC on a quadratic problem.

    By the principle of optimality ``x*_t`` is what an agent would play if its boundary were
    optimal: the actions before x*_{t-1}, and x* in place of theta around. What it plays differs
    because ``delta_{t-1}`` and ``D`` on the boundary differ from 0, and by as much as its
    (linear) local problem makes of them. So no nearly equal numbers are subtracted.

    Parameters
    ----------
    steps : tuple of Step
        Of the steps 1..H; empty with k = 1 or r = 0, where ``delta = D``.
    size : int
        The numbers of one step, ``N n``.
    """

    steps: tuple[Step, ...]
    size: int

    @classmethod
    def of(
        cls,
        problem: Problem,
        k: int,
        r: int,
        workers: Workers | None = None,
        progress: Callable[[str], None] | None = None,
    ) -> Deviation:
        """Return the map of a quadratic, unconstrained problem."""
        H, N, n = problem.H, problem.N, problem.n
        if k == 1 or r == 0:
            return cls((), N * n)
        theta = np.zeros((H, N, n))
        policy = Policy(problem, k, r, theta, Workers(1) if workers is None else workers)
        steps: list[Step] = []
        last = None
        for t in range(1, H + 1):
            matrix = policy.matrix(t)
            steps.append(steps[-1] if matrix is last else _split(matrix, N * n))
            last = matrix
            if progress is not None:
                progress(f"policy of step {t}/{H}")
        return cls(tuple(steps), N * n)

    def apply(self, D: Floats) -> Floats:
        """Return ``T D``, shape (H N n, ...)."""
        if not self.steps:
            return D
        nothing = np.zeros((self.size, *D.shape[1:]))
        data = np.concatenate([D, nothing])  # past the horizon there is nothing
        found = np.empty_like(D)
        before = nothing
        for s, step in enumerate(self.steps):
            window = data[s * self.size : s * self.size + step.ahead.shape[1]]
            before = step.before @ before + step.ahead @ window
            found[s * self.size : (s + 1) * self.size] = before
        return found

    def adjoint(self, y: Floats) -> Floats:
        """Return ``T' y``, shape (H N n, ...)."""
        if not self.steps:
            return y
        after = np.zeros((self.size, *y.shape[1:]))
        found = np.concatenate([np.zeros_like(y), after])
        for s in range(len(self.steps) - 1, -1, -1):
            step = self.steps[s]
            after = y[s * self.size : (s + 1) * self.size] + after
            window = slice(s * self.size, s * self.size + step.ahead.shape[1])
            found[window] += step.ahead.T @ after
            after = step.before.T @ after
        return found[: len(y)]


def _split(matrix: sparse.csr_array, size: int) -> Step:
    """Take a policy's columns for x_{t-1} and for theta; those for linear terms cancel."""
    steps = (matrix.shape[1] // size - 1) // 2
    theta = (2 + 2 * np.arange(steps))[:, None] * size + np.arange(size)
    columns = sparse.csc_array(matrix)
    return Step(sparse.csr_array(columns[:, :size]), sparse.csr_array(columns[:, theta.ravel()]))
