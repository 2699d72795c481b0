"""Resource augmentation, measured: how much more LPC has to see than the best algorithm."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass

from ..bounds import Pair, Parameters, Setting
from ..bounds.planner import plan_excess
from ..graphs import InputError, Network, network_growth
from ..lpc.arrays import integer
from ..lpc.instances import instance
from .floor import floor
from .rows import Row
from .styles import quadratic_style
from .worst_case import worst_case

Progress = Callable[[str], None]


@dataclass(frozen=True)
class Augmented:
    """What LPC needs to do as well as anybody could at ``(k*, r*)``.

    Parameters
    ----------
    k_star, r_star : int
        Look-ahead and radius of the best algorithm.
    lower : float
        No algorithm with these has a smaller ``CR - 1`` over all costs with the constants on
        this network: the largest bound of `nearsight.lowerbounds.floor`.
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
        lower = floor(setting, network, k, r).cr_minus_one
        found.append(_augmented(setting, k, r, lower, measured))
        if progress is not None:
            progress(f"k* = {k}, r* = {r}: planned")
    return tuple(found)


def augmented(rows: Iterable[Row], setting: Setting) -> tuple[Augmented, ...]:
    """Return the same for every ``(k*, r*)`` of a sandwich, LPC measured at its pairs.

    Parameters
    ----------
    rows : iterable of Row
    setting : Setting
        Constants and network, every set all of R^n.
    """
    rows = tuple(rows)
    measured = tuple(Pair(row.k, row.r, row.worst, "worst case") for row in rows)
    return tuple(_augmented(setting, row.k, row.r, row.lower, measured) for row in rows)


def _augmented(
    setting: Setting, k: int, r: int, lower: float, measured: tuple[Pair, ...]
) -> Augmented:
    certified = plan_excess(setting, lower, "sharp").frontier if lower > 0 else ()
    return Augmented(k, r, lower, _minimal(measured, lower), certified)


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
