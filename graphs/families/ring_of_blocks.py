"""The ring of blocks, on which the lower bounds live."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "ring-of-blocks"
SYNTAX = "ring-of-blocks:NxD"
DESCRIPTION = "N >= 3 blocks of D vertices, neighbouring blocks completely joined"
RANDOM = False
TRANSITIVE = True
PARAMETERS = (
    int,
    int,
)


def build(blocks: int, size: int, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges from every vertex to all of the next block, shape (N D^2, 2); none inside a block.

    Vertex ``i D + p`` is the p-th of block ``i``; every vertex has ``2 D`` neighbours.

    Raises
    ------
    InputError
        If there are fewer than 3 blocks, or a block is empty.
    """
    require(blocks >= 3 and size >= 1, SYNTAX, "N >= 3 and D >= 1", f"{blocks}x{size}")
    require_size(blocks * size * size, SYNTAX)
    i, p, q = np.indices((blocks, size, size)).reshape(3, -1)
    return blocks * size, np.stack([i * size + p, (i + 1) % blocks * size + q], axis=1)
