"""Many small quadratic programs over projectable sets, solved together."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from .arrays import Floats, Ints
from .projection import Projection

EVERY = 4  # iterations between two looks at the error
FIRST = 8  # no look before this one
LIMIT = 100_000
TOGETHER = 1 << 15  # numbers of the programs iterated together: they stay in a core's cache
SHARED = 8  # programs with one matrix that are worth a piece of their own
POWERS = 8  # steps towards the best weights of Gershgorin's discs


@dataclass(frozen=True, eq=False)
class Reflections:
    """The matrices of Peaceman-Rachford splitting for ``min x'Mx/2 - q'x`` over x in D.

    With ``J = (I + M/rho)^{-1}`` and P the projection onto D, the iteration::

        w = (2 J - I) s + 2 J q / rho,      s <- 2 P(w) - w

    has its fixed points at solutions ``P(w)``. The eigenvalues of ``2 J - I`` are
    ``(rho - lambda)/(rho + lambda)``, and ``2 P - I`` does not expand; ``rho = sqrt(m L)`` with
    ``m I <= M <= L I`` gives the contraction ``(sqrt(L/m) - 1)/(sqrt(L/m) + 1)``.

    Parameters
    ----------
    reflection : ndarray, shape (G, s, s)
        ``2 J - I`` of G different matrices M.
    rho : ndarray, shape (G,)
    factor : ndarray, shape (G,)
        The error of ``p = P(w)`` is at most factor times the distance of p from (s + w)/2.

    References
    ----------
    Lions and Mercier (1979), Splitting algorithms for the sum of two nonlinear operators;
    Giselsson and Boyd (2017), Linear convergence and metric selection for Douglas-Rachford
    splitting and ADMM.
    """

    reflection: Floats
    rho: Floats
    factor: Floats

    @classmethod
    def of(cls, matrices: Floats, floor: Floats) -> Reflections:
        """Return the reflections of matrices (G, s, s) whose eigenvalues are at least floor (G,).

        Notes
        -----
        Let ``z = (s + w)/2 = J (s + q/rho)``, so that ``M z - q = rho (s - z)``. At ``p = P(w)``
        the vector ``M p - q + rho (w - p) = (M - rho I)(p - z)`` is a subgradient of the cost
        with its constraint, which is m-strongly convex: the error of p is at most
        ``max(L - rho, rho - m) |p - z| / m``.
        """
        low, top = eigenvalue_bounds(matrices)
        low = np.maximum(low, floor)
        rho = np.sqrt(low * top)
        unit = np.eye(matrices.shape[-1])
        reflection = 2 * np.linalg.inv(unit + matrices / rho[:, None, None]) - unit
        return cls(reflection, rho, np.maximum(top - rho, rho - low) / low)

    def solve(
        self, which: Ints, q: Floats, onto: Projection, tolerance: float
    ) -> tuple[Floats, Floats]:
        """Solve A programs.

        Each is iterated until its own error is small, so that its solution depends on nothing
        but its own data.

        Parameters
        ----------
        which : ndarray, shape (A,)
            The matrix of every program.
        q : ndarray, shape (A, s)
        onto : Projection
            The projection for A points of s numbers.
        tolerance : float
            The error to reach, relative to the largest entry of a solution, or of ``2 J q/rho``
            if that is larger: where a solution is 0 the scale is that of what pulls at it.

        Returns
        -------
        x : ndarray, shape (A, s)
        error : ndarray, shape (A,)
            Bounds on ``|x - x*|``, up to rounding.
        """
        x, error = np.empty_like(q), np.empty(len(q))
        for some in _pieces(which, max(1, TOGETHER // q.shape[1])):
            x[some], error[some] = self._together(which[some], q[some], onto.some(some), tolerance)
        return x, error

    def _together(
        self, which: Ints, q: Floats, onto: Projection, tolerance: float
    ) -> tuple[Floats, Floats]:
        x, error = np.empty_like(q), np.empty(len(q))
        active, left = np.arange(len(q)), np.ones(len(q), dtype=bool)
        factor = 0.5 * self.factor[which] * np.sqrt(q.shape[1])
        matrix = self._matrices(which)
        pull = (np.matmul(matrix, q[:, :, None])[:, :, 0] + q) / self.rho[which][:, None]
        reach = np.abs(pull).max(axis=1, initial=0.0)
        s, w, p = np.zeros_like(q), np.empty_like(q), np.empty_like(q)
        for iteration in range(1, LIMIT + 1):
            # one product a program, so that its sum has the same order whatever lies beside it
            np.matmul(matrix, s[:, :, None], out=w[:, :, None])
            w += pull
            onto(w, p)
            np.subtract(p, w, out=w)
            w += p
            if iteration >= FIRST and iteration % EVERY == 0:
                s -= w  # |s - (2 p - w)| = 2 |p - (s + w)/2|
                bound = factor * np.abs(s, out=s).max(axis=1, initial=0.0)
                size = np.maximum(np.abs(p).max(axis=1, initial=0.0), reach)
                done = left & ((bound <= tolerance * size) | (iteration == LIMIT))
                if done.any():
                    x[active[done]], error[active[done]] = p[done], bound[done]
                    left &= ~done
                    if not left.any():
                        break
                    if 2 * left.sum() < len(left):
                        active, which, onto = active[left], which[left], onto.some(left)
                        w, pull, factor, reach = w[left], pull[left], factor[left], reach[left]
                        matrix = self._matrices(which)
                        s, p, left = np.empty_like(w), np.empty_like(w), np.ones(len(w), dtype=bool)
            s, w = w, s
        return x, error

    def _matrices(self, which: Ints) -> Floats:
        """Return a matrix a program, or one for all of them."""
        return self.reflection[which[:1] if (which == which[0]).all() else which]


def _pieces(which: Ints, largest: int) -> Iterator[Ints]:
    """Yield the programs in pieces; many with one matrix are not mixed with others."""
    order = np.argsort(which, kind="stable")
    counts = np.bincount(which)
    many = counts[which[order]] >= SHARED
    runs = np.split(order[many], np.cumsum(counts[counts >= SHARED])[:-1])
    for run in (*runs, order[~many]):
        for first in range(0, len(run), largest):
            yield run[first : first + largest]


def eigenvalue_bounds(matrices: Floats) -> tuple[Floats, Floats]:
    """Return bounds on the eigenvalues of symmetric matrices (G, s, s), shape (G,) each.

    By Gershgorin's theorem for ``diag(x)^{-1} M diag(x)``, with any ``x > 0``, they lie within
    ``M_ii +- sum_{j != i} |M_ij| x_j / x_i``. A few powers of ``|M|`` take x towards the weights
    that are best where signs do not cancel.
    """
    size = matrices.shape[-1]
    own = matrices[:, np.arange(size), np.arange(size)]
    others = np.abs(matrices)
    others[:, np.arange(size), np.arange(size)] = 0.0
    x = np.ones(own.shape)
    for _ in range(POWERS):
        x = np.abs(own) * x + np.matmul(others, x[:, :, None])[:, :, 0]
        x /= x.max(axis=1, keepdims=True)
        x += 1e-3  # bounded away from 0, where a part of the problem hangs by a thread
    radius = np.matmul(others, x[:, :, None])[:, :, 0] / x
    slack = 1 + 4 * size * np.finfo(float).eps
    return (own - radius * slack).min(axis=1), (own + radius * slack).max(axis=1)
