"""``nearsight:ring-of-blocks``: the spatial lower bound, one step, any policy."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ..arithmetic import Number
from ..hypotheses import CLASS
from ..lower import block_size, lambda_S_proven, spatial_excess
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Kind, Tier


class RingOfBlocks(Bound):
    """The team-optimal policy of radius r on the infinite ring of blocks.

    Blocks of ``floor(Delta/2)`` vertices; see `bounds.lower.spatial_excess`.
    """

    label = "nearsight:ring-of-blocks"
    tier: ClassVar[Tier] = "sharp"
    kind: ClassVar[Kind] = "lower"
    variant = "over the class"
    title = "lower bound in r, ring of blocks"
    conditional = ("cr", "cr_minus_one")

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the rate and, for a given r, the bound."""
        d = block_size(s.max_degree)
        if not d:
            return {}
        values: dict[str, Number] = {"lambda_S": lambda_S_proven(s.a_S, s.max_degree)}
        if s.r is not None:
            excess = spatial_excess(s.a_S, d, s.r)
            values |= {"cr": 1 + excess, "cr_minus_one": excess}
        return values

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the class the supremum runs over."""
        return (CLASS,)

    def missing(self, s: Setting) -> dict[str, str]:
        """Name what a network without a ring of blocks, or no r, leaves out."""
        if not block_size(s.max_degree):
            reason = "no ring of blocks has a degree below 2"
            return dict.fromkeys(("lambda_S", *self.conditional), reason)
        return {} if s.r is not None else dict.fromkeys(self.conditional, "needs a radius r")


BOUNDS: tuple[Bound, ...] = (RingOfBlocks(),)
