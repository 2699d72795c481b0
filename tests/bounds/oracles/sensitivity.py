"""One local problem: how its solution follows what is held fixed around it."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """How the free variables of a local problem follow its boundary.

    ``free`` and ``boundary`` list (step, vertex), the bottom being step 0; ``part`` names
    each boundary variable ("lateral", "top", "bottom"); ``map`` (n |free|, n |boundary|).
    """

    free: list
    boundary: list
    part: np.ndarray
    map: np.ndarray
    n: int

    @cached_property
    def size(self):
        """Norms of the blocks of the map, (|free|, |boundary|)."""
        blocks = self.map.reshape(len(self.free), self.n, len(self.boundary), self.n)
        return np.linalg.norm(blocks, 2, axis=(1, 3))

    def gaps(self, graph):
        """Distances in time and in space between free and boundary variables."""
        (s, u), (t, w) = (np.array(z).T for z in (self.free, self.boundary))
        return np.abs(s[:, None] - t), graph.distance[u][:, w].astype(int)


def sensitivity(instance, v, k, r):
    """The local problem of (1, v): free steps 1 .. k-1, top k, bottom 0."""
    assert k <= instance.H
    graph, (M, C) = instance.graph, instance.gradient
    free = instance.free(1, v, k, r)
    inside = np.flatnonzero(graph.distance[v] <= r - 1)
    rim = np.flatnonzero(graph.distance[v] == r)
    lateral = [(s, u) for s in range(1, k) for u in rim]
    top, bottom = [(k, u) for u in inside], [(0, u) for u in inside]
    positions = instance.where(free)
    first = np.concatenate([np.arange(u * instance.n, (u + 1) * instance.n) for u in inside])
    across = np.hstack(
        [M[np.ix_(positions, instance.where(lateral + top))], C[positions][:, first]]
    )
    part = np.repeat(["lateral", "top", "bottom"], [len(lateral), len(top), len(bottom)])
    moved = -np.linalg.solve(M[np.ix_(positions, positions)], across)
    return Sensitivity(free, lateral + top + bottom, part, moved, instance.n)
