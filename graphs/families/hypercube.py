"""The hypercube: words of D bits, neighbours differ in one."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "hypercube"
SYNTAX = "hypercube:D"
DESCRIPTION = "2^D vertices, D neighbours each"
RANDOM = False
TRANSITIVE = True
PARAMETERS = (int,)


def build(dimension: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges between numbers below ``2^D`` that differ in one bit, shape (D 2^(D - 1), 2).

    Raises
    ------
    InputError
        If the dimension is negative, or there are too many edges.
    """
    require(dimension >= 0, SYNTAX, "D >= 0", dimension)
    require_size(max(dimension, 2) * 2 ** min(dimension, 64) // 2, SYNTAX)
    vertex = np.arange(2**dimension)
    edges = [
        np.stack([low, low | 1 << b], axis=1)
        for b in range(dimension)
        for low in [vertex[vertex >> b & 1 == 0]]
    ]
    return 2**dimension, np.concatenate([np.empty((0, 2), dtype=np.int64), *edges])
