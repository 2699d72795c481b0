"""Two agents and one step, in fractions: the smallest network on which LPC is not optimal."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction


@dataclass(frozen=True)
class TwoAgents:
    """``(x_1 - 1)^2/2 + (x_2 + 1)^2/2 + b (x_1 - x_2)^2``, H = 1, nothing coupled in time.

    mu = l_f = 1, Delta = 1, ``l_S = 4 b``. With ``r = 1`` and ``k >= 2`` an agent's own action is
    free and the other's is fixed at its target, so that it plays ``+-(1 - 2b)/(1 + 2b)``; the
    optimum is ``+-1/(1 + 4b)``. With ``r = 0`` or ``k = 1`` LPC plays the targets.

    Parameters
    ----------
    b : Fraction
        Strength of the coupling, >= 0.
    """

    b: Fraction

    @property
    def lpc(self) -> Fraction:
        """The first agent's action; the second's is its negative."""
        return (1 - 2 * self.b) / (1 + 2 * self.b)

    @property
    def optimum(self) -> Fraction:
        """The first agent's optimal action."""
        return 1 / (1 + 4 * self.b)

    def cost(self, x: Fraction) -> Fraction:
        """Return the cost of the actions (x, -x)."""
        return (x - 1) ** 2 + 4 * self.b * x**2

    @property
    def error(self) -> Fraction:
        """``e_1^2 = |x_1 - x_1*|^2`` over both agents."""
        return 2 * (self.lpc - self.optimum) ** 2

    @property
    def ratio(self) -> Fraction:
        """``cost(LPC)/cost(OPT)``."""
        return self.cost(self.lpc) / self.cost(self.optimum)


def coupling_of(rate: Fraction) -> Fraction:
    """Return y with ``g(y) = (sqrt(1+y) - 1)/(sqrt(1+y) + 1) = rate``: ``4 rate/(1-rate)^2``."""
    return 4 * rate / (1 - rate) ** 2
