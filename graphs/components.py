"""The connected components of a network: what has a closed form, and what has to be searched."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .bitsearch import Adjacency
from .network import Network


@dataclass(frozen=True)
class Decomposition:
    """A network cut into what is needed for its profile.

    Parameters
    ----------
    path : int
        Vertices of the largest component that is a path (a single vertex is one); 0 if none is.
    cycle : int
        Vertices of the largest component that is a cycle; 0 if none is.
    rest : Adjacency, optional
        All components with a vertex of degree 3 or more, neighbours close to each other.
    """

    path: int
    cycle: int
    rest: Adjacency | None


def decompose(network: Network) -> Decomposition:
    """Split a network by component.

    Of the paths only the longest matters, its profile being the largest at every distance; the
    same holds for the cycles.
    """
    from scipy.sparse import csr_array
    from scipy.sparse.csgraph import connected_components, reverse_cuthill_mckee

    n = network.vertices
    ones = np.ones(len(network.indices), dtype=np.int8)
    # 32 bits throughout: what the routines of csgraph want
    matrix = csr_array((ones, network.indices, network.indptr.astype(np.int32)), shape=(n, n))
    count, component = connected_components(matrix, directed=False)
    degrees = network.degrees
    sizes = np.bincount(component, minlength=count)
    ends = np.bincount(component, weights=degrees, minlength=count) / 2
    thin = np.bincount(component, weights=degrees > 2, minlength=count) == 0
    path = int(sizes[thin & (ends == sizes - 1)].max(initial=0))
    cycle = int(sizes[thin & (ends == sizes)].max(initial=0))
    kept = np.flatnonzero(~thin[component])
    if not kept.size:
        return Decomposition(path, cycle, None)
    part = matrix[kept][:, kept]
    order = reverse_cuthill_mckee(part, symmetric_mode=True)
    return Decomposition(path, cycle, _permuted(part, component[kept], order))


def _permuted(matrix: object, component: NDArray[np.int32], order: NDArray[np.int32]) -> Adjacency:
    """Renumber the vertices: number ``order[i]`` becomes ``i``."""
    from scipy.sparse import csr_array

    part = csr_array(matrix)[order][:, order]
    return Adjacency(part.indptr.astype(np.int64), part.indices, component[order])
