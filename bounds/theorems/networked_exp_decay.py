"""``thm:networked-exp-decay``: the local perturbation bound with separate rates."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

from ..arithmetic import Number
from ..decay import gamma_S, gamma_T
from ..hypotheses import ASSUMPTION, CONVEX, SLATER, local_implied
from ..local_bound import LocalBound, local_repaired, local_stated
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier


def _values(local: LocalBound, s: Setting) -> dict[str, Number]:
    return local._asdict() | {"gamma_T": gamma_T(s.a_T), "gamma_S": gamma_S(s.x)}


class Stated(Bound):
    """As printed: ``C_1 = C_2 = 2 sqrt(Delta l_S l_T)/mu``.

    False for weak couplings: as ``l_S -> 0`` the constant vanishes and the sensitivity
    to a top or bottom variable above the vertex itself does not. True where the repaired
    constants are no larger, which is what decides the guarantee.
    """

    label = "thm:networked-exp-decay"
    tier: ClassVar[Tier] = "stated"
    title = "local perturbation bound, rates rho_T and rho_S"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``C_1, C_2, rho_T, rho_S`` and the gammas."""
        return _values(local_stated(s.a_T, s.a_S, s.max_degree), s)

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's, and whether the repaired statement implies this one."""
        return (ASSUMPTION, SLATER, local_implied(s))


class Repaired(Stated):
    """The same argument, its slips mended; see `bounds.local_bound.local_repaired`.

    Constraints enter through a smooth penalty of the distance to the feasible set
    (the Moreau envelope of its indicator) in place of the barrier: the constants do not
    depend on ``l_f``, so they survive the limit, and no Slater point is needed.
    """

    tier: ClassVar[Tier] = "repaired"

    def values(self, s: Setting) -> dict[str, Number]:
        """Return ``C_1, C_2, rho_T, rho_S`` and the gammas."""
        return _values(local_repaired(s.a_T, s.a_S, s.max_degree), s)

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the two that the argument uses."""
        return (ASSUMPTION, CONVEX)


BOUNDS: tuple[Bound, ...] = (Stated(), Repaired())
