"""``coro:resource-augmentation``: how much more LPC must see than the best algorithm."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import replace
from typing import Any, ClassVar

import numpy as np

from ..arithmetic import Number, approximate
from ..lower import best_excess, block_size
from ..planner import plan_excess
from ..resource import (
    contains_ring_of_blocks,
    converges_up_to,
    ratio_of_blocks,
    spatial_ratio_of_printed_rates,
    temporal_ratio_of_printed_rates,
)
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier


class Stated(Bound):
    """As printed: ``k = (4 + o(1)) k*``, ``r = (32 + o(1)) r*``.

    Beside them the ratios of the printed rates at these couplings. Its proof rests on
    the printed lower bound; where the sharp statement applies it implies this one.
    With k and r given, they are read as ``k*, r*``: ``k_needed, r_needed`` are the
    least horizon and radius with which the tier's bound on LPC is at most the proven
    lower bound there, ``excess`` above 1.
    """

    label = "coro:resource-augmentation"
    tier: ClassVar[Tier] = "stated"
    title = "k/k* and r/r* with which LPC beats the best algorithm"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the asymptotic ratios (k and r apart, see `needed`)."""
        one = 1 + 0 * (s.a_T + s.a_S)
        in_time = temporal_ratio_of_printed_rates(s.a_T)
        in_space = spatial_ratio_of_printed_rates(s.x)
        return {"k_ratio": 4 * one, "r_ratio": 32 * one} | {
            "k_ratio_of_rates": in_time,
            "r_ratio_of_rates": in_space,
        }

    def in_floats(self, s: Setting) -> dict[str, Any]:
        """Return the values in plain floats: logarithms lose nothing here."""
        coupling = {"k": s.a_T, "r": s.a_S}  # by the first letter of a ratio's name
        values = {
            name: np.where(np.equal(coupling[name[0]], 0.0), np.nan, value)[()]
            for name, value in self.values(s).items()
            if np.any(coupling[name[0]])
        }
        return values | self.needed(s)

    def needed(self, s: Setting) -> dict[str, Any]:
        """Return ``k_needed, r_needed, excess`` for scalar parameters and k*, r*."""
        if not s.sized or any(np.ndim(v) for v in (s.a_T, s.a_S, s.parameters.l_f, s.k, s.r)):
            return {}
        excess = best_excess(s.a_T, s.a_S, s.max_degree, s.k, s.r)
        if excess <= 0:
            return {"excess": excess}
        plan = plan_excess(s, excess, self.tier)
        if plan.pair is None or not plan.guarantee:
            return {"excess": excess}
        return {"excess": excess, "k_needed": plan.pair.k, "r_needed": plan.pair.r}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's, and whether the sharp statement implies this one."""
        implied = "implied by the sharp statement: h(q) grows subexponentially"
        holds = converges_up_to(s.growth, 1.0)
        return (
            replace(_contains(s), masks=False),
            Hypothesis("Delta >= 3", s.max_degree >= 3, s.max_degree - 3, masks=False),
            Hypothesis(implied, holds, masks=False),
        )

    def missing(self, s: Setting) -> dict[str, str]:
        """Name what uncoupled or missing k and r leave out."""
        reasons = {}
        for letter, coupling in (("k", s.a_T), ("r", s.a_S)):
            if not np.any(coupling):
                for name in (f"{letter}_ratio", f"{letter}_ratio_of_rates"):
                    reasons[name] = "nothing is coupled: any value will do"
        why = "no pair is guaranteed to reach it in this tier" if s.sized else "needs k* and r*"
        if any(np.ndim(v) for v in (s.a_T, s.a_S, s.parameters.l_f, s.k, s.r)):
            why = "planned for single parameters, k* and r* only"
        return reasons | dict.fromkeys(("k_needed", "r_needed"), why)


class Repaired(Stated):
    """The repaired rates against the proven lower bound.

    ``k_ratio = 4``; ``r_ratio`` is 4 (8 where h grows like ``rho_S^{-q/4}``) times
    ``log g(2 floor(Delta/2) a_S)/log g(Delta a_S)``.
    """

    tier: ClassVar[Tier] = "repaired"
    conditional = ("r_ratio",)

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the two ratios."""
        one = 1 + 0 * (s.a_T + s.a_S)
        factor = 4 if converges_up_to(s.growth, 1.0) else 8
        values = {"k_ratio": 4 * one}
        if block_size(s.max_degree):
            values["r_ratio"] = factor * ratio_of_blocks(s.a_S, s.max_degree)
        return values

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the growth that the argument allows."""

        def allowed(x: float) -> bool:  # rho_S^(1/4), and no condition where nothing is coupled
            rate = (np.sqrt(x) / (np.sqrt(1 + x) + 1)) ** 0.25
            return x == 0 or converges_up_to(s.growth, float(rate))

        holds = np.vectorize(allowed, otypes=[bool])(approximate(s.x))[()]
        grows = Hypothesis("h(q) = O~(rho_S^{-q/4})", holds if np.ndim(holds) else bool(holds))
        return (grows, _contains(s))


class Sharp(Repaired):
    """``(1, log g(2 floor(Delta/2) a_S)/log g(Delta a_S))``: for even Delta, ``(1, 1)``."""

    tier: ClassVar[Tier] = "sharp"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the two ratios."""
        one = 1 + 0 * (s.a_T + s.a_S)
        values = {"k_ratio": one}
        if block_size(s.max_degree):
            values["r_ratio"] = ratio_of_blocks(s.a_S, s.max_degree)
        return values

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the growth that makes all factors polynomial."""
        holds = converges_up_to(s.growth, 1.0)
        return (Hypothesis("h(q) grows subexponentially", holds), _contains(s))


def _contains(s: Setting) -> Hypothesis:
    text = "the class (degree <= Delta, growth <= h) contains the ring of blocks"
    return Hypothesis(text, contains_ring_of_blocks(s.growth))


BOUNDS: tuple[Bound, ...] = (Stated(), Repaired(), Sharp())
