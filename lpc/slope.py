"""The gradient of some terms, by one sparse product where the costs are quadratic."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy import sparse

from .arrays import Floats
from .terms import Pairs, Terms

Booleans = NDArray[np.bool_]


@dataclass(frozen=True, eq=False)
class Slope:
    """``g(x)``; for quadratic costs ``g(base) + Hessian (x - base)``.

    Rounding then does as much harm as the distance from the base allows: `moved` takes a new
    base, at which the gradient is evaluated from the costs.

    Parameters
    ----------
    terms : Terms
    fixed : ndarray, shape (G, n)
    base, level : ndarray, shape (F, n)
        A point and the gradient there.
    hessian : csr_array, shape (F n, F n), or None
        None where it is not constant.
    """

    terms: Terms
    fixed: Floats
    base: Floats
    level: Floats
    hessian: sparse.csr_array | None

    @classmethod
    def of(cls, terms: Terms, fixed: Floats, base: Floats) -> Slope:
        """Return the gradient of terms, exact at a base."""
        matrix = terms.hessian(base, fixed)[0] if terms.problem.quadratic else None
        return cls(terms, fixed, base, terms.gradient(base, fixed), matrix)

    def at(self, x: Floats) -> Floats:
        """Return the gradient, shape (F, n)."""
        if self.hessian is None:
            return self.terms.gradient(x, self.fixed)
        change = self.hessian @ (x - self.base).ravel()
        found: Floats = self.level + change.reshape(x.shape)
        return found

    def moved(self, base: Floats) -> Slope:
        """Return the same gradient, exact at another base."""
        if self.hessian is None:
            return self
        level = self.terms.gradient(base, self.fixed)
        return Slope(self.terms, self.fixed, base, level, self.hessian)

    def narrowed(self, kept: Booleans) -> Slope:
        """Return the gradient of some copies alone, those of the rows that are kept."""
        terms, fixed = narrow(self.terms, kept)
        hessian = self.hessian
        if hessian is not None:
            columns = np.repeat(kept, self.terms.problem.n)
            hessian = hessian[columns][:, columns]
        return Slope(terms, self.fixed[fixed], self.base[kept], self.level[kept], hessian)


def narrow(terms: Terms, kept: Booleans) -> tuple[Terms, Booleans]:
    """Return the terms of some copies, and which of the fixed actions belong to them.

    Parameters
    ----------
    terms : Terms
    kept : ndarray of bool, shape (F,)
        The free actions of those copies.
    """
    copies = np.unique(terms.free[kept, 0])
    fixed = np.isin(terms.fixed[:, 0], copies)
    here = np.concatenate([kept, fixed])
    place = np.cumsum(here) - 1

    def chosen(p: Pairs) -> Pairs:
        mine = here[p.ends[:, 0]]
        return replace(p, t=p.t[mine], i=p.i[mine], ends=place[p.ends[mine]])

    pairs = chosen(terms.temporal), chosen(terms.spatial)
    return Terms(terms.problem, terms.free[kept], terms.fixed[fixed], *pairs), fixed
