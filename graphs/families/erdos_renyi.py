"""The random graph of Erdos and Renyi."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "erdos-renyi"
SYNTAX = "erdos-renyi:NxP"
DESCRIPTION = "N vertices, every pair joined with probability P"
RANDOM = True
TRANSITIVE = False
PARAMETERS = (
    int,
    float,
)


def build(size: int, probability: float, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges, shape (E, 2), of NetworkX's ``fast_gnp_random_graph``.

    Raises
    ------
    InputError
        Unless ``N >= 1`` and ``0 <= P <= 1``.
    """
    import networkx as nx

    given = f"{size}x{probability:g}"
    require(size >= 1 and 0 <= probability <= 1, SYNTAX, "N >= 1 and 0 <= P <= 1", given)
    require_size(size, SYNTAX)
    require_size(probability * size * (size - 1) / 2, SYNTAX)
    graph = nx.fast_gnp_random_graph(size, probability, seed=seed)
    return size, np.array(list(graph.edges()), dtype=np.int64).reshape(-1, 2)
