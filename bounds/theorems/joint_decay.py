"""``nearsight:joint-decay``: entry by entry, the rates gamma_T and gamma_S (J)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from ..arithmetic import Number, approximate
from ..decay import gamma_S, gamma_T
from ..hypotheses import ASSUMPTION, CONVEX
from ..joint import best_tilt, lateral_bound, top_bound
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier


class JointDecay(Bound):
    """Sensitivity of an agent's own action to one variable of its boundary.

    ``top``: the variable ``k-1`` steps ahead at the agent itself; ``lateral``: one at the
    present step, ``r`` hops away. The rates are the best for each distance.
    """

    label = "nearsight:joint-decay"
    tier: ClassVar[Tier] = "sharp"
    title = "joint decay in time and space, entry by entry"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``gamma_T, gamma_S`` and, for given k and r, ``top`` and ``lateral``."""
        values: dict[str, Number] = {"gamma_T": gamma_T(s.a_T), "gamma_S": gamma_S(s.x)}
        a_T, x = (approximate(v) for v in (s.a_T, s.x))
        if s.k is not None:
            steps = np.asarray(s.k) - 1
            tilt = best_tilt(a_T, x, steps - 1, 0)
            values["top"] = top_bound(s.a_T, s.x, steps, 0, *tilt)
        if s.r is not None:
            tilt = best_tilt(a_T, x, 0, np.asarray(s.r) - 1)
            values["lateral"] = lateral_bound(s.a_T, s.a_S, s.max_degree, 0, s.r, *tilt)
        return values

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the two that the argument uses."""
        return (ASSUMPTION, CONVEX)


BOUNDS: tuple[Bound, ...] = (JointDecay(),)
