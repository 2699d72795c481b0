"""How far an answer is from the minimiser: a certificate that asks nothing of the solver."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import Floats, Ints, at
from .costs import Cost, Quadratic
from .sets import Box, Everywhere
from .terms import Pairs, Terms

EPS = float(np.finfo(np.float64).eps)


@dataclass(frozen=True, eq=False)
class Certificate:
    """Bounds on the distance of x from the minimiser x*, one a copy.

    With a subgradient s of "cost + indicator of the sets" at x, and costs whose Hessians are at
    least ``diag(m)``::

        |x - x*| <= sqrt(sum_j |s_j|^2 / m_j) / sqrt(min_j m_j)
        cost(x) - cost(x*) <= sum_j |s_j|^2 / (2 m_j)

    Parameters
    ----------
    x : ndarray, shape (F, n)
        The point the bounds are about; feasible.
    residual : ndarray, shape (C,)
        ``|s|``, without what rounding may hide.
    error : ndarray, shape (C,)
        The bound on ``|x - x*|``, with it.
    gap : ndarray, shape (C,)
        The bound on ``cost(x) - cost(x*)``, with it.
    """

    x: Floats
    residual: Floats
    error: Floats
    gap: Floats


@dataclass(frozen=True, eq=False)
class Copies:
    """The copies that occur in some free actions, and sums over each of them.

    Every sum runs over the rows of one copy in their order, so that it depends, bit for bit, on
    nothing but that copy.

    Parameters
    ----------
    label : ndarray, shape (C,)
        The copies, increasing.
    first : ndarray, shape (C,)
        The first row of each.
    row : ndarray, shape (F,)
        The position in `label` of every row's copy.
    """

    label: Ints
    first: Ints
    row: Ints

    @classmethod
    def of(cls, terms: Terms) -> Copies:
        """Return the copies of the free actions."""
        label, first, row = np.unique(terms.free[:, 0], return_index=True, return_inverse=True)
        return cls(label, first.astype(np.int64), row.astype(np.int64))

    def total(self, rows: Floats) -> Floats:
        """Return the sum over each copy, shape (C,), of numbers of shape (F,)."""
        return np.bincount(self.row, rows, minlength=len(self.label)).astype(np.float64, copy=False)

    def least(self, rows: Floats) -> Floats:
        """Return the least number of each copy, shape (C,)."""
        found: Floats = np.minimum.reduceat(rows, self.first) if len(rows) else np.zeros(0)
        return found


def certify(terms: Terms, fixed: Floats, x: Floats) -> Certificate:
    """Return a feasible point at least about as good as x, with its distance from the minimiser.

    Where there are constraints the point is the prox step ``x+ = P(x - g(x)/d)``, and
    ``s = g(x+) + d (u - P(u))``, ``u = x - g(x)/d``; else it is x, and ``s = g(x)``.

    Parameters
    ----------
    terms : Terms
    fixed : ndarray, shape (G, n)
    x : ndarray, shape (F, n)
        Need not be feasible. The sets of `terms` have projections.
    """
    copies = Copies.of(terms)
    lower, upper = terms.scale
    feasible = terms.problem.feasible
    push = np.zeros_like(x)
    if not feasible.everywhere:
        aim = x - terms.gradient(x, fixed) / upper[:, None]
        x = feasible.project(terms.free[:, 1], terms.free[:, 2], aim)
        push = upper[:, None] * (aim - x)
    s = terms.gradient(x, fixed) + push
    hidden, size = rounding(terms, fixed, x), norms(push)
    off = np.zeros(len(x))  # how far x may be from the exact projection
    if not isinstance(feasible, Box | Everywhere):
        off = 4 * EPS * (norms(x) + size / upper)
        hidden += 2 * upper * off
    hidden += 2 * EPS * size
    square = copies.total((norms(s) + hidden) ** 2 / lower)
    error = np.sqrt(square / copies.least(lower)) + np.sqrt(copies.total(off**2))
    gap = square / 2 + copies.total(size * off)
    return Certificate(x, np.sqrt(copies.total(norms(s) ** 2)), error, gap)


def rounding(terms: Terms, fixed: Floats, x: Floats) -> Floats:
    """Return a bound on the norms of the rounding errors of the gradient's rows, shape (F,).

    For a quadratic, ``(s + 2) eps |P| |w - c|``, entry by entry; for other costs, whose inner
    workings are not known, an estimate: ``4 eps (|gradient| + |Hessian| |w|)``.
    """
    n, F = terms.problem.n, len(terms.free)
    values = np.concatenate([x, fixed])
    t, v = terms.free[:, 1], terms.free[:, 2]
    found, size = _rounding(terms.problem.node, t, v, x)
    count = np.ones(F)
    for p in (terms.temporal, terms.spatial):
        wrong, big = _rounding(p.cost, p.t, p.i, p.arguments(values))
        ends, mine = _mine(p, F)
        found += np.bincount(ends, norms(wrong.reshape(-1, n))[mine], minlength=F)[:, None]
        size += np.bincount(ends, norms(big.reshape(-1, n))[mine], minlength=F)[:, None]
        count += np.bincount(ends, minlength=F)
    total: Floats = norms(found) + EPS * count * norms(size)
    return total


def _rounding(cost: Cost, t: Ints, i: Ints, w: Floats) -> tuple[Floats, Floats]:
    """Return bounds on the rounding errors of one gradient, and its size, shape (m, size)."""
    size = np.abs(cost.gradient(t, i, w))
    if isinstance(cost, Quadratic):
        off = np.abs(w - at(cost.centre, t, i))
        moved: Floats = (np.abs(at(cost.matrix, t, i)) @ off[:, :, None])[:, :, 0]
        return (cost.size + 2) * EPS * moved, size
    felt: Floats = (np.abs(cost.hessian(t, i, w)) @ np.abs(w)[:, :, None])[:, :, 0]
    return 4 * EPS * (size + felt), size


def _mine(pairs: Pairs, F: int) -> tuple[Ints, Ints]:
    """Return the free actions at the ends of pairs, and where among the ends they stand."""
    ends = pairs.ends.ravel()
    mine = np.flatnonzero(ends < F)
    return ends[mine], mine


def norms(rows: Floats) -> Floats:
    """Return the norm of every row."""
    found: Floats = np.sqrt(np.einsum("ij,ij->i", rows, rows))
    return found
