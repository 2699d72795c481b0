"""``nearsight:lateral-energy``: perturbing the lateral boundary of all agents at once (E2)."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from ..arithmetic import Number, approximate
from ..energy import NEIGHBOURS, NEXT, OWN, Couplings, best_share, float_count, row_bound
from ..formula import plain_floats
from ..hypotheses import ASSUMPTION, CONVEX
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier


class LateralEnergy(Bound):
    """The l2 size of the change of one row, for lateral data off by D at every step.

    ``own`` the agents' present actions, ``next`` their next ones (k >= 3), ``neighbours``
    what they expect of their neighbours (r >= 2); shares of the grid as in
    `bounds.energy`, each by its least coefficient of D.
    """

    label = "nearsight:lateral-energy"
    tier: ClassVar[Tier] = "sharp"
    title = "weighted-energy bound on a lateral perturbation"
    conditional = ("own", "next", "neighbours")

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``eta`` and the coefficients of D of the three rows."""
        if not s.sized:
            return {}
        eta = s.growth.eta(s.r)
        values: dict[str, Number] = {"eta": eta + 0 * s.a_T}
        rows = {"own": (OWN, 2, 1), "next": (NEXT, 3, 1), "neighbours": (NEIGHBOURS, 2, 2)}
        floats = Couplings(*(approximate(v) for v in s.couplings))
        for name, (row, least_k, least_r) in rows.items():
            if np.any(np.less(s.k, least_k)) or np.any(np.less(s.r, least_r)):
                continue
            with plain_floats():
                share = best_share(row, floats, float_count(eta), s.k, s.r)
            bound = row_bound(row, s.couplings, eta, s.k, s.r, share)
            values[name] = bound.D_part
        return values

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the two that the argument uses."""
        return (ASSUMPTION, CONVEX)

    def missing(self, s: Setting) -> dict[str, str]:
        """Name the rows that a short horizon or a small radius does not have."""
        if not s.sized:
            return super().missing(s)
        reasons = {}
        if np.any(np.less(s.k, 3)):
            reasons["next"] = "needs k >= 3"
        if np.any(np.less(s.r, 2)):
            reasons["neighbours"] = "needs r >= 2"
        return reasons


BOUNDS: tuple[Bound, ...] = (LateralEnergy(),)
