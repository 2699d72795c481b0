"""``prop:exp-decay-networked-SOCO``: one time step, decisions on any graph."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ..arithmetic import Number, sqrt
from ..decay import demko, gamma_S
from ..formula import formula
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier, at_least_zero, margin_of

COSTS = Hypothesis("node costs mu-strongly convex, edge costs convex and l_S-smooth, all C^2")


@formula(counts=("max_degree",))
def soco_repaired(a_S: Number, max_degree: int) -> Number:
    """Return ``c(1+x) max(sqrt(Delta), 1) l_S/(2 mu)``, exponent ``d - 1``.

    A boundary vertex may touch Delta free ones, so its stacked cross block has norm up
    to ``sqrt(Delta) l/2``, not l; that of a disturbance of one edge has at most ``l/2``.
    """
    widest = sqrt(max(max_degree, 1) * (1 + 0 * a_S))
    return demko(1 + max_degree * a_S) * widest * a_S / 2


class Stated(Bound):
    """As printed: ``C = 2 l/mu``, ``lambda = gamma_S``, exponent ``d - 1``; here ``l = l_S``."""

    label = "prop:exp-decay-networked-SOCO"
    tier: ClassVar[Tier] = "stated"
    title = "perturbation bound on a general graph, exponent d - 1"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``C`` and ``lambda``."""
        return {"C": 2 * s.a_S, "lambda": gamma_S(s.x)}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's, and whether the repaired statement implies this one."""
        margin = margin_of(s, lambda w: 2 * w.a_S - soco_repaired(w.a_S, w.max_degree))
        text = "implied by the repaired statement: C is at least the repaired one"
        return (COSTS, at_least_zero(text, margin, masks=False))


class Repaired(Bound):
    """The same with the norm of the stacked cross block."""

    label = "prop:exp-decay-networked-SOCO"
    tier: ClassVar[Tier] = "repaired"
    title = Stated.title

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``C`` and ``lambda``."""
        return {"C": soco_repaired(s.a_S, s.max_degree), "lambda": gamma_S(s.x)}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's."""
        return (COSTS,)


BOUNDS: tuple[Bound, ...] = (Stated(), Repaired())
