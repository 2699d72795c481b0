"""Terms as a nonlinear program, the way solvers of those like it: values at fixed positions."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..arrays import Floats, Ints
from ..slope import Booleans
from ..terms import Terms


@dataclass(frozen=True, eq=False)
class Model:
    """``min f(x)`` subject to ``g(x) <= 0``, x of shape (F n,), with derivatives.

    Parameters
    ----------
    terms : Terms
    fixed : ndarray, shape (G, n)
    there : ndarray of bool, shape (F, p)
        Which constraints are there; the same at all points.
    steep : csc_array, shape (count, F n)
        Where the Jacobian of g may have entries.
    bent : csc_array, shape (F n, F n)
        Where the upper triangle of the Hessian may have entries.
    order : ndarray
        The entries of the Jacobian, listed by constraint, in the order of `steep`.
    """

    terms: Terms
    fixed: Floats
    there: Booleans
    steep: sparse.csc_array
    bent: sparse.csc_array
    order: Ints

    @classmethod
    def of(cls, terms: Terms, fixed: Floats, x: Floats) -> Model:
        """Return the program of terms; x tells which constraints are there."""
        F, n = x.shape
        t, v = terms.free[:, 1], terms.free[:, 2]
        there = np.isfinite(terms.problem.feasible.constraints(t, v, x)[0])
        own = np.nonzero(there)[0]
        row = np.repeat(np.arange(len(own)), n)
        column = (own[:, None] * n + np.arange(n)).ravel()
        order = np.lexsort((row, column))
        ones = np.ones(len(row))
        steep = sparse.csc_array((ones, (row, column)), shape=(len(own), F * n))
        steep.sort_indices()
        bent = sparse.csc_array(sparse.triu(_pattern(terms.hessian(x, fixed)[0])))
        bent.sort_indices()
        return cls(terms, fixed, there, steep, bent, order)

    @property
    def size(self) -> int:
        """The number of variables."""
        return int(self.bent.shape[0])

    @property
    def count(self) -> int:
        """The number of constraints."""
        return int(self.steep.shape[0])

    def cost(self, x: Floats) -> float:
        """Return f."""
        return float(self.terms.value(self._rows(x), self.fixed))

    def gradient(self, x: Floats) -> Floats:
        """Return the gradient of f, shape (F n,)."""
        return self.terms.gradient(self._rows(x), self.fixed).ravel()

    def constraints(self, x: Floats) -> Floats:
        """Return g, shape (count,)."""
        return self._constraints(x)[0][self.there]

    def jacobian(self, x: Floats) -> Floats:
        """Return the entries of the Jacobian of g, in the order of `steep`."""
        return self._constraints(x)[1][self.there].ravel()[self.order]

    def hessian(self, x: Floats, weight: float, multipliers: Floats) -> Floats:
        """Return the entries of ``weight f'' + sum_i l_i g_i''``, in the order of `bent`."""
        spread = np.zeros(self.there.shape)
        spread[self.there] = multipliers
        own = np.einsum("mp,mpjk->mjk", spread, self._constraints(x)[2])
        whole = weight * self.terms.hessian(self._rows(x), self.fixed)[0]
        n = own.shape[1]
        column = np.repeat(np.arange(self.size), np.diff(self.bent.indptr))
        row = self.bent.indices
        found = np.asarray(whole[row, column], dtype=np.float64).ravel()
        inside = row // n == column // n
        action = row[inside] // n
        found[inside] += own[action, row[inside] % n, column[inside] % n]
        return found

    def _rows(self, x: Floats) -> Floats:
        return x.reshape(len(self.terms.free), -1)

    def _constraints(self, x: Floats) -> tuple[Floats, Floats, Floats]:
        t, v = self.terms.free[:, 1], self.terms.free[:, 2]
        return self.terms.problem.feasible.constraints(t, v, self._rows(x))


def _pattern(matrix: sparse.csr_array) -> sparse.csr_array:
    """Return the positions that a matrix keeps, zeros among them."""
    ones = np.ones(len(matrix.data))
    return sparse.csr_array((ones, matrix.indices, matrix.indptr), shape=matrix.shape)
