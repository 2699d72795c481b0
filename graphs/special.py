"""Profiles that need no search from every vertex: paths, cycles, vertex-transitive graphs."""

from __future__ import annotations

import numpy as np

from .network import Network

Lists = tuple[list[int], list[int], list[int]]


def path_profile(n: int, last: int) -> Lists:
    """``h, ball, eta`` of the path of `n` vertices at the distances ``0..min(n - 1, last)``.

    ``h(q) = 2`` while ``2 q <= n - 1``, then 1; ``ball(q) = min(2 q + 1, n)``; ``eta = h``, since
    a tree approaches every vertex by one edge.
    """
    distances = range(min(n - 1, last) + 1)
    h = [1 if q == 0 or 2 * q > n - 1 else 2 for q in distances]
    return h, [min(2 * q + 1, n) for q in distances], [0, *h[1:]]


def cycle_profile(n: int, last: int) -> Lists:
    """``h, ball, eta`` of the cycle of `n` vertices at the distances ``0..min(n // 2, last)``.

    ``h(q) = eta(q) = 2``, but an even cycle has one opposite vertex, approached from both sides.
    """
    distances = range(min(n // 2, last) + 1)
    h = [1 if q == 0 or 2 * q == n else 2 for q in distances]
    return h, [min(2 * q + 1, n) for q in distances], [2 if q else 0 for q in distances]


def transitive_profile(network: Network, last: int) -> tuple[Lists, bool]:
    """``h, ball, eta`` of a vertex-transitive graph, and whether that is all of it.

    One breadth-first search from vertex 0 tells the spheres of all vertices, and `eta` too:
    summed over all ``u``, what `eta` counts is the number of triples ``(u, w, v)`` with ``w``
    adjacent to ``u``, ``d(u, v) = q`` and ``d(w, v) = q - 1``; summed over ``v`` instead, these
    are the edges between two spheres around ``v``. Both sums have V equal terms.
    """
    distance = np.full(network.vertices, -1, dtype=np.int64)
    distance[0] = 0
    front = np.zeros(1, dtype=np.int64)
    h, ball, eta = [1], [1], [0]
    while True:
        lengths = network.degrees[front]
        starts = network.indptr[front] - (np.cumsum(lengths) - lengths)
        heads = network.indices[np.repeat(starts, lengths) + np.arange(lengths.sum())]
        outward = heads[distance[heads] < 0]
        if not outward.size or len(h) > last:
            return (h, ball, eta), not outward.size
        eta.append(len(outward))
        distance[outward] = len(h)
        front = np.unique(outward).astype(np.int64)
        h.append(len(front))
        ball.append(ball[-1] + len(front))
