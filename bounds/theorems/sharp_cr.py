"""``nearsight:sharp-cr``: the project's competitive ratio (E5)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ..arithmetic import Number, maximum
from ..certificate import best_shares, closing, cost_gap, excess_ratio, step_error
from ..hypotheses import ASSUMPTION, CONVEX, NONNEGATIVE
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier, above_zero


class Variational(Bound):
    """``vi``: any closed convex product constraints, and no dependence on ``l_f``."""

    label = "nearsight:sharp-cr"
    tier: ClassVar[Tier] = "sharp"
    variant = "vi"
    title = "sharp competitive ratio, any constraints, any l_f"
    conditional = ("cr", "cr_minus_one")

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the ratio, the form ``P_0, P_1, P_2`` it comes from, and its margin."""
        if not s.sized:
            return {}
        c, eta = s.couplings, s.growth.eta(s.r)
        error = step_error(c, eta, s.k, s.r, best_shares(self.variant, c, eta, s.k, s.r))
        gap = cost_gap(self.variant, c, s.k, error)
        excess = excess_ratio(c, gap, error)
        values = {"cr": 1 + excess, "cr_minus_one": excess, "eta": eta + 0 * s.a_T}
        return values | gap._asdict() | {"closing": maximum(*closing(c, gap, error))}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return what the certificate needs; it closes where ``closing > 0``."""
        found = [ASSUMPTION, NONNEGATIVE, self._feasible(s)]
        if s.sized:
            text = "the certificate closes: P_2 < 1/2, or S E_y < 1"
            found.append(above_zero(text, values["closing"]))
        return tuple(found)

    def _feasible(self, s: Setting) -> Hypothesis:
        return CONVEX


class Smooth(Variational):
    """``smooth``: unconstrained, from the smoothness of the total cost."""

    variant = "smooth"
    title = "sharp competitive ratio, unconstrained, by smoothness"

    def _feasible(self, s: Setting) -> Hypothesis:
        return Hypothesis("every feasible set is all of R^n", s.unconstrained)


class Mix(Smooth):
    """``mix``: unconstrained, smoothness for the lateral part of the error only."""

    variant = "mix"
    title = "sharp competitive ratio, unconstrained, mixed"


BOUNDS: tuple[Bound, ...] = (Variational(), Mix(), Smooth())
