"""Blocks at given places of a sparse matrix."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from .arrays import Floats, Ints


def scatter(rows: Ints, columns: Ints, values: Floats, shape: tuple[int, int]) -> sparse.csr_array:
    """Return the matrix with the blocks `values`, overlapping ones added.

    Parameters
    ----------
    rows, columns : ndarray, shape (m,)
        Where the first entry of every block lies.
    values : ndarray, shape (m, n, n)
    shape : tuple of int
        The shape of the matrix.
    """
    inner = np.arange(values.shape[-1])
    i = np.broadcast_to(rows[:, None, None] + inner[:, None], values.shape).ravel()
    j = np.broadcast_to(columns[:, None, None] + inner, values.shape).ravel()
    return sparse.csr_array((values.ravel(), (i, j)), shape=shape)
