"""The terms of all agents over a window of steps, laid out without any search."""

from __future__ import annotations

import numpy as np

from .problem import Problem
from .terms import Pairs, Terms


def whole(problem: Problem, first: int = 1, last: int | None = None) -> Terms:
    """Return ``Terms.of`` all actions of the steps ``first..last`` (1..H if omitted), one copy.

    The free actions are ordered by step and agent: row ``(t - first) N + v``. The fixed ones are
    those of all agents at ``first - 1``, then, if ``last < H``, at ``last + 1``.

    Parameters
    ----------
    problem : Problem
    first, last : int
        ``1 <= first <= last <= H``.
    """
    N, H = problem.N, problem.H
    last = H if last is None else last
    steps, agents = np.arange(first, last + 1), np.arange(N)
    F = len(steps) * N
    rows, v = np.arange(F), np.tile(agents, len(steps))
    t = np.repeat(steps, N)
    free = np.stack([np.zeros(F, dtype=np.int64), t, v], axis=1)
    outside = np.array([first - 1, last + 1] if last < H else [first - 1])
    fixed = np.stack([np.zeros(len(outside) * N, dtype=np.int64), np.repeat(outside, N)], axis=1)
    fixed = np.concatenate([fixed, np.tile(agents, len(outside))[:, None]], axis=1)
    before = np.concatenate([F + agents, rows[:-N]])
    ends = np.stack([rows, before], axis=1)
    if last < H:
        after = np.stack([F + N + agents, rows[-N:]], axis=1)
        ends, t = np.concatenate([ends, after]), np.concatenate([t, np.full(N, last + 1)])
        v = np.concatenate([v, agents])
    E = len(problem.edges)
    between = (problem.edges[None] + (N * np.arange(len(steps)))[:, None, None]).reshape(-1, 2)
    edges = np.tile(np.arange(E), len(steps))
    return Terms(
        problem,
        free,
        fixed,
        Pairs(problem.temporal, t, v, ends),
        Pairs(problem.spatial, np.repeat(steps, E), edges, between),
    )
