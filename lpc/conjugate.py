"""Conjugate gradients on the Hessian of a whole window of steps."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Protocol

import numpy as np
from scipy import sparse

from .arrays import Floats
from .problem import Problem
from .terms import Terms
from .whole import whole


class Operator(Protocol):
    """A symmetric positive definite matrix and an approximate inverse.

    Vectors have shape (N n, H): a column a step.
    """

    def apply(self, x: Floats) -> Floats:
        """Return the matrix times x."""
        ...

    def precondition(self, x: Floats) -> Floats:
        """Return the inverse of the diagonal blocks times x."""
        ...


@dataclass(frozen=True, eq=False)
class Steady:
    """The Hessian of a problem whose costs curve alike at all steps::

        (A x)_t = inner x_t + ahead x_{t+1} + ahead' x_{t-1},   t < H,   and last x_H + ..

    so that matrices of one step stand for all.
    """

    inner: sparse.csr_array
    last: sparse.csr_array
    ahead: sparse.csr_array
    inner_inverse: sparse.csr_array
    last_inverse: sparse.csr_array

    @classmethod
    def of(cls, problem: Problem) -> Steady:
        """Return the Hessian of all steps, from those of steps 1, 2 and H."""
        M, n, H = problem.N * problem.n, problem.n, problem.H
        first, last = (hessian_of(whole(problem, *w)) for w in ((1, min(2, H)), (H, H)))
        inner = first[:M, :M]
        ahead = first[:M, M:] if H > 1 else sparse.csr_array((M, M))
        return cls(inner, last, ahead, _block_inverse(inner, n), _block_inverse(last, n))

    def apply(self, x: Floats) -> Floats:
        """Return the matrix times x."""
        y = self.inner @ x
        y[:, :-1] += self.ahead @ x[:, 1:]
        y[:, 1:] += self.ahead.T @ x[:, :-1]
        y[:, -1:] += (self.last - self.inner) @ x[:, -1:]
        found: Floats = y
        return found

    def precondition(self, x: Floats) -> Floats:
        """Return the inverse of the diagonal blocks times x."""
        y = self.inner_inverse @ x
        y[:, -1:] = self.last_inverse @ x[:, -1:]
        found: Floats = y
        return found


@dataclass(frozen=True, eq=False)
class Written:
    """A Hessian that changes from step to step, written out; rows by step and agent."""

    matrix: sparse.csr_array
    inverse: sparse.csr_array
    H: int

    @classmethod
    def of(cls, terms: Terms, H: int) -> Written:
        """Return the Hessian of terms over H steps."""
        matrix = hessian_of(terms)
        return cls(matrix, _block_inverse(matrix, terms.problem.n), H)

    def apply(self, x: Floats) -> Floats:
        """Return the matrix times x."""
        return self._times(self.matrix, x)

    def precondition(self, x: Floats) -> Floats:
        """Return the inverse of the diagonal blocks times x."""
        return self._times(self.inverse, x)

    def _times(self, matrix: sparse.csr_array, x: Floats) -> Floats:
        found: Floats = (matrix @ x.T.ravel()).reshape(self.H, -1).T
        return found


def conjugate(
    operator: Operator, right: Floats, *, reduction: float, limit: int
) -> tuple[Floats, int]:
    """Return x with ``|right - A x| <= reduction |right|`` and the number of steps.

    The residual is the one that the recursion carries along; compute the true one afterwards.

    Parameters
    ----------
    operator : Operator
    right : ndarray, shape (N n, H)
    reduction : float
    limit : int
        Most steps.

    References
    ----------
    Y. Saad, Iterative Methods for Sparse Linear Systems (2003), Algorithm 9.1.
    """
    x, residual = np.zeros_like(right), right.copy()
    z = operator.precondition(residual)
    direction, product = z, float(np.vdot(residual, z))
    goal, taken = reduction * float(np.linalg.norm(right)), 0
    while np.linalg.norm(residual) > goal and taken < limit:
        image = operator.apply(direction)
        length = product / float(np.vdot(direction, image))
        x += length * direction
        residual -= length * image
        z = operator.precondition(residual)
        before, product = product, float(np.vdot(residual, z))
        direction = z + (product / before) * direction
        taken += 1
    return x, taken


def hessian_of(terms: Terms) -> sparse.csr_array:
    """Return the Hessian of terms, where it is the same everywhere."""
    n = terms.problem.n
    x, fixed = np.zeros((len(terms.free), n)), np.zeros((len(terms.fixed), n))
    return terms.hessian(x, fixed)[0]


def _block_inverse(matrix: sparse.csr_array, n: int) -> sparse.csr_array:
    """Return the inverses of the diagonal blocks of n rows."""
    size = matrix.shape[0]
    blocks = np.empty((size // n, n, n))
    for i in range(n):
        for j in range(n):
            diagonal = matrix.diagonal(j - i)
            blocks[:, i, j] = diagonal[min(i, j) :: n][: size // n]
    columns = np.broadcast_to(np.arange(size).reshape(-1, 1, n), blocks.shape)
    inverse = np.linalg.inv(blocks)
    pointer = np.arange(size + 1) * n
    return sparse.csr_array((inverse.ravel(), columns.ravel(), pointer), shape=(size, size))
