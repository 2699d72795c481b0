"""Local problems of equal size, gathered so that they are solved together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from .arrays import Floats, Ints
from .blocks import Blocks
from .information import Balls
from .problem import Problem
from .scatter import scatter


@dataclass(frozen=True, eq=False)
class Links:
    """Edges from free members of balls: agent a of the cohort, its i-th member, and the other end.

    ``flip`` says that the member is the larger end, so that its block is the transpose.
    """

    a: Ints
    i: Ints
    other: Ints  # a position in the ball (inside) or an agent of the network (rim)
    edge: Ints
    flip: NDArray[np.bool_]

    def blocks(self, across: Floats) -> Floats:
        """Return the block (member, other end) of every link, shape (m, n, n)."""
        block = across[self.edge]
        return np.where(self.flip[:, None, None], block.swapaxes(1, 2), block)

    def subset(self, renumber: Ints) -> Links:
        """Return the links of the agents that have a new number ``>= 0``."""
        a = renumber[self.a]
        kept = a >= 0
        return Links(a[kept], self.i[kept], self.other[kept], self.edge[kept], self.flip[kept])


@dataclass(frozen=True, eq=False)
class Cohort:
    """Agents whose inner balls ``N_v^{r-1}`` have the same number of members.

    Parameters
    ----------
    agents : ndarray, shape (A,)
    ball : ndarray, shape (A, b)
        The inner balls, each by (distance, agent): the agent itself comes first.
    inside : Links
        Every edge within a ball, from both of its ends.
    rim : Links
        Every edge from a ball to an agent at distance r.
    """

    agents: Ints
    ball: Ints
    inside: Links
    rim: Links

    def matrices(self, blocks: Blocks, t: int, m: int) -> Floats:
        """Return the Hessians of the local problems of steps ``t..t+m-1``.

        Shape (A, m b n, m b n): the free actions by step, member and entry.
        """
        A, b = self.ball.shape
        n = blocks.linear.shape[2]
        found = np.zeros((A, m, b, n, m, b, n))
        every = np.arange(b)
        for j in range(m):
            found[:, j, every, :, j, every, :] = blocks.own(t + j)[self.ball].swapaxes(0, 1)
            links = self.inside
            found[links.a, j, links.i, :, j, links.other, :] = links.blocks(blocks.across(t + j))
            if j:
                back = blocks.back(t + j)[self.ball].swapaxes(0, 1)
                found[:, j, every, :, j - 1, every, :] = back
                found[:, j - 1, every, :, j, every, :] = back.swapaxes(2, 3)
        return found.reshape(A, m * b * n, m * b * n)

    def matrix(self, blocks: Blocks, t: int, m: int) -> sparse.csc_array:
        """Return the same, sparse, for a cohort of one agent."""
        b, n = self.ball.shape[1], blocks.linear.shape[2]
        links, every, u = self.inside, np.arange(b), self.ball[0]
        rows, columns, values = [], [], []
        for j in range(m):
            back = blocks.back(t + j)[u]
            parts = [(every, j, every, blocks.own(t + j)[u])]
            parts.append((links.i, j, links.other, links.blocks(blocks.across(t + j))))
            if j:
                parts.append((every, j - 1, every, back))
            for i, earlier, other, block in parts:
                rows.append((j * b + i) * n)
                columns.append((earlier * b + other) * n)
                values.append(block)
            if j:
                rows.append(((j - 1) * b + every) * n)
                columns.append((j * b + every) * n)
                values.append(back.swapaxes(1, 2))
        size = m * b * n
        return scatter(
            np.concatenate(rows), np.concatenate(columns), np.concatenate(values), (size, size)
        ).tocsc()

    def subset(self, some: Ints) -> Cohort:
        """Return the cohort of some of the agents, by their positions, increasing or not."""
        if len(some) == len(self.agents) and np.array_equal(some, np.arange(len(some))):
            return self
        renumber = np.full(len(self.agents), -1)
        renumber[some] = np.arange(len(some))
        return Cohort(
            self.agents[some],
            self.ball[some],
            self.inside.subset(renumber),
            self.rim.subset(renumber),
        )


def cohorts(problem: Problem, r: int, largest: int) -> Iterator[Cohort]:
    """Yield all agents in cohorts.

    Parameters
    ----------
    problem : Problem
    r : int
        The communication radius, at least 1.
    largest : int
        The number of members that the balls of one cohort may have in all; more than one agent
        with larger balls come one by one.
    """
    inner = Balls.of(problem.network, r - 1)
    sizes = np.diff(inner.start)
    order = np.argsort(sizes, kind="stable")
    cuts = np.flatnonzero(np.diff(sizes[order])) + 1
    for run in np.split(order, cuts):
        size = int(sizes[run[0]])
        per = max(1, largest // size)
        for first in range(0, len(run), per):
            agents = run[first : first + per]
            ball = inner.members[inner.start[agents][:, None] + np.arange(size)]
            yield _cohort(problem, agents, ball)


def _cohort(problem: Problem, agents: Ints, ball: Ints) -> Cohort:
    """Find the edges that leave the members of the balls."""
    network, (A, b) = problem.network, ball.shape
    flat = ball.ravel()
    degrees = network.degrees[flat]
    member = np.repeat(np.arange(A * b), degrees)
    within = np.arange(len(member)) - np.repeat(np.cumsum(degrees) - degrees, degrees)
    entry = network.indptr[flat[member]] + within
    other = network.indices[entry].astype(np.int64)
    a, i = np.divmod(member, b)
    # where the other end lies in the same ball, if it does
    key = np.arange(A).repeat(b) * problem.N + flat
    by_key = np.argsort(key)
    sought = a * problem.N + other
    place = np.minimum(np.searchsorted(key, sought, sorter=by_key), len(key) - 1)
    here = by_key[place]
    inside = key[here] == sought
    edge, flip = problem.edge_of[entry], flat[member] > other
    return Cohort(
        agents,
        ball,
        Links(a[inside], i[inside], here[inside] % b, edge[inside], flip[inside]),
        Links(a[~inside], i[~inside], other[~inside], edge[~inside], flip[~inside]),
    )
