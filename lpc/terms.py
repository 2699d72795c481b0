"""The cost of some actions while the others stay fixed: one problem, or many at once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse

from .arrays import Floats, Ints, at
from .costs import Cost
from .problem import Problem


@dataclass(frozen=True, eq=False)
class Pairs:
    """Costs of two actions: member i at step t, and the positions of its two arguments.

    A position below the number of free actions is a free action; the fixed ones follow.
    """

    cost: Cost
    t: Ints
    i: Ints
    ends: Ints  # shape (m, 2)

    def arguments(self, values: Floats) -> Floats:
        """Return w of every cost, shape (m, 2 n), from the values of all actions."""
        return values[self.ends].reshape(len(self.t), 2 * values.shape[1])

    def later(self, steps: int) -> Pairs:
        """Return the same costs some steps later."""
        return Pairs(self.cost, self.t + steps, self.i, self.ends)


@dataclass(frozen=True, eq=False)
class Terms:
    """All costs that touch a free action, in copies that do not touch one another.

    An action is named by (copy, step, agent). The offline problem has one copy in which every
    action of steps 1..H is free; the local problem of one agent has one copy; the local problems
    of many agents, solved together, have a copy each.

    Parameters
    ----------
    problem : Problem
    free : ndarray, shape (F, 3)
        The free actions, ordered by copy, step and agent.
    fixed : ndarray, shape (G, 3)
        The fixed actions that share a cost with a free one, in the same order; step 0 is x_0.
    temporal, spatial : Pairs
        Every temporal and every spatial cost with at least one free argument, once.
    """

    problem: Problem
    free: Ints
    fixed: Ints
    temporal: Pairs
    spatial: Pairs

    @classmethod
    def of(cls, problem: Problem, free: Ints) -> Terms:
        """Return the terms of free actions (copy, step, agent), of steps 1..H."""
        N, H = problem.N, problem.H
        key = _key(free, N, H)
        order = np.argsort(key)
        free, key = free[order], key[order]
        c, t, v = free.T
        later = _later(problem, free, key)
        temporal_t = np.concatenate([t, t[later] + 1])
        temporal_v = np.concatenate([v, v[later]])
        temporal_c = np.concatenate([c, c[later]])
        now = np.stack([temporal_c, temporal_t, temporal_v], axis=1)
        before = now - np.array([0, 1, 0])
        edge, row = _incident(problem, free, key)
        u, w = problem.edges[edge].T
        ends = [np.stack([c[row], t[row], x], axis=1) for x in (u, w)]
        keys = [_key(x, N, H) for x in (now, before, *ends)]
        outside = np.setdiff1d(np.concatenate(keys), key)
        where = [_position(x, key, outside) for x in keys]
        return cls(
            problem,
            free,
            _unkey(outside, N, H),
            Pairs(problem.temporal, temporal_t, temporal_v, np.stack(where[:2], axis=1)),
            Pairs(problem.spatial, t[row], edge, np.stack(where[2:], axis=1)),
        )

    def later(self, steps: int) -> Terms:
        """Return the same terms some steps later; no term may meet the horizon in either place."""
        shift = np.array([0, steps, 0])
        found = Terms(
            self.problem,
            self.free + shift,
            self.fixed + shift,
            self.temporal.later(steps),
            self.spatial.later(steps),
        )
        found.__dict__["_gather"] = self._gather
        return found

    @cached_property
    def _gather(self) -> sparse.csr_array:
        """Sums the gradients of pairs, end by end, into those of the free actions."""
        ends = np.concatenate([self.temporal.ends.ravel(), self.spatial.ends.ravel()])
        mine = np.flatnonzero(ends < len(self.free))
        shape = (len(self.free), len(ends))
        return sparse.csr_array((np.ones(len(mine)), (ends[mine], mine)), shape=shape)

    def value(self, x: Floats, fixed: Floats) -> float:
        """Return the sum of the terms: x of shape (F, n), the fixed actions of shape (G, n)."""
        return float(sum(part.sum() for part in self.parts(x, fixed)))

    def parts(self, x: Floats, fixed: Floats) -> tuple[Floats, Floats, Floats]:
        """Return node, temporal and spatial costs one by one."""
        values = np.concatenate([x, fixed])
        node = self.problem.node.value(self.free[:, 1], self.free[:, 2], x)
        temporal, spatial = (
            p.cost.value(p.t, p.i, p.arguments(values)) for p in (self.temporal, self.spatial)
        )
        return node, temporal, spatial

    def gradient(self, x: Floats, fixed: Floats) -> Floats:
        """Return the gradient in the free actions, shape (F, n)."""
        n = self.problem.n
        values = np.concatenate([x, fixed])
        pairs = np.concatenate(
            [
                p.cost.gradient(p.t, p.i, p.arguments(values)).reshape(-1, n)
                for p in (self.temporal, self.spatial)
            ]
        )
        own = self.problem.node.gradient(self.free[:, 1], self.free[:, 2], x)
        found: Floats = own + self._gather @ pairs
        return found

    def hessian(self, x: Floats, fixed: Floats) -> tuple[sparse.csr_array, sparse.csr_array]:
        """Return the Hessian in the free actions, and its cross block with the fixed ones.

        Shapes (F n, F n) and (F n, G n).
        """
        n, F, G = self.problem.n, len(self.free), len(self.fixed)
        values = np.concatenate([x, fixed])
        own = self.problem.node.hessian(self.free[:, 1], self.free[:, 2], x)
        blocks, rows, columns = [own], [np.arange(F)], [np.arange(F)]
        for p in (self.temporal, self.spatial):
            H = p.cost.hessian(p.t, p.i, p.arguments(values)).reshape(-1, 2, n, 2, n)
            for a in range(2):
                for b in range(2):
                    mine = p.ends[:, a] < F
                    blocks.append(H[mine, a, :, b, :])
                    rows.append(p.ends[mine, a])
                    columns.append(p.ends[mine, b])
        block, i, j = (np.concatenate(z) for z in (blocks, rows, columns))
        inner = np.arange(n)
        big_i = np.broadcast_to(i[:, None, None] * n + inner[:, None], block.shape)
        big_j = np.broadcast_to(j[:, None, None] * n + inner, block.shape)
        whole = sparse.csr_array(
            (block.ravel(), (big_i.ravel(), big_j.ravel())), shape=(F * n, (F + G) * n)
        )
        return whole[:, : F * n], whole[:, F * n :]

    @cached_property
    def scale(self) -> tuple[Floats, Floats]:
        """Numbers ``m_j, d_j`` with ``diag(m) <= Hessian <= diag(d)``, one a free action.

        Each pair cost with Hessian ``<= l I`` adds l to both its ends, so that each d depends on
        nothing but the costs that touch the action.
        """
        node = self.problem.node.curvature()
        t, v = self.free[:, 1], self.free[:, 2]
        lower = at(node.lower - node.error, t, v)
        ends, size = [], []
        for p in (self.temporal, self.spatial):
            curvature = p.cost.curvature()
            top = at(curvature.upper + curvature.error, p.t, p.i)
            ends.append(p.ends.ravel())
            size.append(np.repeat(top, 2))
        where, weight = np.concatenate(ends), np.concatenate(size)
        mine = where < len(self.free)
        upper = at(node.upper + node.error, t, v)
        upper = upper + np.bincount(where[mine], weight[mine], minlength=len(self.free))
        return lower, upper


def _key(actions: Ints, N: int, H: int) -> Ints:
    """Number the actions (copy, step, agent) in their order; steps 0..H+1."""
    found: Ints = (actions[:, 0] * (H + 2) + actions[:, 1]) * N + actions[:, 2]
    return found


def _unkey(key: Ints, N: int, H: int) -> Ints:
    rest, v = np.divmod(key, N)
    c, t = np.divmod(rest, H + 2)
    return np.stack([c, t, v], axis=1)


def _position(key: Ints, free: Ints, fixed: Ints) -> Ints:
    """Return the position of every action among the free ones, then the fixed ones."""
    if not len(free):
        return np.searchsorted(fixed, key)
    first = np.searchsorted(free, key)
    inside = free[np.minimum(first, len(free) - 1)] == key
    return np.where(inside, first, len(free) + np.searchsorted(fixed, key))


def _later(problem: Problem, free: Ints, key: Ints) -> Ints:
    """Return the rows whose next step is within the horizon and not free itself."""
    following = np.isin(key + problem.N, key, assume_unique=True)
    return np.flatnonzero((free[:, 1] < problem.H) & ~following)


def _incident(problem: Problem, free: Ints, key: Ints) -> tuple[Ints, Ints]:
    """Return every (edge, row) with an end in the row, once if both ends are free."""
    degrees = problem.network.degrees[free[:, 2]]
    row = np.repeat(np.arange(len(free)), degrees)
    first = problem.network.indptr[free[:, 2]]
    inside = np.arange(len(row)) - np.repeat(np.cumsum(degrees) - degrees, degrees)
    entry = first[row] + inside
    other = problem.network.indices[entry].astype(np.int64)
    mine = free[row, 2]
    partner = key[row] - mine + other
    both = np.isin(partner, key)
    kept = ~both | (mine < other)
    return problem.edge_of[entry[kept]], row[kept]
