r"""The local perturbation bound of Definition 3.1, in all its tiers.

A perturbation of one boundary variable ``(tau, u)`` of a local problem moves the
solution at ``(t0, v0)`` by at most ``C rho_T^{|t0-tau|} rho_S^{d(v0,u)}`` times its size;
``C = C_2`` for the bottom (time t-1) and ``C_1`` for the lateral and top boundary.
"""

from __future__ import annotations

from typing import NamedTuple

from .arithmetic import Number, maximum, power, sqrt
from .decay import demko, g, half_over_g, one_minus_rho, over_rho, rho
from .formula import formula


class LocalBound(NamedTuple):
    """Constants and rates, with the complements of the rates as values of their own."""

    C_1: Number
    C_2: Number
    rho_T: Number
    rho_S: Number
    one_minus_rho_T: Number
    one_minus_rho_S: Number


def _regrouped(C_1: Number, C_2: Number, a_T: Number, x: Number) -> LocalBound:
    y = 2 * a_T
    return LocalBound(C_1, C_2, rho(y), rho(x), one_minus_rho(y), one_minus_rho(x))


@formula(counts=("max_degree",))
def local_stated(a_T: Number, a_S: Number, max_degree: int) -> LocalBound:
    """Return ``C_1 = C_2 = 2 sqrt(Delta l_S l_T)/mu`` as printed.

    References
    ----------
    Paper, ``thm:networked-exp-decay``.
    """
    x = max_degree * a_S
    C = 2 * sqrt(x) * sqrt(a_T)
    return _regrouped(C, C, a_T, x)


@formula(counts=("max_degree",))
def local_repaired(a_T: Number, a_S: Number, max_degree: int) -> LocalBound:
    r"""Return the constants that the printed argument gives once its slips are mended.

    ``C_2 = c2 a/(2 rho_T)`` and ``C_1 = (c2/2) max(a/rho_T, sqrt(Delta) a_S/rho_S)`` with
    ``c2 = sqrt(c(1+2a) c(1+x))``: the geometric mean of the time-slice and the column
    bound on an entry of the inverse Hessian, times the norm of the cross block, which is
    ``l_T/2`` for a top or bottom variable (one free neighbour, one step nearer) and at
    most ``sqrt(Delta) l_S/2`` for a lateral one (up to Delta free neighbours, one hop
    nearer).
    """
    x = max_degree * a_S
    c2 = sqrt(demko(1 + 2 * a_T) * demko(1 + x))
    in_time = over_rho(2 * a_T) / 2  # a/rho_T
    in_space = over_rho(x) / sqrt(max(max_degree, 1) * (1 + 0 * x))  # sqrt(Delta) a_S/rho_S
    return _regrouped(c2 / 2 * maximum(in_time, in_space), c2 / 2 * in_time, a_T, x)


class Sums(NamedTuple):
    """``a`` and ``a_tilde`` of ``thm:networked-exp-decay-tight``, perhaps infinite."""

    a: Number
    a_tilde: Number


@formula(counts=("max_degree",))
def local_tight(
    a_T: Number,
    a_S: Number,
    max_degree: int,
    b_1: Number,
    b_2: Number,
    a: Number,
    a_tilde: Number,
) -> LocalBound:
    r"""Return the bound that scales linearly in weak couplings.

    ``rho_T = 4 a_tilde l_T/mu``, ``rho_S = (1+b_1+b_2) gamma_S`` and ``C_1 = C_2`` the
    larger of ``a^2/(2 a_tilde (1-rho_T))`` and
    ``2 a^2 x/(gamma_S (1+b_1+b_2)(1-rho_T))``, ``x = Delta l_S/mu``.

    Parameters
    ----------
    a, a_tilde : number
        ``sum_q ((1+b_1)/(1+b_1+b_2))^q h(q)`` and ``sum_q (1+b_1)^{-q} h(q)``.

    References
    ----------
    Paper, ``thm:networked-exp-decay-tight``; read line by line, no slip found.
    """
    x, widening = max_degree * a_S, 1 + b_1 + b_2
    rho_T, rho_S = 4 * a_tilde * a_T, widening * g(x)
    in_time = power(a, 2) / (2 * a_tilde)
    in_space = 4 * power(a, 2) * half_over_g(x) / widening  # x/gamma_S is 2 half_over_g
    C = maximum(in_time, in_space) / (1 - rho_T)
    return LocalBound(C, C, rho_T, rho_S, 1 - rho_T, 1 - rho_S)


def tight_margins(
    a_T: Number, x: Number, b_1: Number, b_2: Number, a_tilde: Number
) -> tuple[Number, Number]:
    """Return ``1 - 8 a_tilde l_T/mu`` and ``1 - Delta l_S (b_1+b_2)/(4 mu)``: both ``>= 0``.

    The two halves of ``mu >= max{8 a_tilde l_T, Delta l_S (b_1+b_2)/4}``. The second
    implies ``rho_S < 1``: with ``s = sqrt(1+x)``, ``gamma_S + 4/(s+1)^2 =
    (s^2+3)/(s+1)^2 < 1``.
    """
    return 1 - 8 * a_tilde * a_T, 1 - x * (b_1 + b_2) / 4
