"""``nearsight:sharp-cr``: the project's competitive ratio (E5)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from ..arithmetic import Number
from ..certificate import best_shares, cost_gap, excess_ratio, step_error
from ..theorem import ASSUMPTION, Bound, Hypothesis, Setting, Tier
from .coro_cr_lpc import NONNEGATIVE
from .networked_exp_decay import CONVEX


class Variational(Bound):
    """``vi``: any closed convex product constraints, and no dependence on ``l_f``."""

    label = "nearsight:sharp-cr"
    tier: ClassVar[Tier] = "sharp"
    variant = "vi"
    title = "sharp competitive ratio, any constraints, any l_f"
    conditional = ("cr", "cr_minus_one")

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the ratio and the form ``P_0, P_1, P_2`` it comes from."""
        if not s.sized:
            return {}
        c, eta = s.couplings, s.growth.eta(s.r)
        error = step_error(c, eta, s.k, s.r, best_shares(self.variant, c, eta, s.k, s.r))
        gap = cost_gap(self.variant, c, s.k, error)
        excess = excess_ratio(c, gap, error)
        return {"cr": 1 + excess, "cr_minus_one": excess, "eta": eta + 0 * s.a_T, **gap._asdict()}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return what the certificate needs; it closes where the ratio is finite."""
        found = [ASSUMPTION, NONNEGATIVE, self._feasible(s)]
        if s.sized:
            closes = np.isfinite(values["cr_minus_one"])
            text = "the certificate closes: P_2 < 1/2, or the step errors are summable"
            margin = 0.5 - np.asarray(values["P_2"])
            found.append(
                Hypothesis(text, closes[()] if np.ndim(closes) else bool(closes), margin[()])
            )
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
