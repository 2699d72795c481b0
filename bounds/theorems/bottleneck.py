"""``thm:bottleneck``: what no decentralised online algorithm beats."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ..arithmetic import Number, power
from ..decay import gamma_T
from ..hypotheses import CLASS
from ..lower import best_excess, block_size, lambda_S_proven, lambda_S_stated, lambda_T_stated
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Kind, Tier, at_least_zero, margin_of


class Stated(Bound):
    """``1 + Omega(lambda_T^k) + Omega(lambda_S^r)`` with the printed rates.

    LPC itself attains ``gamma_T^{2k}`` and, on networks of subexponential growth,
    ``gamma_S^{2r}`` up to polynomial factors: where a printed rate is larger, the
    statement is false. The printed ``lambda_T = g(4a)^2`` always is (its instance is
    ``2 l_T``-smooth), ``lambda_S`` is for weak couplings (an entry of the inverse is not
    squared).
    """

    label = "thm:bottleneck"
    tier: ClassVar[Tier] = "stated"
    kind: ClassVar[Kind] = "lower"
    title = "rates that no algorithm beats"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``lambda_T`` and ``lambda_S``."""
        return {"lambda_T": lambda_T_stated(s.a_T), "lambda_S": lambda_S_stated(s.x)}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's, and whether the rates stay below those that LPC attains."""
        temporal = margin_of(s, lambda w: power(gamma_T(w.a_T), 2) - lambda_T_stated(w.a_T))
        spatial = margin_of(
            s, lambda w: lambda_S_proven(w.a_S, w.max_degree) - lambda_S_stated(w.x)
        )
        return (
            CLASS,
            at_least_zero("Delta >= 3", s.max_degree - 3, masks=False),
            at_least_zero("lambda_T <= gamma_T^2, the rate LPC attains", temporal, masks=False),
            at_least_zero("lambda_S <= the proven rate", spatial, masks=False),
        )


class Repaired(Stated):
    """``lambda_T = gamma_T^2``, ``lambda_S = g(2 floor(Delta/2) l_S/mu)^2``.

    The same two constructions, counted with the smoothness of the class and squared;
    explicit constants in `bounds.lower`. With k and r given, ``cr`` is the larger of the
    two bounds (not their sum).
    """

    tier: ClassVar[Tier] = "repaired"
    variant = "over the class"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the rates and, for given k and r, the bound."""
        values: dict[str, Number] = {"lambda_T": power(gamma_T(s.a_T), 2)}
        if block_size(s.max_degree):
            values["lambda_S"] = lambda_S_proven(s.a_S, s.max_degree)
        if s.sized:
            excess = best_excess(s.a_T, s.a_S, s.max_degree, s.k, s.r)
            values |= {"cr": 1 + excess, "cr_minus_one": excess}
        return values

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the class the supremum runs over."""
        return (CLASS,)

    def missing(self, s: Setting) -> dict[str, str]:
        """Name what a network without a ring of blocks, or no k and r, leaves out."""
        reasons = {} if s.sized else dict.fromkeys(("cr", "cr_minus_one"), "needs k and r")
        if not block_size(s.max_degree):
            reasons["lambda_S"] = "no ring of blocks has a degree below 2"
        return reasons


BOUNDS: tuple[Bound, ...] = (Stated(), Repaired())
