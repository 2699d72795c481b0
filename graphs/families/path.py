"""The path, N vertices in a row."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "path"
SYNTAX = "path:N"
DESCRIPTION = "N >= 1 vertices in a row"
RANDOM = False
TRANSITIVE = False
PARAMETERS = (int,)


def build(size: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges ``(i, i + 1)``, shape (N - 1, 2), of the path of ``N = size`` vertices.

    Raises
    ------
    InputError
        If `size` is below 1.
    """
    require(size >= 1, SYNTAX, "N >= 1", size)
    require_size(size, SYNTAX)
    i = np.arange(size - 1)
    return size, np.stack([i, i + 1], axis=1)
