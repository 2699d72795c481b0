"""``thm:alg-perf-bound-err-inject``: per-step errors do not pile up."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ..arithmetic import Number, power
from ..constants import whole_bound
from ..global_bound import accumulation, accumulation_sharp
from ..hypotheses import ASSUMPTION, CONVEX, SLATER, global_implied
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier


class Stated(Bound):
    """``sum |x_t - x_t*|^2 <= factor sum e_t^2``, ``factor = C_0^2/(1 - rho_G)^2``.

    The proof uses ``thm:global-exp-decay``; ``C_0 = max(1, C_G)`` hides its slip wherever
    ``C_0`` is at least the sharp ``C_G``.
    """

    label = "thm:alg-perf-bound-err-inject"
    tier: ClassVar[Tier] = "stated"
    title = "from per-step errors to the distance from the optimum"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``factor``, ``C_0``, ``rho_G``."""
        whole = whole_bound(self.tier, s.a_T)
        factor = power(accumulation(whole.C_0, whole.one_minus_rho_G), 2)
        return {"factor": factor, "C_0": whole.C_0, "rho_G": whole.rho_G}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's, and whether the sharp global bound implies this one."""
        return (ASSUMPTION, SLATER, global_implied(s))


class Repaired(Stated):
    """The same with the repaired ``C_G``."""

    tier: ClassVar[Tier] = "repaired"

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the two that the argument uses."""
        return (ASSUMPTION, CONVEX)


class Sharp(Repaired):
    """``factor = S^2``, ``S = 1 + s_1/(1 - gamma_T)``."""

    tier: ClassVar[Tier] = "sharp"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``factor`` and ``S``."""
        S = accumulation_sharp(s.a_T)
        return {"factor": power(S, 2), "S": S}


BOUNDS: tuple[Bound, ...] = (Stated(), Repaired(), Sharp())
