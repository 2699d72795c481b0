"""The star: one vertex in the middle, all others around it."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "star"
SYNTAX = "star:N"
DESCRIPTION = "N >= 1 vertices, the first joined to all others"
RANDOM = False
TRANSITIVE = False
PARAMETERS = (int,)


def build(size: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges ``(0, i)``, shape (N - 1, 2).

    Raises
    ------
    InputError
        If `size` is below 1.
    """
    require(size >= 1, SYNTAX, "N >= 1", size)
    require_size(size, SYNTAX)
    i = np.arange(1, size)
    return size, np.stack([np.zeros_like(i), i], axis=1)
