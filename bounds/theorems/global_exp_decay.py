"""``thm:global-exp-decay``: how a perturbed time slice decays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from ..arithmetic import Number, is_zero, select
from ..decay import slice_decay
from ..global_bound import GlobalBound, global_repaired, global_sharp, global_stated
from ..hypotheses import ASSUMPTION, CONVEX, SLATER
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier, at_least_zero, margin_of


def _values(whole: GlobalBound) -> dict[str, Number]:
    return {**whole._asdict(), "gamma_T": whole.rho_G}


def _advantage(s: Setting) -> Number:
    """By how much the stated constant exceeds the sharp one; 0 where nothing is coupled."""
    margin = global_stated(s.a_T).C_G - global_sharp(s.a_T).C_G
    return select(is_zero(s.a_T), 0 * margin, margin)


class Stated(Bound):
    """As printed, ``C_G = 2 l_T/mu``: the exponent should be one less.

    The sharp constant is the least true one, so the printed statement holds exactly
    where ``2 a >= a/(2 gamma_T sqrt(1+a))``, that is for ``l_T/mu`` above a threshold.
    """

    label = "thm:global-exp-decay"
    tier: ClassVar[Tier] = "stated"
    title = "global perturbation bound, rate rho_G"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``C_G, C_0, rho_G``."""
        return _values(global_stated(s.a_T))

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's, and whether the sharp statement implies this one."""
        text = "C_G is at least the sharp constant (or l_T = 0)"
        return (ASSUMPTION, SLATER, at_least_zero(text, margin_of(s, _advantage), masks=False))


class Repaired(Bound):
    """The printed argument with the exponent ``d - 1``, cross blocks of norm ``l_T/2``."""

    label = "thm:global-exp-decay"
    tier: ClassVar[Tier] = "repaired"
    title = Stated.title

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``C_G, C_0, rho_G``."""
        return _values(global_repaired(s.a_T))

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the two that the argument uses."""
        return (ASSUMPTION, CONVEX)


class Sharp(Repaired):
    """(E1): ``s_d = C_G rho_G^d`` for ``d >= 1``; cannot be improved over the class.

    With a horizon k given, ``s_k`` and ``s_{k-1}`` are listed as well.
    """

    tier: ClassVar[Tier] = "sharp"
    kind = "exact"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``C_G, C_0, rho_G``, and ``s_k, s_{k-1}`` where k is given."""
        values = _values(global_sharp(s.a_T))
        if s.k is not None:
            values["s_k"] = slice_decay(s.a_T, s.k)
            values["s_k_minus_1"] = slice_decay(s.a_T, np.asarray(s.k) - 1)
        return values


BOUNDS: tuple[Bound, ...] = (Stated(), Repaired(), Sharp())
