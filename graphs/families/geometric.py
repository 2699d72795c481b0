"""The random geometric graph: radio stations in a square."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ..arguments import require, require_size

NAME = "geometric"
SYNTAX = "geometric:NxRADIUS"
DESCRIPTION = "N random points of the unit square, joined within distance RADIUS"
RANDOM = True
TRANSITIVE = False
PARAMETERS = (
    int,
    float,
)


def build(size: int, radius: float, *, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges, shape (E, 2), between points at most `radius` apart.

    The points are ``numpy.random.default_rng(seed).random((N, 2))``.

    Raises
    ------
    InputError
        Unless ``N >= 1`` and ``RADIUS >= 0``.
    """
    from scipy.spatial import KDTree

    require(size >= 1 and radius >= 0, SYNTAX, "N >= 1 and RADIUS >= 0", f"{size}x{radius:g}")
    require_size(size, SYNTAX)
    # what is expected: the area of a disc, of all pairs
    require_size(min(1.0, np.pi * min(radius, 1.0) ** 2) * size**2 / 2, SYNTAX)
    points = np.random.default_rng(seed).random((size, 2))
    pairs = KDTree(points).query_pairs(radius, output_type="ndarray")
    return size, np.asarray(pairs, dtype=np.int64)
