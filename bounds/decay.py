r"""Decay factors.

Everything grows out of one function of a coupling strength ``y``,

.. math:: g(y) = \frac{\sqrt{1+y}-1}{\sqrt{1+y}+1} = \frac{y}{(\sqrt{1+y}+1)^2},

the second form because the first cancels for small ``y``. ``gamma_T = g(2 l_T/mu)``
(the paper's ``rho_G``), ``gamma_S = g(Delta l_S/mu)``; ``rho_T``, ``rho_S`` of
``thm:networked-exp-decay`` are their square roots.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .arithmetic import Number, asinh, maximum, power, select, sqrt
from .formula import formula


@formula()
def g(y: Number) -> Number:
    """Return ``(sqrt(1+y) - 1)/(sqrt(1+y) + 1)`` without cancellation, ``y >= 0``."""
    return y / power(sqrt(1 + y) + 1, 2)


@formula()
def one_minus_g(y: Number) -> Number:
    """Return ``1 - g(y) = 2/(sqrt(1+y) + 1)``, accurate where ``g(y)`` rounds to 1."""
    return 2 / (sqrt(1 + y) + 1)


def log_g(y: Number) -> Number:
    """Return ``log g(y) = -2 asinh(1/sqrt(y))``, ``y > 0``; no loss where g is near 1."""
    return -2 * asinh(1 / sqrt(y))


@formula()
def gamma_T(a_T: Number) -> Number:
    """Return ``g(2 a_T)``, ``a_T = l_T/mu``: the rate per step, and the paper's rho_G."""
    return g(2 * a_T)


@formula()
def gamma_S(x: Number) -> Number:
    """Return ``g(x)``, ``x = Delta l_S/mu``: the rate per hop."""
    return g(x)


@formula()
def rho(y: Number) -> Number:
    """Return ``sqrt(g(y))``: ``rho_T = rho(2 a_T)``, ``rho_S = rho(x)``.

    References
    ----------
    Paper, ``thm:networked-exp-decay``.
    """
    return sqrt(y) / (sqrt(1 + y) + 1)


@formula()
def one_minus_rho(y: Number) -> Number:
    """Return ``1 - sqrt(g(y)) = (1 - g(y))/(1 + sqrt(g(y)))`` as a value of its own."""
    return one_minus_g(y) / (1 + rho(y))


@formula()
def half_over_g(y: Number) -> Number:
    """Return ``y/(2 g(y)) = (1 + sqrt(1+y))^2/2``: no 0/0 when a coupling vanishes."""
    return power(1 + sqrt(1 + y), 2) / 2


@formula()
def over_rho(y: Number) -> Number:
    """Return ``y/rho(y) = sqrt(y) (1 + sqrt(1+y))``: no 0/0 when a coupling vanishes."""
    return sqrt(y) * (1 + sqrt(1 + y))


@formula()
def demko(kappa: Number) -> Number:
    """Return ``c(kappa) = max(1, (1 + sqrt(kappa))^2/(2 kappa))``, at most 2.

    The constant of the entries of the inverse of a banded matrix of condition number
    ``kappa >= 1``; the first argument of the maximum only matters at distance 0.

    References
    ----------
    Demko, Moss, Smith, *Decay rates for inverses of band matrices*, Math. Comp. 43
    (1984), Theorem 2.4 (with the maximum that distance 0 needs).
    """
    return maximum(1 + 0 * kappa, power(1 + sqrt(kappa), 2) / (2 * kappa))


@formula()
def slice_first(a_T: Number) -> Number:
    """Return ``s_1 = a/(2 sqrt(1+a))``, see `slice_decay`."""
    return a_T / (2 * sqrt(1 + a_T))


@formula(counts=("d",))
def slice_decay(a_T: Number, d: Any) -> Number:
    r"""Return the sharp sensitivity ``s_d`` of a time slice at distance d from another.

    .. math:: s_0 = 1, \qquad s_d = \frac{a}{2\sqrt{1+a}}\,\gamma_T^{d-1} \quad (d \ge 1)

    with ``a = l_T/mu``; for the problem between two fixed slices and for the one that
    runs until the end alike, any convex product constraints included. Attained by
    scalar instances with optimised asymmetric couplings: it cannot be improved.

    Parameters
    ----------
    a_T : number
        ``l_T/mu >= 0``.
    d : int or array of int
        Distance in time steps, ``>= 0``.
    """
    decayed = slice_first(a_T) * power(gamma_T(a_T), np.maximum(d, 1) - 1)
    return select(np.equal(d, 0), 1 + 0 * decayed, decayed)
