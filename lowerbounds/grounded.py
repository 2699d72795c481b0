"""Grounded Laplacians: ``M = I + diag(e) + L``, solved to the last digits of every entry."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.linalg import splu

from ..graphs import InputError, NearsightError
from ..lpc.arrays import Floats, Ints

ROUNDS = 2  # of refinement: strong couplings cost digits in the factors
CREDIBLE = 1e-9  # how far ``(1 + e)' M^{-1} b`` may be off the sum of b, relatively
TINY = np.finfo(np.float64).tiny

TOO_STRONG = "couplings so much stronger than the node costs leave no digit of them"


@dataclass(frozen=True, eq=False)
class Grounded:
    r"""``x' M x = sum_i (1 + e_i) x_i^2 + sum_(i,j) w_ij (x_i - x_j)^2``.

    What is left of a row sum is ``1 + e_i``; e is kept as a number of its own, so that no diagonal
    cancels against its row, and no row sum against 1. ``M^{-1} >= 0`` entry by entry, and its
    triangular factors (no pivoting) have one sign off the diagonal: for ``b >= 0`` they only add,
    and even entries far from the support of b, as small as they are, come out to nearly full
    relative precision.

    Parameters
    ----------
    extra : ndarray, shape (n,)
        e, nonnegative.
    ends : ndarray of int, shape (m, 2)
        The ends of every edge.
    weight : ndarray, shape (m,)
        w, nonnegative.
    """

    extra: Floats
    ends: Ints
    weight: Floats

    def __post_init__(self) -> None:
        if self.weight.shape != (len(self.ends),) or self.ends.shape[1:] != (2,):
            raise InputError(f"{len(self.ends)} edges and {self.weight.shape} weights")
        if not (np.isfinite(self.extra).all() and (self.extra >= 0).all()):
            raise InputError("the ground of every vertex is a finite number >= 1")
        if not (np.isfinite(self.weight).all() and (self.weight >= 0).all()):
            raise InputError("the weight of every edge is a finite number >= 0")

    @property
    def size(self) -> int:
        """The number of vertices, n."""
        return len(self.extra)

    @property
    def ground(self) -> Floats:
        """The row sums ``1 + e``, shape (n,)."""
        return 1.0 + self.extra

    @cached_property
    def _incidence(self) -> sparse.csr_array:
        m = len(self.ends)
        rows, signs = np.repeat(np.arange(m), 2), np.tile([1.0, -1.0], m)
        return sparse.csr_array((signs, (rows, self.ends.ravel())), shape=(m, self.size))

    @cached_property
    def matrix(self) -> sparse.csc_array:
        """M, shape (n, n)."""
        D = self._incidence
        laplacian = D.T @ sparse.diags_array(self.weight) @ D
        return sparse.csc_array(laplacian + sparse.diags_array(self.ground))

    @cached_property
    def _factors(self) -> Any:
        try:
            return splu(
                self.matrix,
                permc_spec="MMD_AT_PLUS_A",
                diag_pivot_thresh=0.0,
                options={"SymmetricMode": True},
            )
        except RuntimeError as error:  # the factor is singular
            raise NearsightError(TOO_STRONG) from error

    def solve(self, b: Floats) -> Floats:
        """Return ``M^{-1} b`` for b of shape (n,) or (n, c).

        Raises
        ------
        NearsightError
            If the result is not that: where the weights swallow the ground, nothing is left.
        """
        x: Floats = self._factors.solve(b)
        D, w, g = self._incidence, self.weight, self.ground
        if b.ndim == 2:
            w, g = w[:, None], g[:, None]
        for _ in range(ROUNDS):
            # by differences: no rounding of the size of the diagonal
            x = x + self._factors.solve(b - g * x - D.T @ (w * (D @ x)))
        off = np.abs((g * x).sum(axis=0) - b.sum(axis=0))  # M 1 = 1 + e
        if not np.all(off <= CREDIBLE * np.abs(b).sum(axis=0) + TINY):
            raise NearsightError(TOO_STRONG)
        return x

    def energy(self, x: Floats) -> Floats:
        """Return ``x' M x`` for each column of x, shape (n, c), as a sum of squares."""
        step = self._incidence @ x
        found: Floats = (self.ground[:, None] * x**2).sum(axis=0)
        found = found + (self.weight[:, None] * step**2).sum(axis=0)
        return found

    def part(self, members: Ints) -> tuple[Grounded, Ints, Ints, Floats]:
        """Return the principal part ``M_SS``, and the edges that leave S.

        Returns
        -------
        part : Grounded
            In the order of `members`; edges that leave S go to the ground.
        inner, outer : ndarray of int
            Of every edge that leaves: its end in S, as a place in `members`, and its other end.
        weight : ndarray
            Its weight.
        """
        place = np.full(self.size, -1)
        place[members] = np.arange(len(members))
        at = place[self.ends]
        within, cut = (at >= 0).all(axis=1), (at >= 0).any(axis=1) & (at < 0).any(axis=1)
        first = at[cut, 0] >= 0
        inner = np.where(first, at[cut, 0], at[cut, 1])
        outer = np.where(first, self.ends[cut, 1], self.ends[cut, 0])
        weight = self.weight[cut]
        extra = self.extra[members] + np.bincount(inner, weight, len(members))
        return Grounded(extra, at[within], self.weight[within]), inner, outer, weight
