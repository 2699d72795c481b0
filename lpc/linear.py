"""Linear systems of independent copies, solved so that no copy moves a bit of another."""

from __future__ import annotations

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from .arrays import Floats, Ints
from .certify import Copies
from .slope import Booleans

DENSE = 200  # unknowns of a copy below which its matrix is written out
BATCH = 2**22  # entries of dense matrices at a time
LIFTS = (0.0, 1e-15, 1e-13, 1e-11)  # of the largest diagonal entry, for singular blocks


def solve_copies(
    copies: Copies, matrix: sparse.csr_array, right: Floats, idle: Booleans | None = None
) -> Floats:
    """Return ``matrix^-1 right`` for a matrix with one diagonal block a copy.

    Small blocks are factorised densely, many at a time but each by itself; large ones by a sparse
    LU factorisation each.

    Parameters
    ----------
    copies : Copies
        Which rows belong together, F rows.
    matrix : csr_array, shape (F n, F n)
        Symmetric, positive definite. A block that is singular to rounding gets as little more on
        its diagonal as makes it regular.
    right : ndarray, shape (F, n)
    idle : ndarray of bool, shape (C,), optional
        Copies whose blocks are not looked at: their solution is 0.

    Returns
    -------
    ndarray, shape (F, n)
        0 for a copy whose block or right-hand side is not finite.
    """
    n = right.shape[1]
    edges = np.append(copies.first, len(copies.row)) * n
    sizes = np.diff(edges)
    found, flat = np.zeros(right.size), right.ravel()
    active = np.ones(len(sizes), dtype=bool) if idle is None else ~idle
    for size in np.unique(sizes[active]):
        which = np.flatnonzero(active & (sizes == size))
        if size > DENSE:
            for c in which:
                here = slice(edges[c], edges[c + 1])
                found[here] = _sparse(matrix[here, here], flat[here])
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
    square, sides = blocks.reshape(count, size, size), right[rows][:, :, None]
    try:
        solution = np.linalg.solve(square, sides)
    except np.linalg.LinAlgError:
        solution = np.stack([_lifted(*pair) for pair in zip(square, sides, strict=True)])
    found: Floats = solution[:, :, 0].astype(np.float64, copy=False)
    return np.where(np.isfinite(found).all(axis=1, keepdims=True), found, 0.0)


def _lifted(block: Floats, side: Floats) -> Floats:
    """Return the solution for one block, its diagonal lifted where it is singular."""
    size = float(np.abs(np.diagonal(block)).max())
    for lift in LIFTS:
        try:
            found = np.linalg.solve(block + lift * size * np.eye(len(block)), side)
        except np.linalg.LinAlgError:
            continue
        return found.astype(np.float64, copy=False)
    return np.zeros_like(side)


def _sparse(block: sparse.csr_array, side: Floats) -> Floats:
    """Return the same for one sparse block."""
    size = float(np.abs(block.diagonal()).max())
    for lift in LIFTS:
        raised = block + lift * size * sparse.eye_array(block.shape[0]) if lift else block
        try:
            found: Floats = factorised(raised).solve(side)
        except RuntimeError:  # exactly singular
            continue
        return np.where(np.isfinite(found).all(), found, 0.0)
    return np.zeros_like(side)


def _ramp(lengths: Ints) -> Ints:
    """Return 0, 1, .. up to each length, one after the other."""
    ends = np.cumsum(lengths)
    return np.arange(ends[-1] if len(ends) else 0) - np.repeat(ends - lengths, lengths)
