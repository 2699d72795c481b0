"""Symmetric matrices with eigenvalues in an interval, as a smooth function of free parameters."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..graphs import InputError
from ..lpc.arrays import Floats, Ints

EPS = float(np.finfo(float).eps)


@dataclass(frozen=True)
class Spectra:
    r"""Matrices ``P = b I + w Q diag(s, 0) Q'``, eigenvalues in ``[low, high]``.

    Q is a product of Givens rotations, one for each pair of axes. Every symmetric matrix with such
    eigenvalues is of this form, as every rotation is such a product, and a reflection of a column
    does not change P. For ``size = 2, rank = 1`` these are the blocks
    ``w s (cos phi, sin phi)' (cos phi, sin phi)``, up to b.

    The class is kept in floating point, too: b and w leave a margin of ``8 size^2`` units of
    roundoff of `high` at both ends, more than what the product of rotations and a computed
    eigenvalue may be off by. For ``size = 1`` nothing is rounded and there is no margin.

    The parameters of one matrix are `rank` strengths s in [0, 1] and then the angles, any numbers;
    there are none if there is no room between `low` and `high`.

    Parameters
    ----------
    count, size : int
        How many matrices, of what size.
    low, high : float
        ``0 <= low <= high``.
    rank : int
        How many strengths, ``1 <= rank <= size``; the others are 0.
    """

    count: int
    size: int
    low: float
    high: float
    rank: int

    def __post_init__(self) -> None:
        if not 1 <= self.rank <= self.size:
            raise InputError(f"rank = {self.rank}: an integer in 1..{self.size} is needed", "rank")

    @property
    def _margin(self) -> float:
        return 0.0 if self.size == 1 else 8 * self.size**2 * EPS * self.high

    @property
    def width(self) -> float:
        """``w``: 0 where there is no room."""
        return max(self.high - self.low - 2 * self._margin, 0.0)

    @property
    def base(self) -> float:
        """``b``."""
        return self.low + self._margin if self.width else self.low

    @cached_property
    def planes(self) -> Ints:
        """The two axes of every rotation, shape (K, 2)."""
        return np.array(
            [(i, j) for i in range(self.size) for j in range(i + 1, self.size)], dtype=np.int64
        ).reshape(-1, 2)

    @property
    def each(self) -> int:
        """The number of parameters of one matrix."""
        return self.rank + len(self.planes) if self.width else 0

    def matrices(self, theta: Floats) -> Floats:
        """Return the matrices, shape (count, size, size), for parameters (count, each)."""
        identity = self.base * np.eye(self.size)
        if not self.width:
            return np.broadcast_to(identity, (self.count, self.size, self.size))
        first = self._rotation(theta)[:, :, : self.rank]
        scaled = self.width * first * theta[:, None, : self.rank]
        found = identity + scaled @ first.swapaxes(1, 2)
        if self.size == 1:  # low + (high - low) may round up
            return np.clip(found, self.low, self.high)
        symmetric: Floats = 0.5 * (found + found.swapaxes(1, 2))
        return symmetric

    def gradient(self, theta: Floats, bar: Floats) -> Floats:
        """Return the derivative of ``sum <bar, P>`` in the parameters, shape (count, each).

        Parameters
        ----------
        theta : ndarray, shape (count, each)
        bar : ndarray, shape (count, size, size)
            Symmetric.
        """
        if not self.width:
            return np.zeros((self.count, 0))
        Q = self._rotation(theta)
        pulled = self.width * bar @ Q[:, :, : self.rank]
        found = np.empty_like(theta)
        found[:, : self.rank] = np.einsum("cij,cij->cj", Q[:, :, : self.rank], pulled)
        back = np.zeros_like(Q)
        back[:, :, : self.rank] = 2 * pulled * theta[:, None, : self.rank]
        for k in range(len(self.planes) - 1, -1, -1):
            i, j = self.planes[k]
            # a rotation of columns i and j moves them along j and -i
            turn = Q[:, :, j] * back[:, :, i] - Q[:, :, i] * back[:, :, j]
            found[:, self.rank + k] = turn.sum(axis=1)
            angle = -theta[:, self.rank + k]
            _turn(Q, i, j, angle)
            _turn(back, i, j, angle)
        return found

    def _rotation(self, theta: Floats) -> Floats:
        Q = np.tile(np.eye(self.size), (self.count, 1, 1))
        for k, (i, j) in enumerate(self.planes):
            _turn(Q, i, j, theta[:, self.rank + k])
        return Q


def _turn(Q: Floats, i: int, j: int, angle: Floats) -> None:
    """Rotate the columns i and j of every matrix, in place."""
    c, s = np.cos(angle)[:, None], np.sin(angle)[:, None]
    first, second = Q[:, :, i].copy(), Q[:, :, j].copy()
    Q[:, :, i] = c * first + s * second
    Q[:, :, j] = c * second - s * first
