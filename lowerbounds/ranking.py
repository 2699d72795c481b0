"""Which source is best on a large network: by a look at its surroundings only."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from ..bounds.decay import g
from ..graphs import Network
from ..lpc.arrays import Floats, Ints
from .sources import charges
from .spatial import Spatial, distances

EXACT = 600  # agents up to which nothing is left out
KEPT = 8  # candidates that are computed exactly
ROUGH = 1e-3


def candidates(spatial: Spatial, progress: Callable[[int, int], None] | None = None) -> Ints:
    r"""Return the sources worth an exact computation: all, or the most promising.

    With everything beyond distance ``r + m`` of j held at 0 in its place, entries of B only
    fall: the ratio of j so found is a lower bound on the true one, and off by about
    ``gamma_S^{2m}``.
    """
    network = spatial.network
    N = network.vertices
    if network.transitive:
        return np.arange(1)
    if N <= EXACT:
        return np.arange(N)
    rate = float(g(network.max_degree * spatial.a_S))
    m = 1 if rate == 0 else min(8, max(1, int(np.ceil(np.log(ROUGH) / (2 * np.log(rate))))))
    _, first = np.unique(colours(network, spatial.r + m + 1), return_index=True)
    found = np.empty(len(first))
    for c, j in enumerate(first):
        found[c] = _rough(spatial, distances(network, np.array([j]), spatial.r + m)[0], int(j))
        if progress is not None and c % 64 == 0:
            progress(c, len(first))
    return np.sort(first[np.argsort(-found, kind="stable")[:KEPT]])


def colours(network: Network, rounds: int) -> Ints:
    """Return numbers that are equal where the surroundings look alike, shape (N,).

    Colour refinement: the new colour is the old one with the multiset of the neighbours' colours,
    here by sums of scrambled 64-bit numbers.
    """
    found: Ints = np.zeros(network.vertices, dtype=np.int64)
    for _ in range(rounds):
        mixed = (found.astype(np.uint64) + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
        mixed ^= mixed >> np.uint64(29)
        mixed *= np.uint64(0xBF58476D1CE4E5B9)
        mixed ^= mixed >> np.uint64(32)
        sums = np.concatenate([[np.uint64(0)], np.cumsum(mixed[network.indices])])
        around = sums[network.indptr[1:]] - sums[network.indptr[:-1]]
        both = mixed * np.uint64(0x94D049BB133111EB) + around
        found = np.unique(both, return_inverse=True)[1].astype(np.int64)
    return found


def _rough(spatial: Spatial, distance: Floats, j: int) -> float:
    """Return the ratio of one source within a ball."""
    near = np.flatnonzero(np.isfinite(distance))
    system, *_ = spatial.system.part(near)
    inside = np.flatnonzero(distance[near] <= spatial.r)
    at = np.flatnonzero(near == j)
    return float(charges(system, at, lambda _: [inside]).ratios[0])
