"""The norm of one block of a sensitivity, and its gradient in the Hessians of the costs."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import linalg

from ..graphs import InputError
from ..lpc.arrays import Floats, Ints
from ..lpc.terms import Terms
from .couplings import Blocks

LARGEST = 1500  # unknowns: everything is dense


@dataclass(frozen=True, eq=False)
class Response:
    r"""``sigma = |(-M^{-1} C)_{rows, columns}|``, the spectral norm.

    With unit vectors u, w of the largest singular value, ``M x = -C w`` and ``M y = u`` (u put into
    its rows),

    .. math:: d\sigma = -y^T (dM\, x + dC\, w),

    one more solve with the factor of M, the adjoint; every term of the costs gets
    ``-(eta xi' + xi eta')/2`` with the parts of ``xi = (x, w)``, ``eta = (y, 0)`` at its ends.
    Where the largest singular value is not simple this is one of the gradients.

    Parameters
    ----------
    terms : Terms
    rows, columns : ndarray of int
        Rows of ``terms.free`` and of ``terms.fixed``.
    """

    terms: Terms
    rows: Ints
    columns: Ints

    def __post_init__(self) -> None:
        unknowns = len(self.terms.free) * self.terms.problem.n
        if unknowns > LARGEST:
            raise InputError(f"{unknowns} unknowns: a window of at most {LARGEST} can be searched")

    def value(self, blocks: Blocks) -> float:
        """Return sigma."""
        return self.with_gradient(blocks, gradient=False)[0]

    def with_gradient(self, blocks: Blocks, *, gradient: bool = True) -> tuple[float, Blocks]:
        """Return sigma and its derivatives in the blocks (the blocks themselves if not asked)."""
        n, F, G = self.terms.problem.n, len(self.terms.free), len(self.terms.fixed)
        kept, where = self._layout
        entries = np.concatenate([block.ravel() for block in blocks])[kept]
        flat = np.bincount(where, entries, minlength=F * n * (F + G) * n)
        whole: Floats = flat.astype(np.float64, copy=False).reshape(F * n, (F + G) * n)
        M = whole[:, : F * n]
        factor = linalg.cho_factor(M, check_finite=False)
        inner = np.arange(n)
        rows = (self.rows[:, None] * n + inner).ravel()
        columns = (self.columns[:, None] * n + inner).ravel()
        x = _solve(factor, M, -whole[:, F * n + columns])
        u, values, vt = np.linalg.svd(x[rows], full_matrices=False)
        sigma = float(values[0])
        if not gradient:
            return sigma, blocks
        into = np.zeros((F * n, 1))
        into[rows, 0] = u[:, 0]
        xi, eta = np.zeros((2, (F + G) * n))
        eta[: F * n] = _solve(factor, M, into)[:, 0]
        xi[: F * n] = x @ vt[0]
        xi[F * n + columns] = vt[0]
        xi, eta = xi.reshape(-1, n), eta.reshape(-1, n)
        ends = (np.arange(F)[:, None], self.terms.temporal.ends, self.terms.spatial.ends)
        return sigma, Blocks(*(_bars(xi, eta, end) for end in ends))

    @cached_property
    def _layout(self) -> tuple[Ints, Ints]:
        """Return which entries of the blocks count, and where in (F n, (F + G) n) they go."""
        n, F, G = self.terms.problem.n, len(self.terms.free), len(self.terms.fixed)
        kept, where, before = [], [], 0
        ends = (np.arange(F)[:, None], self.terms.temporal.ends, self.terms.spatial.ends)
        for end in ends:
            place = (end[:, :, None] * n + np.arange(n)).reshape(len(end), n * end.shape[1])
            i, j = np.broadcast_arrays(place[:, :, None], place[:, None, :])
            mine = np.flatnonzero(i.ravel() < F * n)
            kept.append(before + mine)
            where.append((i.ravel() * (F + G) * n + j.ravel())[mine])
            before += i.size
        return np.concatenate(kept), np.concatenate(where)


def _solve(factor: tuple[Floats, bool], M: Floats, right: Floats) -> Floats:
    """Return ``M^{-1} right``, refined once: entries that decay keep their digits."""
    found: Floats = linalg.cho_solve(factor, right, check_finite=False)
    found += linalg.cho_solve(factor, right - M @ found, check_finite=False)
    return found


def _bars(xi: Floats, eta: Floats, ends: Ints) -> Floats:
    shape = (len(ends), ends.shape[1] * xi.shape[1])
    left, right = eta[ends].reshape(shape), xi[ends].reshape(shape)
    outer = left[:, :, None] * right[:, None, :]
    found: Floats = -0.5 * (outer + outer.swapaxes(1, 2))
    return found
