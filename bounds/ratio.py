r"""The competitive ratio of ``coro:CR-LPC`` with the explicit constants of its appendix."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from .arithmetic import Number, power
from .formula import formula
from .global_bound import GlobalBound
from .local_bound import LocalBound


class Reach(NamedTuple):
    """What the network contributes at radius r: ``h(r)`` and ``C_3(r)``."""

    h: Number
    C_3: Number


class PerStep(NamedTuple):
    """The three coefficients of ``thm:per-step-err``.

    ``e_t^2 <= history |x_{t-1} - x*_{t-1}|^2
    + lateral sum_tau rho_T^{tau-t} f_tau(x*_tau)/mu + top f_{t+k-1}(x*_{t+k-1})/mu``.
    """

    history: Number
    lateral: Number
    top: Number


class RatioParts(NamedTuple):
    """``CR - 1 = lateral + top``, provided ``condition <= 1/2``."""

    lateral: Number
    top: Number
    condition: Number


def _history(local: LocalBound, whole: GlobalBound, reach: Reach, k: Any, r: Any) -> Number:
    """``h(r)^2 rho_G^2 rho_S^{2r}/((1-rho_T)(1-rho_G^2 rho_T)) + C_3^2 rho_T^{2(k-1)} rho_G^{2k}``.

    ``1 - rho_G^2 rho_T`` as ``(1-rho_G)(1+rho_G) + rho_G^2 (1-rho_T)``: no cancellation.
    """
    rho_G2 = power(whole.rho_G, 2)
    far = whole.one_minus_rho_G * (1 + whole.rho_G) + rho_G2 * local.one_minus_rho_T
    side = power(reach.h * power(local.rho_S, r), 2) * rho_G2 / (local.one_minus_rho_T * far)
    steps = np.asarray(k) - 1
    return side + power(reach.C_3 * power(local.rho_T, steps) * power(whole.rho_G, k), 2)


def per_step(local: LocalBound, whole: GlobalBound, reach: Reach, k: Any, r: Any) -> PerStep:
    """Return the coefficients of the per-step error bound.

    References
    ----------
    Paper, ``thm:per-step-err``, equation (``thm:per-step-err:e0``).
    """
    C_1 = local.C_1
    side = power(reach.h * power(local.rho_S, r), 2) / local.one_minus_rho_T
    top = power(reach.C_3 * power(local.rho_T, np.asarray(k) - 1), 2)
    return PerStep(
        4 * power(C_1 * whole.C_0, 2) * _history(local, whole, reach, k, r),
        8 * power(C_1, 2) * side,
        8 * power(C_1, 2) * top,
    )


def ratio_parts(
    local: LocalBound,
    whole: GlobalBound,
    smoothness: Number,
    reach: Reach,
    k: Any,
    r: Any,
) -> RatioParts:
    r"""Return the two parts of ``CR - 1`` and the left side of its condition.

    Parameters
    ----------
    smoothness : number
        ``(l_f + Delta l_S + 2 l_T)/mu``.

    References
    ----------
    Paper, proof of ``coro:CR-LPC``, equations (``coro:CR-LPC:e1``) and
    (``coro:CR-LPC:e2-0``), which asks ``condition <= 1/2``.
    """
    scale = power(whole.C_0 * local.C_1 / whole.one_minus_rho_G, 2)  # C_0^2 C_1^2/(1-rho_G)^2
    weight = 32 * scale * smoothness
    lateral = 1 + weight * power(reach.h / local.one_minus_rho_T, 2)
    top = 1 + weight * power(reach.C_3, 2)
    return RatioParts(
        lateral * power(local.rho_S, r),
        top * power(local.rho_T, np.asarray(k) - 1),
        4 * scale * power(whole.C_0, 2) * _history(local, whole, reach, k, r),
    )


@formula(counts=("max_degree",))
def smoothness(condition: Number, a_T: Number, a_S: Number, max_degree: int) -> Number:
    """Return ``(l_f + Delta l_S + 2 l_T)/mu``, the smoothness of the total cost over mu."""
    return condition + max_degree * a_S + 2 * a_T
