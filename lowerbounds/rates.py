"""The factors in k and r that the printed rates ask for, over all strengths of couplings."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..bounds.resource import spatial_ratio_of_printed_rates, temporal_ratio_of_printed_rates
from ..graphs import InputError
from ..lpc.arrays import Floats

PRINTED = (4.0, 32.0)  # k/k* and r/r* of the paper


@dataclass(frozen=True, eq=False)
class PrintedRates:
    """The asymptotic factors that the printed rates give, beside those that are printed.

    Parameters
    ----------
    coupling : ndarray, shape (m,)
        ``l_T/mu`` for `temporal`, ``Delta l_S/mu`` for `spatial`.
    temporal, spatial : ndarray, shape (m,)
        ``log lambda_T/log rho_T`` and ``2 log lambda_S/log rho_S``.
    """

    coupling: Floats
    temporal: Floats
    spatial: Floats

    @property
    def exceeding(self) -> tuple[Floats, Floats]:
        """The couplings at which the rates ask for more than 4, and for more than 32."""
        above = (self.temporal > PRINTED[0], self.spatial > PRINTED[1])
        return self.coupling[above[0]], self.coupling[above[1]]


def printed_rates(couplings: ArrayLike | None = None) -> PrintedRates:
    """Return the factors of the printed rates over a range of couplings.

    Parameters
    ----------
    couplings : array_like, optional
        Positive; if omitted, from 1e-12 to 1e12, 20 a decade.

    References
    ----------
    Paper, ``coro:resource-augmentation``, ``thm:bottleneck``, ``thm:networked-exp-decay``.
    """
    grid = np.logspace(-12, 12, 481) if couplings is None else np.asarray(couplings, dtype=float)
    if grid.ndim != 1 or not (np.isfinite(grid) & (grid > 0)).all():
        raise InputError("couplings: a list of positive numbers is needed", "couplings")
    return PrintedRates(
        grid, temporal_ratio_of_printed_rates(grid), spatial_ratio_of_printed_rates(grid)
    )


@dataclass(frozen=True)
class Supremum:
    """The largest factor over all couplings.

    Parameters
    ----------
    value : float
        No coupling asks for more, and none for less than this as the largest.
    coupling : float
        Where: ``l_T/mu`` or ``Delta l_S/mu``; 0 for the limit as it vanishes.
    """

    value: float
    coupling: float


def temporal_supremum() -> Supremum:
    r"""Return the supremum of ``4 log g(4a)/log g(2a)``: 4, as ``a -> 0``.

    ``rho_T^4 = g(2a)^2 <= g(4a)^2 = lambda_T`` because g grows, so that the factor is at most 4;
    ``g(y) ~ y/4`` makes it 4 in the limit.

    References
    ----------
    Paper, ``lemma:temporal-upper-and-lower``.
    """
    return Supremum(PRINTED[0], 0.0)


def spatial_supremum() -> Supremum:
    r"""Return the supremum of ``2 log lambda_S/log rho_S``, about 36.07 at ``x`` about 267.

    With ``y = x^{-1/2}`` and ``log g(x) = -2 asinh y`` the factor is the lesser of

    .. math:: w(y) = \frac{2 \log(3 + 3y^2)}{\operatorname{asinh} y}, \qquad
        s(y) = \frac{-4 \log(1 - c y)}{\operatorname{asinh} y}, \quad c = \sqrt{48},

    the second for ``c y < 1`` only. s increases: a convex function over a concave one, both 0 at
    0. w decreases up to ``y^4 = 4/3``: ``w' < 0`` is ``2 y asinh(y)/sqrt(1+y^2) < log(3+3y^2)``,
    and ``exp(2 asinh y) = 1 + 2y^2 + 2y sqrt(1+y^2) <= 3 + 3y^2`` there. Beyond 1 it is at most
    ``2 log(6y^2)/log(2y) <= 2 log 6/log 2 < 6``. So the largest value is at the one y with
    ``(1 - c y)^2 (3 + 3y^2) = 1``.

    References
    ----------
    Paper, ``coro:resource-augmentation``: 32 from ``rho_S^32 <= lambda_S``, which its bound
    ``h(r)^2 rho_S^r`` with ``h(r)^2 ~ rho_S^{-r/2}`` would need at half the exponent.
    """
    from mpmath import mp

    with mp.workdps(40):
        c = mp.sqrt(48)
        y = mp.findroot(lambda y: (1 - c * y) ** 2 * (3 + 3 * y**2) - 1, (0.05, 0.07), "anderson")
        return Supremum(float(2 * mp.log(3 + 3 * y**2) / mp.asinh(y)), float(1 / y**2))
