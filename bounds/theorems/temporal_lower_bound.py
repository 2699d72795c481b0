"""``nearsight:temporal-lower-bound``: one agent with k steps of look-ahead."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ..arithmetic import Number, power
from ..decay import gamma_T
from ..hypotheses import CLASS
from ..lower import final_excess, temporal_excess
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Kind, Tier


class LongRun(Bound):
    """``CR >= 1 + gamma_T^{2k}/(sqrt(1+2a) - 1)``.

    The value of the best policy for independent targets over a long horizon; see
    `bounds.lower.temporal_excess`.
    """

    label = "nearsight:temporal-lower-bound"
    tier: ClassVar[Tier] = "sharp"
    kind: ClassVar[Kind] = "lower"
    variant = "over the class"
    title = "lower bound in k, one agent, independent targets"
    conditional = ("cr", "cr_minus_one")

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the rate and, for a given k, the bound."""
        values: dict[str, Number] = {"lambda_T": power(gamma_T(s.a_T), 2)}
        if s.k is not None:
            excess = self.excess(s)
            values |= {"cr": 1 + excess, "cr_minus_one": excess}
        return values

    def excess(self, s: Setting) -> Number:
        """Return the bound on ``CR - 1``."""
        return temporal_excess(s.a_T, s.k)

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the class the supremum runs over."""
        return (CLASS,)

    def missing(self, s: Setting) -> dict[str, str]:
        """Return the reason where k is not given."""
        return {} if s.k is not None else dict.fromkeys(self.conditional, "needs a horizon k")


class LastTarget(LongRun):
    """Two to four times larger: only the last target is random.

    See `bounds.lower.final_excess`.
    """

    variant = "over the class, last target"
    title = "lower bound in k, one agent, one random target"

    def excess(self, s: Setting) -> Number:
        """Return the bound on ``CR - 1``."""
        return final_excess(s.a_T, s.k)


BOUNDS: tuple[Bound, ...] = (LongRun(), LastTarget())
