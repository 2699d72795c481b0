"""``coro:CR-LPC``: the competitive ratio of LPC, with its explicit constants."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from ..arithmetic import Number
from ..constants import Regrouped, whole_bound
from ..global_bound import GlobalBound
from ..hypotheses import ASSUMPTION, CONVEX, NONNEGATIVE, SLATER, global_implied, local_implied
from ..local_bound import LocalBound
from ..ratio import RatioParts, ratio_parts, smoothness
from ..reach import reach
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier, at_least_zero, once
from ..tight import Choice
from .networked_exp_decay_tight import choice_values, chosen, conditions

CONDITIONAL = ("cr", "cr_minus_one", "lateral", "top")


def _masking(found: list[Hypothesis]) -> list[Hypothesis]:
    """Return those without which the constants mean nothing."""
    return [h for h in found if h.masks is True]


def parts(s: Setting, local: LocalBound, whole: GlobalBound) -> RatioParts:
    """Return the parts of ``CR - 1`` at the k and r of the setting."""
    weight = smoothness(s.parameters.condition, s.a_T, s.a_S, s.max_degree)
    return ratio_parts(local, whole, weight, reach(s.growth, local.rho_S, s.r), s.k, s.r)


class Ratio(Bound):
    """Equations (e1) and (e2-0) of the appendix.

    Values: ``cr``, ``cr_minus_one`` and its parts, the ``condition`` (to be at most 1/2),
    and the constants used.
    """

    label = "coro:CR-LPC"
    title = "competitive ratio of LPC"
    conditional: ClassVar[tuple[str, ...]] = CONDITIONAL
    tight: ClassVar[bool] = False

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the ratio, its condition and its constants."""
        whole = whole_bound(self.tier, s.a_T)
        extra: dict[str, Number] = {}
        if self.tight:
            found = chosen(s, self._excess_of(s))
            local, extra = found.local, choice_values(found)
        else:
            local = Regrouped(self.tier)(s).local
        values = {"C_0": whole.C_0, "C_1": local.C_1, "C_G": whole.C_G, **extra}
        values |= {"rho_T": local.rho_T, "rho_S": local.rho_S, "rho_G": whole.rho_G}
        if s.sized:
            p = parts(s, local, whole)
            excess = p.lateral + p.top
            values |= {"cr": 1 + excess, "cr_minus_one": excess, "condition": p.condition}
            values["condition_slack"] = 0.5 - p.condition
            values |= {"lateral": p.lateral, "top": p.top}
            values["C_3"] = reach(s.growth, local.rho_S, s.r).C_3
        return values

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return every hypothesis that the proof uses."""
        stated = self.tier == "stated"
        found = [ASSUMPTION, NONNEGATIVE, SLATER if stated or self.tight else CONVEX]
        if self.tight:
            found += conditions(values)
            found += [global_implied(s)] if stated else []
        elif stated:
            found += [local_implied(s), global_implied(s)]
        if s.sized:
            slack = values["condition_slack"]
            closes = at_least_zero("condition <= 1/2 (e2-0)", slack, masks=CONDITIONAL)
            found.append(once(_masking(found), closes))
        return tuple(found)

    def _excess_of(self, s: Setting) -> Any:
        """Return the objective for ``b_1, b_2``: the ratio itself where k and r are known."""
        if not s.sized or np.ndim(s.k) or np.ndim(s.r):
            return None

        def excess(found: Choice, a_T: float, a_S: float, condition: float) -> Any:
            whole = whole_bound(self.tier, a_T)
            weight = smoothness(condition, a_T, a_S, s.max_degree)
            size = reach(s.growth, found.local.rho_S, s.r)
            p = ratio_parts(found.local, whole, weight, size, s.k, s.r)
            return np.where(p.condition <= 0.5, p.lateral + p.top, np.inf)

        return excess


class Stated(Ratio):
    """With ``thm:networked-exp-decay`` and ``C_G`` as printed."""

    tier: ClassVar[Tier] = "stated"


class Repaired(Ratio):
    """With the repaired local and global bounds: a guarantee."""

    tier: ClassVar[Tier] = "repaired"


class StatedTight(Ratio):
    """With ``thm:networked-exp-decay-tight`` and ``C_G`` as printed."""

    tier: ClassVar[Tier] = "stated"
    variant = "tight"
    tight = True
    conditional = (*CONDITIONAL, "rho_T", "rho_S", "C_1", "C_3", "condition", "condition_slack")


class RepairedTight(StatedTight):
    """With ``thm:networked-exp-decay-tight`` and the repaired ``C_G``: a guarantee."""

    tier: ClassVar[Tier] = "repaired"


BOUNDS: tuple[Bound, ...] = (Stated(), Repaired(), StatedTight(), RepairedTight())
