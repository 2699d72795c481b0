"""Which horizon and radius reach a target competitive ratio, in every tier."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np

from ..graphs.errors import InputError
from .constants import Regrouped, Tight
from .frontier import Pair, Search, frontier
from .hypotheses import global_implied, local_implied
from .paper_promise import PaperPromise
from .plans import TIERS, Bottleneck, Plan, Prices, TierPlan
from .promise import Promise
from .ratio import ratio_parts, smoothness
from .reach import reach
from .setting import Setting
from .sharp_promise import SharpPromise
from .theorem import Tier
from .tight import Choice, choice, optimise


def plan(
    setting: Setting,
    target: float,
    *,
    prices: Prices | None = None,
    search: Search | None = None,
    tiers: tuple[Tier, ...] = TIERS,
) -> Plan:
    """Return the least k and r, and the whole Pareto frontier, for a target.

    Parameters
    ----------
    setting : Setting
        Scalar parameters and the network; ``unconstrained`` allows the certificates
        ``smooth`` and ``mix`` in the sharp tier. Its k and r are not used.
    target : float
        Competitive ratio to reach, finite and ``> 1``.
    prices : Prices, optional
        Price per unit of k and of r, for `TierPlan.cheapest`.
    search : Search, optional
        Largest k and r considered.
    tiers : tuple of str, optional
        Which tiers to plan.

    Returns
    -------
    Plan

    Raises
    ------
    InputError
        If the target is not a finite number above 1, or the parameters are arrays.
    """
    if np.ndim(target) or not (np.isfinite(target) and target > 1):
        raise InputError(f"target = {target}: a finite competitive ratio > 1 is needed", "target")
    wrong = [tier for tier in tiers if tier not in TIERS]
    if wrong or isinstance(tiers, str):
        raise InputError(f"tiers = {tiers!r}: a tuple of {', '.join(TIERS)} is needed", "tiers")
    if any(np.ndim(v) for v in (setting.a_T, setting.a_S, setting.parameters.l_f)):
        raise InputError("a plan takes scalar mu, l_f, l_T, l_S; call it once for each set")
    if not all(np.isfinite(v) for v in (setting.a_T, setting.x, setting.parameters.condition)):
        raise InputError("l_f/mu, l_T/mu and Delta l_S/mu must be finite floats to plan with")
    prices = prices or Prices()
    excess = _excess(float(target))
    plans = tuple(plan_excess(setting, excess, tier, prices, search) for tier in tiers)
    return Plan(float(target), setting, plans, prices)


def _excess(target: float) -> float:
    """Return ``target - 1``, rounded down where a float cannot hold it."""
    excess = target - 1
    return excess if 1 + excess <= target else float(np.nextafter(excess, 0))


def plan_excess(
    s: Setting,
    excess: float,
    tier: Tier,
    prices: Prices | None = None,
    search: Search | None = None,
) -> TierPlan:
    """Return the plan of one tier for ``CR - 1 <= excess``, which may be tiny."""
    prices = prices or Prices()
    pairs: list[Pair] = []
    promises: list[Promise] = []
    reason = ""
    for promise in _promises(tier, s, pairs):
        found = frontier(promise, excess, search)
        pairs += found.pairs
        promises.append(promise)
        reason = reason or found.reason
    best = _pareto(pairs)
    needed = (local_implied(s), global_implied(s)) if tier == "stated" else ()
    doubts = [h.text for h in needed if h.fails]
    if best:
        reason = f"no guarantee here: it fails that {' and '.join(doubts)}" if doubts else ""
    chosen = min(best, key=_size, default=None)
    return TierPlan(
        tier=tier,
        guarantee=bool(best) and not doubts,
        pair=chosen,
        frontier=best,
        cheapest=min(best, key=lambda p: (prices.of(p), _size(p)), default=None),
        bottleneck=_bottleneck(promises, chosen) if chosen else None,
        work=tuple((p.k - 1) * s.growth.ball(p.r - 1) for p in best),
        reason=reason,
    )


def _size(p: Pair) -> tuple[int, int]:
    return p.k + p.r, p.k


def _pareto(pairs: list[Pair]) -> tuple[Pair, ...]:
    """Return the pairs that no other one matches or beats in both k and r, by k."""
    best: list[Pair] = []
    for p in sorted(pairs, key=lambda p: (p.k, p.r, p.excess)):
        if not best or p.r < best[-1].r:
            best.append(p)
    return tuple(best)


def _bottleneck(promises: list[Promise], p: Pair) -> Bottleneck:
    """Compare the tier's bound, the least of its promises, one step and one hop further."""
    longer = min(float(promise.excess(p.k + 1, p.r)) for promise in promises)
    wider = min(float(promise.excess(p.k, p.r + 1)) for promise in promises)
    if min(longer, wider) >= p.excess:
        return Bottleneck("neither", longer, wider)
    if longer == wider:
        return Bottleneck("both", longer, wider)
    return Bottleneck("k" if longer < wider else "r", longer, wider)


def _promises(tier: Tier, s: Setting, found: list[Pair]) -> Iterator[Promise]:
    """Yield the statements of a tier; ``found`` holds what the earlier ones reached."""
    if tier == "sharp":
        for kind in ("vi", "mix", "smooth") if s.unconstrained else ("vi",):
            yield SharpPromise(s, kind)
        return
    yield PaperPromise(s, Regrouped(tier), "thm:networked-exp-decay")
    if tier == "repaired":
        for turn in range(3):  # b_1, b_2 for the best pair so far, and again for the new one
            at = min(found, key=_size, default=Pair(10, 10, np.inf))
            b_1, b_2 = optimise(s.growth, s.a_T, s.a_S, _ratio_at(s, at))
            if 8 * s.a_T > 1 or min(choice(s.growth, s.a_T, s.a_S, b_1, b_2).margins) < 0:
                return
            name = "thm:networked-exp-decay-tight"
            yield PaperPromise(s, Tight(tier, b_1, b_2), f"{name} b_1={b_1:.6g} b_2={b_2:.6g}")
            if turn and min(found, key=_size, default=None) == at:
                return


def _ratio_at(s: Setting, at: Pair) -> Callable[[Choice], Any]:
    """Return the objective of ``b_1, b_2``: the ratio at a pair, whether or not it closes."""
    whole = Regrouped("repaired")(s).whole
    weight = smoothness(s.parameters.condition, s.a_T, s.a_S, s.max_degree)

    def excess(found: Choice) -> Any:
        size = reach(s.growth, found.local.rho_S, at.r)
        p = ratio_parts(found.local, whole, weight, size, at.k, at.r)
        return p.lateral + p.top + p.condition

    return excess
