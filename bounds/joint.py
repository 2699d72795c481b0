r"""Joint decay in time and space, entry by entry (J).

For rates ``p = e^{-alpha}``, ``q = e^{-beta}`` in (0, 1] with

.. math:: s = 1 - (\cosh\alpha - 1)\,a - (\cosh\beta - 1)\,x/2 > 0

every block of the inverse of any Hessian ``M`` of a local problem obeys
``|(M^{-1})_{(t0,v0),(t1,u)}| <= p^{|t0-t1|} q^{d(v0,u)} / (mu s)`` [Combes-Thomas]. No
square root of the rates, no condition on mu, no growth: it replaces both perturbation
theorems as a guarantee.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from .arithmetic import Number, minimum, power, select, sqrt
from .decay import demko, g, slice_decay
from .formula import formula


class Tilt(NamedTuple):
    """The rates ``p = e^{-alpha}`` per step and ``q = e^{-beta}`` per hop."""

    p: Number
    q: Number


@formula()
def slack(a_T: Number, x: Number, p: Number, q: Number) -> Number:
    """Return ``s``, with ``cosh(alpha) - 1 = (1-p)^2/(2p)``; J holds where it is positive."""
    return 1 - a_T * power(1 - p, 2) / (2 * p) - x * power(1 - q, 2) / (4 * q)


@formula(counts=("dt", "ds"))
def entry_bound(a_T: Number, x: Number, dt: Any, ds: Any, p: Number, q: Number) -> Number:
    """Return the bound on mu times an entry of the inverse Hessian, infinite if ``s <= 0``."""
    s = slack(a_T, x, p, q)
    positive = s > 0
    decayed = power(p, dt) * power(q, ds)
    return select(positive, decayed / select(positive, s, 1 + 0 * s), 0 * decayed + np.inf)


def best_tilt(a_T: Any, x: Any, dt: Any, ds: Any) -> Tilt:
    r"""Return the rates with (nearly) the least bound at distance ``(dt, ds)``; floats.

    Stationarity reads ``sinh(alpha) = dt s/a``, ``sinh(beta) = 2 ds s/x``; put into the
    definition of s this leaves one increasing equation
    ``s + sqrt(a^2 + (dt s)^2) - a + sqrt(x^2/4 + (ds s)^2) - x/2 = 1``, solved by
    bisection. Any rates give a bound, so the rounding of these is harmless.
    """
    a, half_x = np.asarray(a_T, dtype=float), np.asarray(x, dtype=float) / 2
    dt, ds = np.asarray(dt, dtype=float), np.asarray(ds, dtype=float)

    def rise(along: Any, coupling: Any) -> Any:  # sqrt(c^2 + u^2) - c without cancellation
        return along * (along / (np.hypot(coupling, along) + coupling + 1e-300))

    low = np.zeros(np.broadcast_shapes(a.shape, half_x.shape, dt.shape, ds.shape))
    high = low + 1.0
    for _ in range(200):
        s = 0.5 * (low + high)
        over = s + rise(dt * s, a) + rise(ds * s, half_x) > 1.0
        low, high = np.where(over, low, s), np.where(over, s, high)
        if np.all(high - low <= 2e-16 * high):
            break

    def rate(along: Any, coupling: Any) -> Any:  # e^-asinh(u) = 1/(u + sqrt(1 + u^2))
        with np.errstate(divide="ignore", over="ignore", invalid="ignore"):
            u = np.where(along > 0.0, along / coupling, 0.0)
            return np.maximum(1.0 / (u + np.hypot(1.0, u)), 1e-300)

    p, q = rate(dt * low, a), rate(ds * low, half_x)
    return Tilt(*(float(v) if v.ndim == 0 else v for v in (p, q)))


@formula(counts=("dt",))
def slice_entry(y: Number, dt: Any) -> Number:
    """Return ``c(1+y) g(y)^dt``: the axis form (Demko), with no ``1/s``.

    ``y = 2a`` bounds mu times an entry of the inverse Hessian ``dt`` steps apart, ``y = x``
    one ``dt`` hops apart.
    """
    return demko(1 + y) * power(g(y), dt)


@formula(counts=("dt", "ds"))
def top_bound(a_T: Number, x: Number, dt: Any, ds: Any, p: Number, q: Number) -> Number:
    """Return the sharp sensitivity to one top or bottom variable, ``dt >= 1`` steps away.

    ``a/2`` times the entry at ``(dt - 1, ds)``, by the least of (J) at the given rates and
    of the two axis forms; or the sensitivity ``s_dt`` of whole slices, see `slice_decay`,
    whose argument holds for local problems too: with weights that depend on the step only,
    spatial edges cost nothing, and neither does a lateral boundary that stays as it is. At
    ``ds = 0`` it is attained.
    """
    entry = a_T / 2 * _least_entry(a_T, x, np.asarray(dt) - 1, ds, p, q)
    return minimum(entry, slice_decay(a_T, dt))


@formula(counts=("max_degree", "dt", "ds"))
def lateral_bound(
    a_T: Number, a_S: Number, max_degree: int, dt: Any, ds: Any, p: Number, q: Number
) -> Number:
    """Return the sharp sensitivity to one lateral variable, ``ds >= 1`` hops away.

    ``sqrt(Delta) a_S/2`` times the entry at ``(dt, ds - 1)``, as in `top_bound`.
    """
    entry = _least_entry(a_T, max_degree * a_S, dt, np.asarray(ds) - 1, p, q)
    return sqrt(max_degree * (1 + 0 * a_S)) * a_S / 2 * entry


def _least_entry(a_T: Number, x: Number, dt: Any, ds: Any, p: Number, q: Number) -> Number:
    axes = minimum(slice_entry(2 * a_T, dt), slice_entry(x, ds))
    return minimum(axes, entry_bound(a_T, x, dt, ds, p, q))
