"""``coro:resource-augmentation``: how much more LPC must see than the best algorithm."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from ..arithmetic import Number, approximate
from ..hypotheses import CLASS
from ..lower import best_excess, block_size
from ..planner import plan_excess
from ..resource import (
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
        values = dict(self.values(s))
        if not np.all(s.a_T):
            values = {n: _blank(v, s.a_T) if n.startswith("k") else v for n, v in values.items()}
        if not np.all(s.a_S):
            values = {n: _blank(v, s.a_S) if n.startswith("r") else v for n, v in values.items()}
        return values | self.needed(s)

    def needed(self, s: Setting) -> dict[str, Any]:
        """Return ``k_needed, r_needed, excess`` for scalar parameters and k*, r*."""
        if not s.sized or any(np.ndim(v) for v in (s.a_T, s.a_S, s.parameters.l_f, s.k, s.r)):
            return {}
        excess = best_excess(s.a_T, s.a_S, s.max_degree, s.k, s.r)
        if excess <= 0:
            return {"excess": excess}
        pair = plan_excess(s, excess, self.tier).pair
        found = {"k_needed": pair.k, "r_needed": pair.r} if pair else {}
        return {"excess": excess, **found}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's, and whether the sharp statement implies this one."""
        implied = "implied by the sharp statement: Delta >= 2, h(q) grows subexponentially"
        holds = converges_up_to(s.growth, 1.0) and block_size(s.max_degree) > 0
        return (
            CLASS,
            Hypothesis("Delta >= 3", s.max_degree >= 3, s.max_degree - 3, masks=False),
            Hypothesis(implied, holds, masks=False),
        )

    def missing(self, s: Setting) -> dict[str, str]:
        """Name what uncoupled or missing k and r leave out."""
        reasons = {}
        for name, coupling in (("k_ratio", s.a_T), ("r_ratio", s.a_S)):
            if not np.any(coupling):
                reasons[name] = "nothing is coupled: any value will do"
        if not s.sized:
            return reasons | dict.fromkeys(("k_needed", "r_needed"), "needs k* and r*")
        return reasons


def _blank(value: Any, coupling: Any) -> Any:
    return np.where(np.equal(coupling, 0.0), np.nan, value)[()]


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
        return (CLASS, grows, _has_blocks(s))


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
        return (CLASS, Hypothesis("h(q) grows subexponentially", holds), _has_blocks(s))


def _has_blocks(s: Setting) -> Hypothesis:
    return Hypothesis("Delta >= 2: a ring of blocks exists", s.max_degree >= 2, s.max_degree - 2)


BOUNDS: tuple[Bound, ...] = (Stated(), Repaired(), Sharp())
