"""The worst ratio as a function of the couplings, with its exact gradient."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import solve_triangular

from ..lpc.arrays import Floats
from ..lpc.information import check_sight, information_set
from .couplings import Couplings

Ints = NDArray[np.int64]


class Local(NamedTuple):
    """One local problem: the variable that is played, those that are free, and all others."""

    row: int
    free: Ints
    here: int
    fixed: Ints


class Found(NamedTuple):
    """The largest eigenvalue at one point, and what its derivative needs.

    With ``K~ = Q^{-1} K M^{-1}``, the top eigenvector z of ``T K~ T' M``, ``|z|_M = 1``,
    ``w = M z``, ``q = T' w``: ``y = M^{-1} q``, ``D = K~ q``, ``delta = T D = value z``.
    """

    value: float
    z: Floats
    w: Floats
    q: Floats
    y: Floats
    D: Floats


@dataclass(frozen=True, eq=False)
class Slope:
    r"""``point -> (CR - 1, gradient)`` for LPC with k and r, densely, for small networks.

    ``CR - 1`` is the largest eigenvalue of the pencil ``(T K~ T', M^{-1})``, so (the data being
    optimal, their own change counts for nothing)::

        d value = 2 w' dT D + w'T dK~ T'w + value z' dM z,
        dK~ = -Q^{-1} dQ Q^{-1} + M^{-1} dM M^{-1}.

    In ``dT`` every local problem counts for itself. If f holds its boundary data and its plan,
    ``f_F = -M_FF^{-1} M_{F,fixed} f_fixed``, of which the entry at i is played, then the played
    entry changes by ``-e_i' M_FF^{-1} (dM f)_F``, and what is made of that later is the entry at i
    of the adjoint ``eta = w + (steps taken before)' eta``. Where the largest eigenvalue is
    multiple, this is one of its subgradients.

    Parameters
    ----------
    couplings : Couplings
    k, r : int
        Prediction horizon ``>= 2`` and communication radius ``>= 1``.
    """

    couplings: Couplings
    k: int
    r: int

    def __post_init__(self) -> None:
        check_sight(self.k, self.r)

    @cached_property
    def locals(self) -> tuple[Local, ...]:
        """The local problems, in the order of the steps."""
        c, N = self.couplings, self.couplings.network.vertices
        known = [information_set(c.network, 1, v, self.k, self.r) for v in range(N)]
        found = []
        for row in range(c.nodes):
            t, v = divmod(row, N)
            steps = np.arange(t, min(t + self.k - 1, c.H))
            free = np.sort((steps[:, None] * N + known[v].inner).ravel())
            lowest, highest = max(t - 1, 0) * N, min(t + self.k, c.H) * N
            fixed = np.setdiff1d(np.arange(lowest, highest), free)
            if not len(free):  # k = 1 or r = 0
                found.append(Local(row, np.array([row]), 0, fixed[:0]))
                continue
            found.append(Local(row, free, int(np.searchsorted(free, row)), fixed))
        return tuple(found)

    def __call__(self, point: Floats) -> tuple[float, Floats]:
        """Return ``CR - 1`` at a point of the box, and its gradient."""
        c = self.couplings
        m, P = c.matrices(point)
        K = self._couplings(P)
        M = K + np.diag(m)
        weights, now, before = self._policies(M)
        found = self._top(m, K, now, before)
        delta = found.value * found.z
        eta = solve_triangular(np.eye(c.nodes) - before.T, found.w)
        by_M = np.outer(found.y, found.y) + found.value * np.outer(found.z, found.z)
        N = c.network.vertices
        for local, (inverse, e) in zip(self.locals, weights, strict=True):
            past = local.fixed < local.row // N * N
            data = np.where(past, delta[local.fixed], found.D[local.fixed])
            plan = -inverse @ (M[np.ix_(local.free, local.fixed)] @ data)
            a = 2.0 * eta[local.row] * e
            by_M[np.ix_(local.free, local.free)] -= np.outer(a, plan)
            by_M[np.ix_(local.free, local.fixed)] -= np.outer(a, data)
        by_m = np.diagonal(by_M) - (found.q / m) ** 2
        inner = c.ends >= 0
        by_P = by_M[c.ends[:, :, None], c.ends[:, None, :]]
        by_P = np.where(inner[:, :, None] & inner[:, None, :], by_P, 0.0)
        return found.value, c.chain(point, by_m, by_P)

    def _couplings(self, P: Floats) -> Floats:
        c = self.couplings
        K = np.zeros((c.nodes, c.nodes))
        inner = (c.ends >= 0).all(axis=1)
        for a in range(2):
            for b in range(2):
                some = inner if a != b else c.ends[:, a] >= 0
                np.add.at(K, (c.ends[some, a], c.ends[some, b]), P[some, a, b])
        return K

    def _policies(self, M: Floats) -> tuple[list[tuple[Floats, Floats]], Floats, Floats]:
        """Return ``(M_FF^{-1}, its row that is played)``, and ``delta = now D + before delta``."""
        now, before = np.zeros_like(M), np.zeros_like(M)
        N, weights = self.couplings.network.vertices, []
        for row, free, here, fixed in self.locals:
            inverse = np.asarray(np.linalg.inv(M[np.ix_(free, free)]), dtype=np.float64)
            e = inverse[here]
            weights.append((inverse, e))
            if self.k == 1 or self.r == 0:
                now[row, row] = 1.0
                continue
            gains = -e @ M[np.ix_(free, fixed)]
            past = fixed < row // N * N
            now[row, fixed[~past]] = gains[~past]
            before[row, fixed[past]] = gains[past]
        return weights, now, before

    def _top(self, m: Floats, K: Floats, now: Floats, before: Floats) -> Found:
        """Return the largest eigenvalue and its vectors, as in `worst_case`."""
        T = solve_triangular(np.eye(len(m)) - before, now, lower=True, unit_diagonal=True)
        M = K + np.diag(m)
        R = np.linalg.cholesky(M)
        inverse = np.linalg.inv(M)
        form = R.T @ T @ ((K @ inverse) / m[:, None]) @ T.T @ R
        values, vectors = np.linalg.eigh(0.5 * (form + form.T))
        z = solve_triangular(R, vectors[:, -1], lower=True, trans="T")
        w = R @ vectors[:, -1]
        q = T.T @ w
        y = inverse @ q
        return Found(float(values[-1]), z, w, q, y, (K @ y) / m)
