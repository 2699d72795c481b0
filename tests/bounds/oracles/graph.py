"""Small graphs, with distances by scipy."""

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from scipy.sparse.csgraph import shortest_path


@dataclass(frozen=True, eq=False)
class Graph:
    """Vertices 0 .. N-1 and edges (E, 2); distances by scipy."""

    vertices: int
    edges: np.ndarray

    @classmethod
    def of(cls, network):
        """Take vertices and edges, and nothing else, from a nearsight `Network`."""
        ends = [(u, int(v)) for u in range(network.vertices) for v in network.neighbours(u)]
        edges = np.array([e for e in ends if e[0] < e[1]], dtype=int)
        return cls(network.vertices, edges.reshape(-1, 2))

    @cached_property
    def distance(self):
        matrix = np.zeros((self.vertices, self.vertices))
        matrix[tuple(self.edges.T)] = 1
        return shortest_path(matrix, directed=False, unweighted=True)

    @cached_property
    def degree(self):
        return int(np.bincount(self.edges.ravel(), minlength=self.vertices).max())


def connected_graph(vertices, parents, extra):
    """A spanning tree (``parents[i-1] < i`` after a modulo) and a choice of other edges."""
    tree = {(p % i, i) for i, p in zip(range(1, vertices), parents, strict=True)}
    others = [e for e in combinations(range(vertices), 2) if e not in tree]
    chosen = {others[i % len(others)] for i in extra} if others else set()
    return Graph(vertices, np.array(sorted(tree | chosen), dtype=int).reshape(-1, 2))
