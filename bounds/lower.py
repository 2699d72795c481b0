r"""What no algorithm gets below: the lower bounds in closed form.

Written without differences of nearly equal numbers: the plain subtraction
``B_jj - ((I + l L)_{SS}^{-1})_jj`` returns 0 already at moderate radii.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from .arithmetic import Number, maximum, power, select, sqrt
from .decay import g, gamma_T
from .formula import formula


@formula(counts=("k",))
def temporal_excess(a_T: Number, k: Any) -> Number:
    r"""Return ``gamma_T^{2k}/(sqrt(1+2a) - 1)``, the temporal lower bound on ``CR - 1``.

    One agent that sees k steps ahead, costs ``(mu/2)(x - theta_t)^2`` and
    ``(l_T/4)(x_t - x_{t-1})^2``, the horizon to infinity. Evaluated as
    ``gamma_T^{2k-1}/(sqrt(1+2a) + 1)``, which has no 0/0 as ``l_T -> 0``.
    """
    return power(gamma_T(a_T), 2 * np.asarray(k) - 1) / (sqrt(1 + 2 * a_T) + 1)


@formula(counts=("k",))
def final_excess(a_T: Number, k: Any) -> Number:
    r"""Return the temporal lower bound on ``CR - 1`` from the last target alone.

    The costs of `temporal_excess`, but only ``theta_H`` is random (mean zero), H to
    infinity. Actions before step ``H-k+1`` cannot depend on it, so with B the inverse of
    the chain's Hessian over mu and S the last k steps every policy has ``CR - 1 >=
    (B_HH - ((B^{-1})_{SS}^{-1})_HH)/(1 - B_HH)``, which is
    ``gamma_T^{2k-1} (1+gamma_T)^2/((1 + gamma_T^{2k+1}) sqrt(1+2a))``: between 2 and 4
    times `temporal_excess`, at the same rate.
    """
    gamma, steps = gamma_T(a_T), 2 * np.asarray(k)
    scale = power(1 + gamma, 2) / ((1 + power(gamma, steps + 1)) * sqrt(1 + 2 * a_T))
    return power(gamma, steps - 1) * scale


def block_size(max_degree: int) -> int:
    """Return ``floor(Delta/2)``, the block size of the ring of blocks within degree Delta."""
    return max_degree // 2


@formula(counts=("d", "r"))
def spatial_excess(a_S: Number, d: int, r: Any) -> Number:
    r"""Return the lower bound on ``CR - 1`` of the infinite ring of blocks.

    One step, costs ``(mu/2)(x_i + w_i)^2`` and ``(l_S/4)(x_i - x_j)^2``, independent
    ``w_i``: every decentralised policy with radius r, nonlinear or randomised, pays at
    least ``1 + (B_jj - ((I+lL)_{SS}^{-1})_jj)/(1 - B_jj)`` times the optimum in
    expectation, S the ball of radius r around j, ``l = a_S/2``, ``x = 4 d l = 2 d a_S``.

    For ``r >= 2`` the ball is a chain of ``2r+1`` whole blocks, and with ``q = g(x)`` the
    difference is ``2 q^{2(r+1)}/(d sqrt(1+x) (1 + q^{2(r+1)}))``; for ``r = 1`` it is j
    with two blocks, and an algebraic expression with positive terms only.

    Parameters
    ----------
    a_S : number
        ``l_S/mu``.
    d : int
        Vertices a block, ``>= 1``; the degree is ``2 d``.
    r : int or array of int
        Radius, ``>= 1``.
    """
    x = 2 * d * a_S
    s, m = sqrt(1 + x), 1 + x / 2
    tail = power(g(x), 2 * (np.maximum(r, 1) + 1))
    far = 2 * tail / (d * s * (1 + tail))
    # r = 1: (x^2/(4dm)) [1/(s(m+s)) - 1/(2 m^2 - x^2/(4d))], on one denominator
    near = (m * (2 * d - 1) + s * (d - 1)) / (d * (m + s))
    inner = 1 + x + power(x, 2) * (2 * d - 1) / (8 * d)  # m^2 - x^2/(8d)
    near = power(x, 4) * near / (32 * d * m * s * (m + s) * inner)
    # 1 - B_jj, with 1 - 1/sqrt(1+x) = x/(s (s+1)) and 1 - 1/m = (x/2)/m
    rest = (x / (s * (s + 1)) + (d - 1) * x / (2 * m)) / d
    coupled = rest > 0
    return select(np.equal(r, 1), near, far) / select(coupled, rest, 1 + 0 * rest)


@formula()
def lambda_T_stated(a_T: Number) -> Number:
    """Return ``(1 - 2/(sqrt(1 + 4 l_T/mu) + 1))^2 = g(4 a)^2`` of ``thm:bottleneck``."""
    return power(g(4 * a_T), 2)


@formula()
def lambda_S_stated(x: Number) -> Number:
    """Return ``lambda_S`` of ``thm:bottleneck``, ``x = Delta l_S/mu``, its two cases in one.

    ``x/(3+3x)``, and from ``x = 48`` on at least ``(1 - 4 sqrt(3)/sqrt(x))^2``.
    """
    weak = x / (3 + 3 * x)
    large = x >= 48
    safe = select(large, x, 48 + 0 * x)
    return select(large, maximum(weak, power(1 - sqrt(48 / safe), 2)), weak)


@formula(counts=("max_degree",))
def lambda_S_proven(a_S: Number, max_degree: int) -> Number:
    """Return ``g(2 floor(Delta/2) l_S/mu)^2``, the rate of `spatial_excess` in r."""
    return power(g(2 * block_size(max_degree) * a_S), 2)


def best_excess(a_T: Number, a_S: Number, max_degree: int, k: Any, r: Any) -> Number:
    """Return the larger of the (better) temporal and the spatial lower bound on ``CR - 1``.

    A network of degree below 2 holds no ring of blocks: the temporal bound alone.
    """
    temporal = final_excess(a_T, k)
    d = block_size(max_degree)
    return maximum(temporal, spatial_excess(a_S, d, r)) if d else temporal
