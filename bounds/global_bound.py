r"""The global perturbation bound: how a whole time slice decays.

.. math:: |\tilde\psi(y, z)_{t_0} - \tilde\psi(y', z')_{t_0}|
          \le C_G \rho_G^{t_0-t+1} |y - y'| + C_G \rho_G^{t+p-1-t_0} |z - z'|
"""

from __future__ import annotations

from typing import NamedTuple

from .arithmetic import Number, maximum, sqrt
from .decay import demko, gamma_T, half_over_g, one_minus_g, slice_first
from .formula import formula


class GlobalBound(NamedTuple):
    """``C_G``, ``rho_G``, ``C_0 = max(1, C_G)`` and ``1 - rho_G`` as a value of its own."""

    C_G: Number
    rho_G: Number
    C_0: Number
    one_minus_rho_G: Number


def _bound(a_T: Number, C_G: Number) -> GlobalBound:
    return GlobalBound(C_G, gamma_T(a_T), maximum(1 + 0 * C_G, C_G), one_minus_g(2 * a_T))


@formula()
def global_stated(a_T: Number) -> GlobalBound:
    """Return ``C_G = 2 l_T/mu`` as printed.

    References
    ----------
    Paper, ``thm:global-exp-decay``.
    """
    return _bound(a_T, 2 * a_T)


@formula()
def global_repaired(a_T: Number) -> GlobalBound:
    r"""Return ``C_G = c(1+2a) a/(2 gamma_T)``, the printed argument without its slip.

    The cross block between two slices has norm at most ``l_T/2``, and the entries of the
    inverse Hessian are at most ``c(1+2a) gamma_T^{d-1}/mu`` at distance ``d - 1``: the
    printed statement writes the exponent ``d`` in place of ``d - 1``.
    """
    return _bound(a_T, demko(1 + 2 * a_T) * half_over_g(2 * a_T) / 2)


@formula()
def global_sharp(a_T: Number) -> GlobalBound:
    """Return ``C_G = a/(2 gamma_T sqrt(1+a))``: ``C_G rho_G^d = s_d``, see `slice_decay`."""
    return _bound(a_T, half_over_g(2 * a_T) / (2 * sqrt(1 + a_T)))


@formula()
def accumulation_sharp(a_T: Number) -> Number:
    """Return ``S = 1 + s_1/(1 - gamma_T)``, with ``|x - x*| <= S |e|`` in l2 over time.

    ``x - x*`` is at most the convolution of the per-step errors with ``1, s_1, s_2, ..``,
    whose sum is S (Young's inequality).
    """
    return 1 + slice_first(a_T) / one_minus_g(2 * a_T)


@formula()
def accumulation(C_0: Number, one_minus_rho_G: Number) -> Number:
    """Return ``C_0/(1 - rho_G)``, the factor of ``thm:alg-perf-bound-err-inject`` unsquared."""
    return C_0 / one_minus_rho_G
