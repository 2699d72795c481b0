"""What an agent may know: balls of the graph, windows of time, and their boundaries."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import sparse

from ..graphs import InputError, Network
from .arrays import Ints, integer


@dataclass(frozen=True, eq=False)
class Balls:
    """The balls ``N_v^r = {u : d(u, v) <= r}`` of all agents, each ordered by (distance, u).

    The ball of v is ``members[start[v]:start[v + 1]]``, its distances lie beside it. Because of
    the order ``N_v^q``, ``q < r``, is the beginning of ``N_v^r``, and the rest is a boundary.

    Parameters
    ----------
    radius : int
        The radius r.
    start : ndarray, shape (N + 1,)
    members : ndarray, shape (start[N],)
    distance : ndarray, shape (start[N],)
    """

    radius: int
    start: Ints
    members: Ints
    distance: Ints

    @classmethod
    def of(cls, network: Network, radius: int) -> Balls:
        """Return the balls of one radius ``>= 0`` around every vertex."""
        N = network.vertices
        ones = np.ones(len(network.indices), dtype=np.int8)
        step = sparse.csr_array((ones, network.indices, network.indptr), shape=(N, N)).astype(bool)
        keys = [np.arange(N, dtype=np.int64) * (N + 1)]
        seen = level = sparse.csr_array(sparse.eye_array(N, dtype=bool))
        for _ in range(radius):
            level = _without(level @ step, seen)
            if level.nnz == 0:
                break
            rows = np.repeat(np.arange(N, dtype=np.int64), np.diff(level.indptr))
            keys.append(rows * N + level.indices)
            seen = seen + level
        distance = np.repeat(np.arange(len(keys)), [len(k) for k in keys])
        key = np.concatenate(keys)
        owner, member = np.divmod(key, N)
        order = np.lexsort((member, distance, owner))
        start = np.concatenate([[0], np.cumsum(np.bincount(owner, minlength=N))])
        return cls(radius, start, member[order], distance[order])

    @cached_property
    def owner(self) -> Ints:
        """The agent whose ball each entry belongs to, shape (start[N],)."""
        return np.repeat(np.arange(len(self.start) - 1), np.diff(self.start))

    def ball(self, v: int, radius: int | None = None) -> Ints:
        """Return ``N_v^q`` for one agent and ``q <= r`` (r if omitted), by (distance, u)."""
        here = slice(self.start[v], self.start[v + 1])
        members = self.members[here]
        return members if radius is None else members[self.distance[here] <= radius]

    def within(self, radius: int) -> Balls:
        """Return the balls of a smaller radius; -1 gives empty ones."""
        kept = self.distance <= radius
        counts = np.bincount(self.owner[kept], minlength=len(self.start) - 1)
        start = np.concatenate([[0], np.cumsum(counts)])
        return Balls(radius, start, self.members[kept], self.distance[kept])


def _without(a: sparse.csr_array, b: sparse.csr_array) -> sparse.csr_array:
    """Return the pattern of a without that of b."""
    kept = sparse.csr_array(a.astype(np.int8) - a.multiply(b).astype(np.int8))
    kept.eliminate_zeros()
    return kept.astype(bool)


@dataclass(frozen=True, eq=False)
class InformationSet:
    """``N_(t,v)^(k,r)``, the free variables inside it, and its boundary.

    All are lists of (step, agent) of shape (m, 2), ordered by step, then by distance from v, then
    by agent. Steps beyond the horizon are listed too, as in the paper.

    Parameters
    ----------
    t, v : int
        The step and the agent that decides.
    k, r : int
        Prediction horizon ``>= 1`` and communication radius ``>= 0``.
    inner, outer : ndarray
        ``N_v^{r-1}`` and ``N_v^r``.

    References
    ----------
    Paper, Section 1 (Notation) and Algorithm 1 (``alg:LPC``).
    """

    t: int
    v: int
    k: int
    r: int
    inner: Ints
    outer: Ints

    @property
    def everything(self) -> Ints:
        """``N_(t,v)^(k,r)``: the pairs whose costs are known."""
        return _product(self.t, self.k, self.outer)

    @property
    def free(self) -> Ints:
        """``N_(t,v)^(k-1,r-1)``: the pairs the local problem decides on."""
        return _product(self.t, self.k - 1, self.inner)

    @property
    def boundary(self) -> Ints:
        """``partial N_(t,v)^(k,r)``: the pairs that are known and not free."""
        rim = self.outer[len(self.inner) :] if self.k > 1 else self.outer
        sides = _product(self.t, self.k - 1, rim)
        return np.concatenate([sides, _product(self.t + self.k - 1, 1, self.outer)])

    @property
    def bottom(self) -> Ints:
        """``{t - 1} x N_v^r``: the pairs whose actions have been taken."""
        return _product(self.t - 1, 1, self.outer)


def information_set(network: Network, t: int, v: int, k: int, r: int) -> InformationSet:
    """Return what agent v knows at step t with prediction horizon k and radius r.

    Raises
    ------
    InputError
        If k or r is out of range, or there is no such agent.
    """
    check_sight(k, r)
    if not 0 <= v < network.vertices:
        raise InputError(f"v = {v}: there are the agents 0..{network.vertices - 1}", "v")
    distance = np.full(network.vertices, -1)
    distance[v] = 0
    found, level = [np.array([v], dtype=np.int64)], np.array([v], dtype=np.int64)
    for q in range(1, r + 1):
        near = np.unique(np.concatenate([network.neighbours(int(u)) for u in level]))
        level = near[distance[near] < 0].astype(np.int64)
        if not len(level):
            break
        distance[level] = q
        found.append(level)
    outer = np.concatenate(found)
    return InformationSet(t, v, k, r, outer[distance[outer] <= r - 1], outer)


def check_sight(k: int, r: int) -> None:
    """Raise `InputError` unless k is an integer >= 1 and r an integer >= 0."""
    integer(k, "k", 1)
    integer(r, "r", 0)


def _product(t: int, steps: int, agents: Ints) -> Ints:
    times = np.repeat(np.arange(t, t + max(steps, 0)), len(agents))
    return np.stack([times, np.tile(agents, max(steps, 0))], axis=1)
