"""The exact profile of a finite graph: its largest spheres, balls and boundary counts."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import zip_longest

import numpy as np
from numpy.typing import NDArray

from .bitsearch import Adjacency, search
from .components import decompose
from .evaluate import Integers
from .network import Network
from .special import Lists, cycle_profile, path_profile, transitive_profile

Progress = Callable[[int, int], None]
BATCH_BYTES = 64 << 20
MAX_WORDS = 32  # narrower rows waste calls, wider ones blur a thin front; measured, and flat


@dataclass(frozen=True)
class Profile:
    """The values ``h(q)``, ``ball(q)`` and ``eta(q)`` (see `Growth`) for ``q = 0, ..., L``.

    Parameters
    ----------
    h, ball, eta : tuple of int, each of length L + 1
        The values.
    complete : bool
        Whether no two vertices of one component are farther apart than L.
    """

    h: tuple[int, ...]
    ball: tuple[int, ...]
    eta: tuple[int, ...]
    complete: bool


def network_profile(
    network: Network, radius: int | None = None, progress: Progress | None = None
) -> Profile:
    """Compute the profile of a network, up to a distance if one is given.

    Paths and cycles have closed forms; a vertex-transitive graph takes one breadth-first search.
    Everything else is searched from all vertices, in batches of up to 2048 sources held as bits.

    Parameters
    ----------
    network : Network
        May be disconnected: the maxima run over all vertices of all components.
    radius : int, optional
        The largest distance wanted; all if omitted.
    progress : callable, optional
        Called as ``progress(done, total)`` after every batch of sources.

    Returns
    -------
    Profile
        With ``L`` the largest distance, or `radius` if that is smaller.

    Raises
    ------
    ValueError
        If `radius` is negative.

    Notes
    -----
    One level costs one pass over the edges at the front for 64 sources together, so all V sources
    cost ``O(V E L / 64)`` word operations at worst, in practice far less: a row counts only while
    some source of the batch is about to reach it. Memory: bit matrices of 64 MB, and two counts
    for every vertex and distance, ``O(V L)``. Against a breadth-first search a vertex, in compiled
    code or not, see `benchmarks/graphs_profile.py`.
    """
    if radius is not None and radius < 0:
        raise ValueError(f"radius is at least 0, not {radius}")
    last = network.vertices if radius is None else radius
    if network.transitive:
        lists, complete = transitive_profile(network, last)
        return _largest([lists], complete)
    parts = decompose(network)
    found = []
    complete = True
    if parts.path:
        found.append(path_profile(parts.path, last))
        complete &= parts.path - 1 <= last
    if parts.cycle:
        found.append(cycle_profile(parts.cycle, last))
        complete &= parts.cycle // 2 <= last
    if parts.rest is not None:
        lists, all_seen = _searched(parts.rest, radius, progress)
        found.append(lists)
        complete &= all_seen
    return _largest(found, complete)


def _searched(
    graph: Adjacency, radius: int | None, progress: Progress | None
) -> tuple[Lists, bool]:
    """Search from every vertex; distances being symmetric, rows count what sources would."""
    n = graph.vertices
    words = min(MAX_WORDS, max(1, BATCH_BYTES // (8 * n)), -(-n // 64))
    kind = np.int32 if n * int(graph.degrees.max()) < 2**31 else np.int64
    spheres: list[Integers] = [np.ones(n, dtype=kind)]
    edges: list[Integers] = [np.zeros(n, dtype=kind)]

    def visit(
        q: int, rows: NDArray[np.int64], sphere: NDArray[np.int64], edge: NDArray[np.int64]
    ) -> None:
        if q == len(spheres):
            spheres.append(np.zeros(n, dtype=kind))
            edges.append(np.zeros(n, dtype=kind))
        spheres[q][rows] += sphere.astype(kind)
        edges[q][rows] += edge.astype(kind)

    complete = True
    starts = range(0, n, 64 * words)
    for done, start in enumerate(starts, start=1):
        sources = np.arange(start, min(start + 64 * words, n))
        complete &= search(graph, sources, radius, visit)
        if progress is not None:
            progress(done, len(starts))
    inside = np.zeros(n, dtype=np.int64)
    ball = []
    for sphere in spheres:
        inside += sphere
        ball.append(int(inside.max()))
    return ([int(s.max()) for s in spheres], ball, [int(e.max()) for e in edges]), complete


def _largest(parts: list[Lists], complete: bool) -> Profile:
    """Take the maxima over the components; a ball that has ended keeps its size."""
    length = max(len(h) for h, _, _ in parts)
    h = (max(column) for column in zip_longest(*(p[0] for p in parts), fillvalue=0))
    balls = (p[1] + [p[1][-1]] * (length - len(p[1])) for p in parts)
    ball = (max(column) for column in zip(*balls, strict=True))
    eta = (max(column) for column in zip_longest(*(p[2] for p in parts), fillvalue=0))
    return Profile(tuple(h), tuple(ball), tuple(eta), complete)
