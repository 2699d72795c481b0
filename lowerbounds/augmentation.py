"""Resource augmentation, measured: how much more LPC has to see than the best algorithm."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from ..bounds import Pair, Parameters, Setting
from ..bounds.lower import best_excess
from ..bounds.planner import plan_excess
from ..bounds.resource import spatial_ratio_of_printed_rates, temporal_ratio_of_printed_rates
from ..graphs import InputError, Network, network_growth
from ..lpc.arrays import Floats, integer
from ..lpc.instances import instance
from .styles import quadratic_style
from .worst_case import worst_case

Progress = Callable[[str], None]
PRINTED = (4.0, 32.0)  # k/k* and r/r* of the paper


@dataclass(frozen=True)
class Augmented:
    """What LPC needs to do as well as anybody could at ``(k*, r*)``.

    Parameters
    ----------
    k_star, r_star : int
        Look-ahead and radius of the best algorithm.
    lower : float
        No algorithm with these has a smaller ``CR - 1`` over all costs with the constants and
        the largest degree given.
    measured : tuple of Pair
        All minimal ``(k, r)`` with which the worst case of LPC over the data of one network with
        uniform couplings is at most `lower`; empty if none was found in the range searched. Over
        all couplings LPC may need more.
    certified : tuple of Pair
        All minimal ``(k, r)`` with which LPC is proven to be at most `lower`, over all costs.
    """

    k_star: int
    r_star: int
    lower: float
    measured: tuple[Pair, ...]
    certified: tuple[Pair, ...]

    @property
    def factors(self) -> tuple[float, float] | None:
        """``(k/k*, r/r*)`` of the measured pair of least ``k + r``."""
        return self._factors(self.measured)

    @property
    def certified_factors(self) -> tuple[float, float] | None:
        """``(k/k*, r/r*)`` of the certified pair of least ``k + r``."""
        return self._factors(self.certified)

    def _factors(self, pairs: tuple[Pair, ...]) -> tuple[float, float] | None:
        if not pairs:
            return None
        least = min(pairs, key=lambda p: (p.k + p.r, p.k))
        return least.k / self.k_star, least.r / self.r_star


def augmentation(
    network: Network,
    H: int,
    parameters: Parameters,
    stars: Iterable[tuple[int, int]],
    *,
    k_max: int = 12,
    r_max: int = 12,
    style: str = "attraction",
    progress: Progress | None = None,
) -> tuple[Augmented, ...]:
    """Return for each ``(k*, r*)`` the least ``(k, r)`` of LPC, measured and certified.

    The worst case is not monotone in r: every pair with ``k <= k_max``, ``r <= r_max`` is looked
    at. Beyond H steps and all of the network LPC sees everything, and nothing changes.

    Parameters
    ----------
    network : Network
    H : int
        Steps.
    parameters : Parameters
        mu, l_f, l_T, l_S: one float each.
    stars : iterable of (int, int)
        ``k* >= 1`` and ``r* >= 1``.
    k_max, r_max : int
        The largest k and r that are measured.
    style : str
        Of the couplings, see `nearsight.lpc.instance`.
    progress : callable, optional
        Called with a short text now and then.

    References
    ----------
    Paper, ``coro:resource-augmentation``.
    """
    stars = tuple(stars)
    if any(min(star) < 1 for star in stars):
        raise InputError(f"stars = {stars}: pairs of integers >= 1 are needed", "stars")
    measured = scan(network, H, parameters, k_max, r_max, style=style, progress=progress)
    setting = Setting(parameters, network_growth(network), unconstrained=True)
    found = []
    for k, r in stars:
        lower = float(best_excess(setting.a_T, setting.a_S, setting.max_degree, k, r))
        certified = plan_excess(setting, lower, "sharp").frontier if lower > 0 else ()
        found.append(Augmented(k, r, lower, _minimal(measured, lower), certified))
        if progress is not None:
            progress(f"k* = {k}, r* = {r}: planned")
    return tuple(found)


def scan(
    network: Network,
    H: int,
    parameters: Parameters,
    k_max: int,
    r_max: int,
    *,
    style: str = "attraction",
    progress: Progress | None = None,
) -> tuple[Pair, ...]:
    """Return the exact worst cases of all ``2 <= k <= k_max``, ``1 <= r <= r_max``, row by row."""
    integer(k_max, "k_max", 2)
    integer(r_max, "r_max", 1)
    problem = instance(network, H, parameters, style=quadratic_style(style))
    found = []
    for k in range(2, k_max + 1):
        for r in range(1, r_max + 1):
            value = worst_case(problem, k, r).cr_minus_one
            found.append(Pair(k, r, value, "worst case"))
            if progress is not None:
                progress(f"k = {k}, r = {r}: worst CR - 1 = {value:.4g}")
    return tuple(found)


def _minimal(pairs: tuple[Pair, ...], excess: float) -> tuple[Pair, ...]:
    """Return the pairs at or below `excess` that no other such pair matches in both k and r."""
    best: list[Pair] = []
    for p in pairs:  # by k, then r
        if p.excess <= excess and (not best or p.r < best[-1].r):
            best.append(p)
    return tuple(best)


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
