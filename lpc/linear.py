"""Linear systems of independent copies, solved so that no copy moves a bit of another."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from .arrays import Floats, Ints
from .certify import Copies

DENSE = 200  # unknowns of a copy below which its matrix is written out
BATCH = 2**22  # entries of dense matrices at a time


def solve_copies(copies: Copies, matrix: sparse.csr_array, right: Floats) -> Floats:
    """Return ``matrix^-1 right`` for a matrix with one diagonal block a copy.

    Small blocks are factorised densely, many at a time but each by itself; large ones by a sparse
    LU factorisation each.

    Parameters
    ----------
    copies : Copies
        Which rows belong together, F rows.
    matrix : csr_array, shape (F n, F n)
        Symmetric, positive definite.
    right : ndarray, shape (F, n)

    Returns
    -------
    ndarray, shape (F, n)
    """
    n = right.shape[1]
    edges = np.append(copies.first, len(copies.row)) * n
    sizes = np.diff(edges)
    found, flat = np.empty(right.size), right.ravel()
    for size in np.unique(sizes):
        which = np.flatnonzero(sizes == size)
        if size > DENSE:
            for c in which:
                here = slice(edges[c], edges[c + 1])
                found[here] = factorised(matrix[here, here]).solve(flat[here])
            continue
        step = max(1, BATCH // int(size) ** 2)
        for at in range(0, len(which), step):
            rows = edges[which[at : at + step], None] + np.arange(size)
            found[rows] = _dense(matrix, rows, flat)
    return found.reshape(right.shape)


def factorised(matrix: sparse.csr_array) -> splu:
    """Return a sparse LU factorisation of a symmetric positive definite matrix."""
    options = {"SymmetricMode": True}
    return splu(
        sparse.csc_array(matrix), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.0, options=options
    )


def _dense(matrix: sparse.csr_array, rows: Ints, right: Floats) -> Floats:
    """Return the solutions of blocks of one size, rows of shape (c, size)."""
    count, size = rows.shape
    begin, end = matrix.indptr[rows.ravel()], matrix.indptr[rows.ravel() + 1]
    lengths = end - begin
    line = np.repeat(np.arange(count * size), lengths)
    entry = np.repeat(begin, lengths) + _ramp(lengths)
    column = matrix.indices[entry] - np.repeat(rows[:, 0], size)[line]
    blocks = np.zeros((count * size, size))
    blocks[line, column] = matrix.data[entry]
    solution = np.linalg.solve(blocks.reshape(count, size, size), right[rows][:, :, None])
    found: Floats = solution[:, :, 0].astype(np.float64, copy=False)
    return found


def _ramp(lengths: Ints) -> Ints:
    """Return 0, 1, .. up to each length, one after the other."""
    ends = np.cumsum(lengths)
    return np.arange(ends[-1] if len(ends) else 0) - np.repeat(ends - lengths, lengths)
