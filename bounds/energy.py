r"""Weighted-energy bounds on a local problem (E2): perturbing the lateral boundary.

Two solutions of the local problem whose lateral boundary data differ by ``dz`` differ
by ``delta``. For every vertex v the row of ``delta`` at v is taken from v's own local
problem; then, summed over all vertices,

.. math:: \sum_v |\delta_{row}(v)|^2 \le A \sum_{j=0}^{k-2} w_j |dz_{t+j}|^2, \qquad
          A = \tfrac{a_S \eta_r}{4} N e^{-\beta q}, \quad w_j = e^{-2\alpha|j-j_0|}

for each *share* F in (0, 1) of the strong convexity that the decay in time may use:
``cosh(alpha) = 1 + F/(b a)``, ``cosh(beta) = 1 + 2 (1-F)/x``. Any F gives a bound; the
project fixes the grid ``F = i/200`` so that a printed number can be reproduced.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from .arithmetic import Number, geometric_sum, is_zero, power, select, sqrt
from .decay import gamma_T, slice_first

SHARES = 200
"""Denominator of the grid of shares ``F = i/SHARES``, ``i = 1 .. SHARES-1``."""


class Couplings(NamedTuple):
    """The strengths a certificate depends on, ``mu = 1``: any arithmetic.

    ``a_T = l_T/mu``, ``a_S = l_S/mu``, ``condition = l_f/mu``, ``max_degree`` = Delta.
    """

    a_T: Number
    a_S: Number
    condition: Number
    max_degree: int

    @property
    def x(self) -> Number:
        """``Delta l_S/mu``."""
        return self.max_degree * self.a_S


@dataclass(frozen=True)
class Row:
    """Which row of ``delta`` is bounded: the numbers of the table of (E2).

    Attributes
    ----------
    temporal : tuple of int
        ``e`` in units of ``a_T`` for ``k = 2``, ``k = 3`` and ``k >= 4``.
    neighbour : bool
        True if ``x' = max(Delta-1, 1) a_S`` takes the place of ``x``.
    distance : int
        ``q = 2 r - distance``.
    j0 : int
        The step the row sits at, counted from t.
    """

    temporal: tuple[int, int, int]
    neighbour: bool
    distance: int
    j0: int


OWN = Row(temporal=(0, 1, 1), neighbour=False, distance=1, j0=0)  # (t, v)
NEXT = Row(temporal=(0, 1, 2), neighbour=False, distance=1, j0=1)  # (t+1, v), k >= 3
NEIGHBOURS = Row(temporal=(0, 1, 1), neighbour=True, distance=3, j0=0)  # (t, N(v)), r >= 2


class RowBound(NamedTuple):
    """``E_row <= D_part D + y_part y + Z_part Z``, the three parts of (E3)."""

    D_part: Number
    y_part: Number
    Z_part: Number


def _by_horizon(k: Any, two: Any, three: Any, more: Any) -> Any:
    """Choose by ``k = 2``, ``k = 3``, ``k >= 4``, elementwise."""
    return np.where(np.equal(k, 2), two, np.where(np.equal(k, 3), three, more))


def _excess_exponential(u: Number) -> Number:
    """Return ``e^t - 1`` for ``cosh(t) = 1 + u``: ``u + sqrt(u (2+u))``, without overflow."""
    return u + sqrt(u) * sqrt(2 + u)


def row_bound(row: Row, c: Couplings, eta: Number, k: Any, r: Any, share: Any) -> RowBound:
    """Return the three parts of one row's bound for the shares ``F = share/SHARES``.

    Parameters
    ----------
    row : Row
        `OWN`, `NEXT` or `NEIGHBOURS`.
    c : Couplings
        Strengths of the couplings.
    eta : number
        ``eta_r`` of the network at radius r.
    k, r : int or arrays of int
        Horizon ``>= 2`` (`NEXT`: ``>= 3``) and radius ``>= 1`` (`NEIGHBOURS`: ``>= 2``).
    share : int or array of int
        ``1 .. SHARES - 1``; without effect where ``k = 2`` or ``l_T = 0`` (there F = 0).

    Returns
    -------
    RowBound
        Infinite where the share admits no weights (a denominator ``<= 0``).
    """
    still = np.logical_or(np.equal(k, 2), is_zero(c.a_T))  # F = 0, e = 0: no time decay used
    one = 1 + 0 * (c.a_T + c.a_S)  # of the arithmetic of the couplings
    used = np.where(still, 0, share)
    share_T, share_S = _times(used, one) / SHARES, _times(SHARES - used, one) / SHARES
    # cosh(alpha) = 1 + F/(b a) with b = 1/2 for k = 3 and 1 for k >= 4
    per_b = _by_horizon(k, 1, 2, 1)
    safe_a, safe_x = (select(is_zero(y), one, y) for y in (c.a_T, c.x))  # where 0, not used
    grown_T = _excess_exponential(_times(per_b, share_T) / safe_a)  # e^alpha - 1
    grown_S = _excess_exponential(2 * share_S / safe_x)  # e^beta - 1
    e = _times(np.where(still, 0, _by_horizon(k, *row.temporal)), c.a_T)
    x = max(c.max_degree - 1, 1) * c.a_S if row.neighbour else c.x
    reach = e * (1 + grown_T) + x * (1 + grown_S)  # X of (E2)
    # e x' (cosh(alpha-beta) - 1), by (P-Q)^2/(2PQ) with P = e^alpha, Q = e^beta
    apart = grown_T - grown_S
    twist = (e * (apart / (1 + grown_T))) * (x * (apart / (1 + grown_S)))
    denominator = 4 + 4 * (e + x) - twist
    admitted = denominator > 0
    weight = 4 * reach / select(admitted, denominator, 1 + 0 * denominator)  # N of (E2)
    amplitude = c.a_S * eta / 4 * weight / power(1 + grown_S, 2 * r - row.distance)
    amplitude = select(admitted, amplitude, 0 * amplitude + np.inf)
    p = select(still, 0 * grown_T, 1 / power(1 + grown_T, 2))  # w_j = p^|j - j0|
    return RowBound(*(sqrt(amplitude * total) for total in _weighted_sums(row.j0, c.a_T, p, k)))


def _times(count: Any, number: Number) -> Number:
    """Multiply by counts, which exact arithmetics take only as Python ints."""
    return (int(count) if np.ndim(count) == 0 else count) * number


def _weighted_sums(j0: int, a_T: Number, p: Number, k: Any) -> tuple[Number, Number, Number]:
    """Return ``sum w_j``, ``sum w_j s_{j+1}^2`` and ``sum w_j s_{k-1-j}^2``."""
    gamma2, first2 = power(gamma_T(a_T), 2), power(slice_first(a_T), 2)
    n = np.asarray(k) - 1
    if j0 == 0:
        return (
            geometric_sum(p, 1, n),
            first2 * geometric_sum(p * gamma2, 1, n),
            first2 * geometric_sum(p, gamma2, n),
        )
    rest = np.maximum(n - 1, 0)  # the steps j >= 1; step 0 has weight p
    return (
        p + geometric_sum(p, 1, rest),
        first2 * (p + gamma2 * geometric_sum(p * gamma2, 1, rest)),
        first2 * (p * power(gamma2, rest) + geometric_sum(p, gamma2, rest)),
    )


def float_count(count: Any) -> Any:
    """Return a count as a float (arrays as they are); beyond the floats, infinity."""
    if np.ndim(count):
        return count
    return float(count) if count < 2**1024 - 2**970 else np.inf


def best_share(row: Row, c: Couplings, eta: Number, k: Any, r: Any) -> Any:
    """Return the share on the grid with the least coefficient of D, floats only.

    Parameters and shapes as in `row_bound`; returns ints of the shape of ``k, r`` (and
    of the couplings) broadcast together.
    """
    shape = np.broadcast_shapes(*(np.shape(v) for v in (c.a_T, c.a_S, eta, k, r)))
    grid = np.arange(1, SHARES).reshape((-1,) + (1,) * len(shape))
    bound = row_bound(row, c, eta, k, r, grid)
    cost = np.broadcast_to(bound.D_part + bound.Z_part, (SHARES - 1, *shape))
    best = 1 + np.argmin(np.where(np.isnan(cost), np.inf, cost), axis=0)
    return int(best) if best.ndim == 0 else best
