"""``lemma:spatial-upper-and-lower``: its three cases, line by line."""

from __future__ import annotations

from fractions import Fraction as Q

from ..claim import Claim
from ..engines.decision import Decision
from .printed_rates import SPATIAL

CLAIMS: tuple[Claim, ...] = (
    Claim(
        SPATIAL,
        "the first lines of case 1",
        "rho_S^16 = (1 - 2/(s+1))^8 <= 1 - 8/(s+1) <= 1 - 4 sqrt(3)/sqrt(x) for x >= 224",
        "s = sqrt(1+x) >= 15",
        (
            Decision(
                ("p",),
                lambda p: ([p >= 0, 8 * p <= 1], (1 - p) ** 8, 1 - 4 * p),
                "p = 2/(s+1) <= 1/8",
                false=(lambda p: ([p >= 0, 8 * p <= 1], (1 - p) ** 8, 1 - 6 * p),),
            ),
            Decision(
                ("s",),
                lambda s: ([s >= 15], 48 * (s + 1) ** 2, 64 * (s * s - 1)),
                "4 sqrt(3)/sqrt(x) <= 8/(s+1), squared, x = s^2 - 1",
                false=(lambda s: ([s >= 6], 48 * (s + 1) ** 2, 64 * (s * s - 1)),),
            ),
        ),
        part="case 1 lines",
        kind="step",
        uses=(f"{SPATIAL}:e1",),
    ),
    Claim(
        SPATIAL,
        "case 2",
        "rho_S^28 <= (7/8)^14 <= 1/6 <= lambda_S for 1 <= x < 224",
        "s = sqrt(1+x) < 15",
        (
            Decision(
                ("s",),
                lambda s: ([s >= 1, s < 15], 8 * (s - 1), 7 * (s + 1)),
                "rho_S^2 = (s-1)/(s+1) <= 7/8",
                false=(lambda s: ([s >= 1, s < 16], 8 * (s - 1), 7 * (s + 1)),),
            ),
            Decision(
                ("x",),
                lambda x: ([x >= 1], 3 + 3 * x, 6 * x),
                "x/(3+3x) >= 1/6",
                false=(lambda x: ([2 * x >= 1], 3 + 3 * x, 6 * x),),
            ),
            Decision(
                ("one",),
                lambda one: ([one == 1], 6 * Q(7, 8) ** 14 * one, one),
                "6 (7/8)^14 = 0.925",
                false=(lambda one: ([one == 1], 6 * Q(7, 8) ** 13 * one, one),),
            ),
        ),
        part="case 2",
        kind="step",
    ),
    Claim(
        SPATIAL,
        "case 3",
        "rho_S^2 <= sqrt(x)/4 and rho_S^4 <= x/16 <= x/(3+3x) for x < 1",
        "s = sqrt(1+x)",
        (
            Decision(
                ("x",),
                lambda x, s: ([x >= 0, x < 1], 16 * (s - 1) ** 2, x * (s + 1) ** 2),
                "both squared",
                roots={"s": lambda x: 1 + x},
                false=(lambda x, s: ([x >= 0, x < 1], 36 * (s - 1) ** 2, x * (s + 1) ** 2),),
            ),
            Decision(
                ("x",),
                lambda x: ([x >= 0, x < 1], x * (3 + 3 * x), 16 * x),
                "times 16 (3 + 3x)",
                false=(lambda x: ([x >= 0, x < 5], x * (3 + 3 * x), 16 * x),),
            ),
        ),
        part="case 3",
        kind="step",
    ),
)
