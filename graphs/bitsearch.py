"""Breadth-first search from many sources at once, one bit a source."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

Words = NDArray[np.uint64]
Counts = NDArray[np.int64]

CHUNK_WORDS = 1 << 15  # the buffers of one chunk of rows stay in the second-level cache
FEW = 8  # rows too few to share a call go one by one, through all their neighbours at once


@dataclass(frozen=True)
class Adjacency:
    """Adjacency lists as in `Network`, with the number of the component of every vertex."""

    indptr: NDArray[np.int64]
    indices: NDArray[np.int32]
    component: NDArray[np.int32]
    degrees: NDArray[np.int64] = field(init=False)

    def __post_init__(self) -> None:
        """Derive the degrees."""
        object.__setattr__(self, "degrees", np.diff(self.indptr))

    @property
    def vertices(self) -> int:
        """Number of vertices."""
        return len(self.degrees)


def search(
    graph: Adjacency,
    sources: NDArray[np.int64],
    radius: int | None,
    visit: Callable[[int, NDArray[np.int64], Counts, Counts], None],
) -> bool:
    """Report, level by level, how many sources reach each vertex, and through how many edges.

    Row ``v`` of a bit matrix holds the sources that have just reached ``v``. A level takes, for
    the rows that can still change, the union over the neighbours, without what was seen before.
    Rows that do not touch a row changed on the last level, or that all sources of their component
    have reached, are left out, so that thin fronts cost what they contain.

    Parameters
    ----------
    graph : Adjacency
    sources : ndarray of int, shape (S,)
        Different vertices; best close to each other.
    radius : int, optional
        The last level wanted.
    visit : callable
        Called as ``visit(q, rows, spheres, edges)``: `spheres[i]` is the number of sources ``s`` at
        distance ``q`` from ``v = rows[i]``, and `edges[i]` the sum over these of the number of
        neighbours ``w`` of ``v`` with ``d(w, s) = q - 1``.

    Returns
    -------
    bool
        Whether all levels were visited.
    """
    words = -(-len(sources) // 64)
    bits = np.arange(len(sources))
    front: Words = np.zeros((graph.vertices, words), dtype=np.uint64)
    front[sources, bits // 64] = np.uint64(1) << (bits % 64).astype(np.uint64)
    unseen = ~front
    missing = np.bincount(graph.component[sources], minlength=int(graph.component.max()) + 1)
    missing = missing[graph.component]
    missing[sources] -= 1
    active, level = sources, 0
    while active.size:
        rows = _candidates(graph, active, missing)
        if radius is not None and level >= radius:
            return not rows.size
        level += 1
        reached, fresh = [], []
        for part in _chunks(graph, rows, words):
            new, edges = _expand(graph, front, unseen, part)
            spheres = _popcount(new)
            changed = spheres > 0
            part, new, spheres = part[changed], new[changed], spheres[changed]
            unseen[part] ^= new
            missing[part] -= spheres
            visit(level, part, spheres, edges[changed])
            reached.append(part)
            fresh.append(new)
        front[active] = 0
        for part, new in zip(reached, fresh, strict=True):
            front[part] = new
        active = np.concatenate(reached) if reached else rows
    return True


def _candidates(graph: Adjacency, active: NDArray[np.int64], missing: Counts) -> Counts:
    """Return the vertices that touch an active one and that some source has not reached."""
    mark = np.zeros(graph.vertices, dtype=bool)
    lengths = graph.degrees[active]
    starts = graph.indptr[active] - (np.cumsum(lengths) - lengths)
    mark[graph.indices[np.repeat(starts, lengths) + np.arange(lengths.sum())]] = True
    rows = np.flatnonzero(mark)
    return rows[missing[rows] > 0]


def _chunks(graph: Adjacency, rows: Counts, words: int) -> list[Counts]:
    """Cut the rows into chunks for the cache, each ordered by falling degree."""
    size = max(CHUNK_WORDS // words, FEW)
    parts = [rows[i : i + size] for i in range(0, len(rows), size)]
    return [part[np.argsort(-graph.degrees[part], kind="stable")] for part in parts]


def _expand(graph: Adjacency, front: Words, unseen: Words, rows: Counts) -> tuple[Words, Counts]:
    """Return what is new at each row, and over how many edges it arrives.

    The j-th neighbours of all rows are taken together: with the rows in order of falling degree
    those that have one come first.
    """
    new = np.zeros((len(rows), front.shape[1]), dtype=np.uint64)
    edges = np.zeros(len(rows), dtype=np.int64)
    wanted = unseen[rows]
    first, falling = graph.indptr[rows], -graph.degrees[rows]
    buffer = np.empty_like(wanted)
    j, n = 0, len(rows)
    while n >= FEW or (n and falling[0] >= -FEW - j):
        arriving = buffer[:n]
        # the indices are known to be valid, and mode="clip" spares a copy of the result
        np.take(front, graph.indices[first[:n] + j], axis=0, out=arriving, mode="clip")
        arriving &= wanted[:n]
        edges[:n] += _popcount(arriving)
        new[:n] |= arriving
        j += 1
        n = int(np.searchsorted(falling, -j, side="left"))
    for i in range(n):
        arriving = front[graph.indices[first[i] + j : first[i] - falling[i]]] & wanted[i]
        edges[i] += int(_popcount(arriving).sum())
        new[i] |= np.bitwise_or.reduce(arriving, axis=0)
    return new, edges


def _popcount(rows: Words) -> Counts:
    """Return the number of bits set in each row."""
    # a product with ones is by far the fastest sum of bytes, and exact below 2^24
    counts = np.bitwise_count(rows).astype(np.float32)
    return (counts @ np.ones(rows.shape[1], dtype=np.float32)).astype(np.int64)
