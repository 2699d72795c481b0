"""``thm:per-step-err``: how far one step of LPC is from the clairvoyant step."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ..arithmetic import Number
from ..certificate import best_shares, step_error
from ..constants import Regrouped
from ..hypotheses import ASSUMPTION, CONVEX, SLATER, global_implied, local_implied
from ..ratio import per_step
from ..reach import reach
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier


class Stated(Bound):
    """The three coefficients of the appendix, with ``thm:networked-exp-decay``.

    ``e_t^2 <= history |x_{t-1} - x*_{t-1}|^2 + (lateral sum rho_T^{tau-t} f_tau +
    top f_{t+k-1})/mu``.
    """

    label = "thm:per-step-err"
    tier: ClassVar[Tier] = "stated"
    title = "error of one step of LPC"
    conditional: ClassVar[tuple[str, ...]] = ("history", "lateral", "top")

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the coefficients and ``C_3(r)``."""
        if not s.sized:
            return {}
        local, whole, _ = Regrouped(self.tier)(s)
        size = reach(s.growth, local.rho_S, s.r)
        return per_step(local, whole, size, s.k, s.r)._asdict() | {"C_3": size.C_3}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's, and whether the repaired statement implies this one."""
        return (ASSUMPTION, SLATER, local_implied(s), global_implied(s))


class Repaired(Stated):
    """The same proof with the repaired local and global bounds."""

    tier: ClassVar[Tier] = "repaired"

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the two that the argument uses."""
        return (ASSUMPTION, CONVEX)


class Sharp(Repaired):
    """(E3): ``|e| <= E_D D + E_y y`` in l2 over time, ``D = |x* - theta|, y = |x - x*|``."""

    tier: ClassVar[Tier] = "sharp"
    conditional = ("E_D", "E_y")

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the two coefficients, and their parts due to the top and the sides."""
        if not s.sized:
            return {}
        eta = s.growth.eta(s.r)
        e = step_error(
            s.couplings, eta, s.k, s.r, best_shares("smooth", s.couplings, eta, s.k, s.r)
        )
        total = e.E_top.plus(e.E_lat)
        parts = {"top_D": e.E_top.D, "top_y": e.E_top.y, "lateral_D": e.E_lat.D}
        return {"E_D": total.D, "E_y": total.y, **parts, "lateral_y": e.E_lat.y}


BOUNDS: tuple[Bound, ...] = (Stated(), Repaired(), Sharp())
