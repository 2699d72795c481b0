"""A random regular graph."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "regular"
SYNTAX = "regular:DxN"
DESCRIPTION = "a random graph of N vertices, D neighbours each"
RANDOM = True
TRANSITIVE = False
PARAMETERS = (
    int,
    int,
)


def build(degree: int, size: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges, shape (N D / 2, 2), of NetworkX's ``random_regular_graph``.

    Raises
    ------
    InputError
        Unless ``0 <= D < N`` and ``D N`` is even.
    """
    import networkx as nx

    given = f"{degree}x{size}"
    require(0 <= degree < size, SYNTAX, "0 <= D < N", given)
    require(degree * size % 2 == 0, SYNTAX, "D*N even", given)
    require_size(max(size, degree * size // 2), SYNTAX)
    graph = nx.random_regular_graph(degree, size, seed=seed)
    return size, np.array(sorted(graph.edges()), dtype=np.int64).reshape(-1, 2)
