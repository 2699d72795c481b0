"""The rectangular grid closed in both directions."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "torus"
SYNTAX = "torus:AxB"
DESCRIPTION = "a grid of A x B closed to a torus, A, B >= 3"
RANDOM = False
TRANSITIVE = True
PARAMETERS = (
    int,
    int,
)


def build(rows: int, columns: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges from ``(i, j)`` to ``(i, j + 1 mod B)`` and ``(i + 1 mod A, j)``, shape (2 A B, 2).

    Raises
    ------
    InputError
        If a side is below 3: neighbours would be joined twice.
    """
    require(min(rows, columns) >= 3, SYNTAX, "A, B >= 3", f"{rows}x{columns}")
    require_size(2 * rows * columns, SYNTAX)
    v = np.arange(rows * columns).reshape(rows, columns)
    right = np.stack([v.ravel(), np.roll(v, -1, axis=1).ravel()], axis=1)
    down = np.stack([v.ravel(), np.roll(v, -1, axis=0).ravel()], axis=1)
    return rows * columns, np.concatenate([right, down])
