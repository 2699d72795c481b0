"""The ring, a cycle of N vertices."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "ring"
SYNTAX = "ring:N"
DESCRIPTION = "a cycle of N >= 3 vertices"
RANDOM = False
TRANSITIVE = True
PARAMETERS = (int,)


def build(size: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges ``(i, i + 1 mod N)``, shape (N, 2), of the ring of ``N = size`` vertices.

    Raises
    ------
    InputError
        If `size` is below 3: two vertices would be joined twice.
    """
    require(size >= 3, SYNTAX, "N >= 3", size)
    require_size(size, SYNTAX)
    i = np.arange(size)
    return size, np.stack([i, (i + 1) % size], axis=1)
