"""Hypotheses that several theorems share, and what makes a printed constant a proved one."""

from __future__ import annotations

from .arithmetic import Number, maximum
from .global_bound import global_sharp, global_stated
from .local_bound import local_repaired, local_stated
from .setting import Setting
from .theorem import Hypothesis, at_least_zero, margin_of

ASSUMPTION = Hypothesis("the costs obey Assumption 2.1 with the given mu, l_f, l_T, l_S")
SLATER = Hypothesis("feasible sets: all of R^n, or each with a Slater point for the barrier")
CONVEX = Hypothesis("feasible sets: closed, convex, one for each agent and step")
NONNEGATIVE = Hypothesis("all costs are convex, smooth and >= 0 on the whole space")
CLASS = Hypothesis(
    "over the class of all networks of degree at most Delta and all horizons, not for this network"
)


def local_implied(s: Setting) -> Hypothesis:
    """Say whether the printed ``C_1 = C_2`` is at least both of the repaired constants.

    The rates are the same, so the printed ``thm:networked-exp-decay`` then follows.
    """

    def advantage(w: Setting) -> Number:
        proved = local_repaired(w.a_T, w.a_S, w.max_degree)
        return local_stated(w.a_T, w.a_S, w.max_degree).C_1 - maximum(proved.C_1, proved.C_2)

    text = "C_1 is at least the repaired C_1 and C_2 (thm:networked-exp-decay)"
    return at_least_zero(text, margin_of(s, advantage), masks=False)


def global_implied(s: Setting) -> Hypothesis:
    """Say whether the printed ``C_0`` is at least the sharp ``C_G``, which is all proofs use."""
    text = "C_0 is at least the sharp C_G (thm:global-exp-decay)"
    margin = margin_of(s, lambda w: global_stated(w.a_T).C_0 - global_sharp(w.a_T).C_G)
    return at_least_zero(text, margin, masks=False)
