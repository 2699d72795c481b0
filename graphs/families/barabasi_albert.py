"""The preferential attachment graph of Barabasi and Albert."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "barabasi-albert"
SYNTAX = "barabasi-albert:NxM"
DESCRIPTION = "N vertices, each new one joined to M old ones, the popular ones first"
RANDOM = True
TRANSITIVE = False
PARAMETERS = (
    int,
    int,
)


def build(size: int, attached: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges, shape (E, 2), of NetworkX's ``barabasi_albert_graph``.

    Raises
    ------
    InputError
        Unless ``1 <= M < N``.
    """
    import networkx as nx

    require(1 <= attached < size, SYNTAX, "1 <= M < N", f"{size}x{attached}")
    require_size(size * attached, SYNTAX)
    graph = nx.barabasi_albert_graph(size, attached, seed=seed)
    return size, np.array(list(graph.edges()), dtype=np.int64).reshape(-1, 2)
