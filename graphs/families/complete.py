"""The complete graph."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "complete"
SYNTAX = "complete:N"
DESCRIPTION = "N >= 1 vertices, all joined to each other"
RANDOM = False
TRANSITIVE = True
PARAMETERS = (int,)


def build(size: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """All pairs ``i < j``, shape (N (N - 1) / 2, 2).

    Raises
    ------
    InputError
        If `size` is below 1 or there are too many pairs.
    """
    require(size >= 1, SYNTAX, "N >= 1", size)
    require_size(size * (size - 1) // 2, SYNTAX)
    return size, np.stack(np.triu_indices(size, 1), axis=1)
