"""What a plan is: pairs (k, r) per tier, with their work, price and bottleneck."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Literal

import numpy as np

from ..graphs.errors import InputError
from .frontier import Pair
from .setting import Setting
from .theorem import Tier

TIERS: tuple[Tier, ...] = ("stated", "repaired", "sharp")


@dataclass(frozen=True)
class Prices:
    """What one step of horizon and one hop of radius cost; none may be negative."""

    k: float = 1.0
    r: float = 1.0

    def __post_init__(self) -> None:
        for name in ("k", "r"):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise InputError(
                    f"price of {name} = {value}: a finite number >= 0 is needed", f"price_{name}"
                )

    def of(self, pair: Pair) -> float:
        """Return the price of a pair."""
        return self.k * pair.k + self.r * pair.r


@dataclass(frozen=True)
class Bottleneck:
    """Which single increment lowers the bound more, at the pair of a plan.

    Attributes
    ----------
    name : {"k", "r", "both", "neither"}
        ``both`` if they lower it equally, ``neither`` if none lowers it.
    excess_k, excess_r : float
        Bound on ``CR - 1`` at ``(k+1, r)`` and at ``(k, r+1)``.
    """

    name: Literal["k", "r", "both", "neither"]
    excess_k: float
    excess_r: float


@dataclass(frozen=True)
class TierPlan:
    """The plan of one tier.

    Attributes
    ----------
    tier : str
        "stated", "repaired" or "sharp".
    guarantee : bool
        Whether the pairs are known to reach the target.
    pair : Pair or None
        The one of least ``k + r``, then least k; None if the target is out of reach.
    frontier : tuple of Pair
        All Pareto-minimal pairs, by increasing k.
    cheapest : Pair or None
        The one of least price, then least ``k + r``, then least k.
    bottleneck : Bottleneck or None
        At ``pair``.
    work : tuple of int
        For each pair of the frontier ``(k-1) max_v |N_v^{r-1}|``: the free variables
        (blocks of n numbers) of the largest local problem.
    reason : str
        Why there is no pair, or no guarantee; else empty.
    """

    tier: Tier
    guarantee: bool
    pair: Pair | None
    frontier: tuple[Pair, ...]
    cheapest: Pair | None
    bottleneck: Bottleneck | None
    work: tuple[int, ...]
    reason: str


@dataclass(frozen=True)
class Plan:
    """Plans of all tiers for one target."""

    target: float
    setting: Setting
    tiers: tuple[TierPlan, ...]
    prices: Prices = field(default_factory=Prices)

    def __getitem__(self, tier: str) -> TierPlan:
        for plan in self.tiers:
            if plan.tier == tier:
                return plan
        raise KeyError(f"no plan for tier {tier!r}; there are: {', '.join(TIERS)}")
