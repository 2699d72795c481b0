"""The minimisers of the node costs alone, which LPC puts on its boundaries."""

from __future__ import annotations

import numpy as np

from ..graphs import NearsightError
from .arrays import Floats, Ints, at
from .certify import norms
from .costs import Quadratic
from .problem import Problem
from .sets import Box, Everywhere
from .slope import Booleans
from .solve import solve
from .terms import Pairs, Terms

CHUNK = 20_000  # actions at a time
ACCEPTED = 1e-9  # relative error, proven, of a minimiser whose iteration ended before its goal


def node_minimisers(problem: Problem) -> Floats:
    """Return ``theta_t^v = argmin of f_t^v over D_t^v``, shape (H, N, n), read-only.

    Each depends, bit for bit, on nothing but its own f and D. For a quadratic f it is the centre
    where that is feasible, and the projection of the centre where the minimiser is known to be
    that: n = 1, a Hessian that is a multiple of the identity, or a diagonal one and a box. All
    others come from an iteration, to a relative accuracy of about 1e-13.

    Raises
    ------
    InputError
        If the sets have no projection and one of them has no interior.
    NearsightError
        If the iteration for a minimiser got stuck; the message names its step and agent.

    References
    ----------
    Paper, Algorithm 1 (``alg:LPC``).
    """
    T, N, n = _steps(problem), problem.N, problem.n
    found = np.empty((T * N, n))
    for begin in range(0, T * N, CHUNK):
        place = np.arange(begin, min(begin + CHUNK, T * N))
        found[place] = minimisers_at(problem, place // N + 1, place % N)
    whole = np.broadcast_to(found.reshape(T, N, n), (problem.H, N, n))
    whole.setflags(write=False)
    return whole


def alone(problem: Problem, t: Ints, v: Ints) -> Terms:
    """Return node costs without any coupling, as terms with a copy for every (t, v)."""
    free = np.stack([np.arange(len(t)), t, v], axis=1)
    none, ends = np.zeros(0, dtype=np.int64), np.zeros((0, 2), dtype=np.int64)
    temporal, spatial = (
        Pairs(cost, none, none, ends) for cost in (problem.temporal, problem.spatial)
    )
    return Terms(problem, free, np.zeros((0, 3), dtype=np.int64), temporal, spatial)


def minimisers_at(problem: Problem, t: Ints, v: Ints) -> Floats:
    """Return the minimisers of the node costs of steps t and agents v, shape (m, n)."""
    node, feasible = problem.node, problem.feasible
    found = np.zeros((len(t), problem.n))
    left = np.ones(len(t), dtype=bool)
    if isinstance(node, Quadratic):
        found = np.array(at(node.centre, t, v))
        left = feasible.violation(t, v, found) > 0
        if feasible.projectable and left.any():
            found[left] = feasible.project(t[left], v[left], found[left])
            left &= ~_separable(problem, t, v)
    if left.any():
        found[left] = _iterated(problem, t[left], v[left])
    return found


def _separable(problem: Problem, t: Ints, v: Ints) -> Booleans:
    """Return where the nearest point to the centre of a quadratic is also the cheapest one."""
    n = problem.n
    matrix = problem.node.hessian(t, v, np.zeros((len(t), n)))
    diagonal = np.einsum("mii->mi", matrix)
    plain: Booleans = (matrix == diagonal[:, :, None] * np.eye(n)).all(axis=(1, 2))
    if isinstance(problem.feasible, Box):
        return plain
    even: Booleans = plain & (diagonal == diagonal[:, :1]).all(axis=1)
    return even


def _iterated(problem: Problem, t: Ints, v: Ints) -> Floats:
    n = problem.n
    start = np.zeros((len(t), n))
    if not problem.feasible.everywhere and not problem.feasible.projectable:
        start = np.broadcast_to(problem.feasible.interior(t, v), (len(t), n))
    found = solve(alone(problem, t, v), np.zeros((0, n)), start=start, tolerance=1e-13)
    scale = norms(found.x) + norms(found.x - start)
    close = found.error <= ACCEPTED * scale
    bad = np.flatnonzero(~(np.isfinite(found.x).all(axis=1) & (found.converged | close)))
    if len(bad):
        j = bad[0]
        raise NearsightError(
            f"node cost at step {t[j]}, agent {v[j]}: its minimiser over the feasible set was not "
            f"found; what was found is off by at most {found.error[j]:.3g}"
        )
    return found.x


def _steps(problem: Problem) -> int:
    """Return how many steps have minimisers of their own: 1 where it is known to be one."""
    node, feasible = problem.node, problem.feasible
    parts: list[int] = []
    if isinstance(node, Quadratic):
        parts += [node.matrix.shape[0], node.centre.shape[0]]
    if isinstance(feasible, Box):
        parts += [feasible.lower.shape[0], feasible.upper.shape[0]]
    known = isinstance(node, Quadratic) and isinstance(feasible, Box | Everywhere)
    return 1 if known and max(parts) == 1 else problem.H
