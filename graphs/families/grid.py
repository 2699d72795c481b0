"""The rectangular grid."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "grid"
SYNTAX = "grid:AxB"
DESCRIPTION = "a rectangle of A rows and B columns, 4 neighbours inside"
RANDOM = False
TRANSITIVE = False
PARAMETERS = (int, int)


def build(rows: int, columns: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges between horizontal and vertical neighbours; vertex ``(i, j)`` is ``i B + j``.

    Raises
    ------
    InputError
        If a side is below 1.
    """
    require(min(rows, columns) >= 1, SYNTAX, "A, B >= 1", f"{rows}x{columns}")
    require_size(2 * rows * columns, SYNTAX)
    v = np.arange(rows * columns).reshape(rows, columns)
    right = np.stack([v[:, :-1].ravel(), v[:, 1:].ravel()], axis=1)
    down = np.stack([v[:-1].ravel(), v[1:].ravel()], axis=1)
    return rows * columns, np.concatenate([right, down])
