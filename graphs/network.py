"""The finite communication graph: who may exchange information with whom."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from .errors import InputError

if TYPE_CHECKING:
    from collections.abc import Sequence

    import networkx as nx


@dataclass(frozen=True, eq=False)
class Network:
    """A finite simple undirected graph ``(V, E)`` as compressed adjacency lists.

    The neighbours of vertex ``v`` are ``indices[indptr[v]:indptr[v + 1]]``, in increasing order;
    every edge is stored at both of its ends. The graph need not be connected.

    Parameters
    ----------
    indptr : ndarray, shape (V + 1,), int64
        Where the list of each vertex begins.
    indices : ndarray, shape (2 E,), int32
        The lists, one after the other.
    names : tuple of str, length V
        What the source calls the vertices; all different.
    source : str
        Where the graph comes from: ``"ring:13"`` or the name of a file.
    transitive : bool
        Whether the graph is known to be vertex-transitive: all vertices see the same graph around
        them, so that one breadth-first search tells the distances from all.

    Raises
    ------
    InputError
        If there is no vertex, if the arrays are not the adjacency lists of a simple undirected
        graph, or if a graph that is called transitive is not regular.
    """

    indptr: NDArray[np.int64]
    indices: NDArray[np.int32]
    names: tuple[str, ...]
    source: str
    transitive: bool = False

    def __post_init__(self) -> None:
        """Check the structure, then make the arrays read-only copies."""
        indptr = np.array(self.indptr, dtype=np.int64)
        indices = np.array(self.indices, dtype=np.int32)
        _check(indptr, indices, self.names, self.source)
        if self.transitive and np.ptp(np.diff(indptr)) > 0:
            raise InputError(f"{self.source}: a vertex-transitive graph is regular, this is not")
        indptr.setflags(write=False)
        indices.setflags(write=False)
        object.__setattr__(self, "indptr", indptr)
        object.__setattr__(self, "indices", indices)

    @property
    def vertices(self) -> int:
        """Number of vertices, V."""
        return len(self.indptr) - 1

    @property
    def edges(self) -> int:
        """Number of edges, E."""
        return len(self.indices) // 2

    @cached_property
    def degrees(self) -> NDArray[np.int64]:
        """Number of neighbours of every vertex, shape (V,)."""
        degrees = np.diff(self.indptr)
        degrees.setflags(write=False)
        return degrees

    @property
    def max_degree(self) -> int:
        """The largest degree, Delta."""
        return int(self.degrees.max())

    def neighbours(self, vertex: int) -> NDArray[np.int32]:
        """Return the neighbours of one vertex in increasing order, shape (degree,)."""
        return self.indices[self.indptr[vertex] : self.indptr[vertex + 1]]

    @classmethod
    def from_edges(
        cls,
        n: int,
        edges: ArrayLike,
        *,
        names: Sequence[str] | None = None,
        source: str = "edges",
        transitive: bool = False,
    ) -> Network:
        """Build the graph on ``0, ..., n - 1`` from its edges, each listed once.

        Parameters
        ----------
        n : int
            Number of vertices, at least 1.
        edges : array_like of int, shape (E, 2)
            The two ends of every edge, in either order.
        names : sequence of str, optional
            Names of the vertices; their numbers if omitted.
        source : str
            Where the graph comes from, for messages and reports.
        transitive : bool
            Whether the graph is known to be vertex-transitive.

        Raises
        ------
        InputError
            On a self-loop, an edge listed twice, an end outside ``0..n-1``, or no vertex.
        """
        if n < 1:
            raise InputError(f"{source}: the graph has no vertices; at least one is needed")
        pairs = np.asarray(edges)
        pairs = pairs.reshape(-1, 2) if pairs.size == 0 else pairs
        if pairs.ndim != 2 or pairs.shape[1] != 2 or (pairs.size and pairs.dtype.kind not in "iu"):
            raise InputError(
                f"{source}: edges are integers of shape (E, 2), not {pairs.dtype} of {pairs.shape}"
            )
        outside = ((pairs < 0) | (pairs >= n)).any(axis=1)
        if outside.any():
            a, b = pairs[outside.argmax()]
            raise InputError(f"{source}: edge ({a}, {b}) leaves the vertices 0..{n - 1}")
        pairs = pairs.astype(np.int64)
        labels = tuple(map(str, range(n) if names is None else names))
        if len(labels) != n:
            raise InputError(f"{source}: {len(labels)} names for {n} vertices")
        keys = np.concatenate([pairs[:, 0] * n + pairs[:, 1], pairs[:, 1] * n + pairs[:, 0]])
        keys.sort()
        rows, indices = np.divmod(keys, n)
        indptr = np.concatenate([[0], np.cumsum(np.bincount(rows, minlength=n))])
        return cls(indptr, indices, labels, source, transitive)

    @classmethod
    def from_networkx(
        cls, graph: nx.Graph[Any], *, clean: bool = False, source: str = "networkx graph"
    ) -> Network:
        """Convert a NetworkX graph, vertices in its order; see `nearsight.graphs.convert`.

        Parameters
        ----------
        graph : networkx.Graph
            Simple and undirected, unless `clean`.
        clean : bool
            Drop directions, parallel edges and self-loops instead of rejecting them.
        source : str
            Where the graph comes from, for messages and reports.

        Raises
        ------
        InputError
            If the graph is directed, has parallel edges or self-loops, or has no vertex.
        """
        from .convert import from_networkx

        return from_networkx(graph, clean=clean, source=source)

    def to_networkx(self) -> nx.Graph[str]:
        """Return the graph as a NetworkX graph on the names, in the same order."""
        from .convert import to_networkx

        return to_networkx(self)


def _check(
    indptr: NDArray[np.int64], indices: NDArray[np.int32], names: tuple[str, ...], source: str
) -> None:
    """Raise `InputError` unless the arrays are sorted lists of a simple undirected graph."""
    n = len(indptr) - 1
    if n < 1:
        raise InputError(f"{source}: the graph has no vertices; at least one is needed")
    if indptr[0] != 0 or indptr[-1] != len(indices) or (np.diff(indptr) < 0).any():
        raise InputError(f"{source}: indptr does not divide the {len(indices)} indices into rows")
    if len(indices) and not 0 <= indices.min() <= indices.max() < n:
        raise InputError(f"{source}: an index leaves the vertices 0..{n - 1}")
    if len(names) != n or len(set(names)) != n:
        raise InputError(f"{source}: needs {n} different names, has {len(set(names))}")
    rows = np.repeat(np.arange(n), np.diff(indptr))
    loops = np.flatnonzero(rows == indices)
    if len(loops):
        at_loops = np.unique(rows[loops])  # from_edges stores each at both of its equal ends
        first = names[at_loops[0]]
        raise InputError(f"{source}: {len(at_loops)} self-loop(s), the first at vertex {first}")
    keys = rows * n + indices
    steps = np.diff(keys)
    if (steps == 0).any():
        at = int((steps == 0).argmax())
        a, b = names[rows[at]], names[indices[at]]
        count = int((steps == 0).sum()) // 2
        raise InputError(f"{source}: {count} parallel edge(s), the first between {a} and {b}")
    if (steps < 0).any() or not np.array_equal(np.sort(indices * np.int64(n) + rows), keys):
        raise InputError(f"{source}: the adjacency lists are not sorted, or not symmetric")
