"""Banded Cholesky factorisation in time order, for problems that are long and thin."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.linalg import solveh_banded

from .arrays import Floats


def solve_banded(matrix: sparse.csr_array, right: Floats) -> Floats:
    """Return ``matrix^-1 right`` by a Cholesky factorisation within the band of the matrix.

    In time order the band of a networked problem has about N n diagonals on either side, so that
    this costs ``H (N n)^3`` operations and ``H (N n)^2`` numbers.

    Parameters
    ----------
    matrix : csr_array, shape (M, M)
        Symmetric, positive definite.
    right : ndarray, shape (M,) or (M, m)

    References
    ----------
    LAPACK, ``dpbsv``.
    """
    entries = matrix.tocoo()
    below = entries.row - entries.col
    kept = below >= 0
    band = np.zeros((int(below.max(initial=0)) + 1, matrix.shape[0]))
    band[below[kept], entries.col[kept]] = entries.data[kept]
    found: Floats = solveh_banded(band, right, lower=True, check_finite=False)
    return found
