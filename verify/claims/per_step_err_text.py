"""``thm:per-step-err``: what the O(.) of its statement hides."""

from __future__ import annotations

from fractions import Fraction as Q

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample

LEMMA = "thm:per-step-err"


def hidden() -> tuple[Q, Q]:
    """Return ``C_1^2/rho_T^2`` at least, for rho_T = 1/64 and C_1 >= 1/2, and 1000."""
    rho_T, C_1 = Q(1, 64), Q(1, 2)
    return (C_1 / rho_T) ** 2, Q(1000)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LEMMA,
        "factors that the O(.) hides, printed constants",
        "C_1^2 rho_T^{2(k-1)} <= 8 x (1+a) rho_T^{2k}: O(C_3(r)^2 rho_T^{2k}) hides factors "
        "polynomial in a = l_T/mu and x = Delta l_S/mu",
        "C_1 = 2 sqrt(x a), rho_T^2 = g(2a) of thm:networked-exp-decay",
        (
            Decision(
                ("a",),
                lambda a, s: ([a >= 0], (1 + s) ** 2, 4 * (1 + a)),
                "C_1^2/rho_T^2 = 4 x a/g(2a) = 2 x (1+s)^2, s = sqrt(1+2a)",
                roots={"s": lambda a: 1 + 2 * a},
                false=(lambda a, s: ([a >= 0], (1 + s) ** 2, 3 * (1 + a)),),
            ),
        ),
        part="O",
        kind="remark",
    ),
    Claim(
        LEMMA,
        "factors that the O(.) hides, constants of the tight bound",
        "C_1^2 rho_T^{2(k-1)} <= p(l_T/mu, Delta l_S/mu) rho_T^{2k} with a polynomial p",
        "C_1 = max{a^2/(2 a~ (1 - rho_T)), ..}, rho_T = 4 a~ l_T/mu of "
        "thm:networked-exp-decay-tight, b_1 and b_2 of the text",
        (
            Counterexample(
                hidden,
                {"rho_T": Q(1, 64), "largest value of p": 1000},
                "a = a~ >= 1 for b_1 = 2 Delta - 1, b_2 = 4 Delta^2 - 2 Delta, so that C_1 >= a/2 "
                ">= 1/2, which does not vanish with l_T: C_1^2/rho_T^2 >= 1024 at rho_T = 1/64, "
                "and it is unbounded as l_T -> 0, where p is not",
            ),
        ),
        part="O, tight",
        kind="remark",
        repaired="rho_T^{2(k-1)}, as the appendix has it: thm:per-step-err:e3",
    ),
)
