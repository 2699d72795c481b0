"""The complete tree, every inner vertex with equally many children."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "tree"
SYNTAX = "tree:BxDEPTH"
DESCRIPTION = "a rooted tree, B children at every vertex above depth DEPTH"
RANDOM = False
TRANSITIVE = False
PARAMETERS = (
    int,
    int,
)


def build(children: int, depth: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges ``(i, (i - 1) // B)``, shape (V - 1, 2), numbered level by level from the root 0.

    Raises
    ------
    InputError
        If there are no children, the depth is negative, or the tree is too large.
    """
    given = f"{children}x{depth}"
    require(children >= 1 and depth >= 0, SYNTAX, "B >= 1 and DEPTH >= 0", given)
    # 64 levels of two are too many already: no need to compute by how much
    require_size(depth if children == 1 else children ** min(depth, 64), SYNTAX)
    n = depth + 1 if children == 1 else (children ** (depth + 1) - 1) // (children - 1)
    i = np.arange(1, n)
    return n, np.stack([i, (i - 1) // children], axis=1)
