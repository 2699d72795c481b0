"""The two lemmas behind ``coro:resource-augmentation`` on the printed rates."""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction as Q
from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.interval import Boxes
from ..engines.symbolic import Identity

TEMPORAL = "lemma:temporal-upper-and-lower"
SPATIAL = "lemma:spatial-upper-and-lower"
ROOTS: dict[str, Callable[..., Any]] = {"s": lambda a: 1 + 2 * a, "w": lambda a, s: 1 + 4 * a}


def _difference() -> tuple[Any, Any]:
    """``lambda_T - rho_T^2`` and what is printed for it, on ``w^2 = 2 s^2 - 1``."""
    import sympy

    m = sympy.Symbol("m", positive=True)
    t = (4 - 2 * m) / (m**2 - 2)
    s, w = 1 + t, 1 + m * t
    left = ((w - 1) / (w + 1)) ** 2 - (s - 1) / (s + 1)
    return left, 4 * s * (s - w) / ((s + 1) * (w + 1) ** 2)


def _weak(x: Any) -> Any:
    """``lambda_S/x - rho_S^32/x`` on balls, with the first branch of lambda_S."""
    return 1 / (3 + 3 * x) - x**15 / ((1 + x).sqrt() + 1) ** 32


def _strong(v: Any) -> Any:
    """``(1 - w^16)/v - 4 sqrt(3)``, ``(1 - w)/v = 2/(1 + v + sqrt(1+v^2))``."""
    from flint import arb

    root = (1 + v * v).sqrt()
    w = root - v
    powers = sum((w**i for i in range(1, 16)), 1 + 0 * w)
    return 2 * powers / (1 + v + root) - 4 * arb(3).sqrt()


CLAIMS: tuple[Claim, ...] = (
    Claim(
        TEMPORAL,
        "the printed rates in time",
        "rho_T^4 <= lambda_T <= rho_T^2",
        "rho_T^2 = g(2a), lambda_T = g(4a)^2, a = l_T/mu > 0",
        (
            Decision(
                ("a",),
                lambda a, s, w: ([a >= 0], (s - 1) * (w + 1), (w - 1) * (s + 1)),
                "rho_T^4 = g(2a)^2 <= g(4a)^2: s = sqrt(1+2a), w = sqrt(1+4a)",
                roots=ROOTS,
                false=(lambda a, s, w: ([a >= 0], (w - 1) * (s + 1), (s - 1) * (w + 1)),),
            ),
            Decision(
                ("a",),
                lambda a, s, w: ([a >= 0], (w - 1) ** 2 * (s + 1), (s - 1) * (w + 1) ** 2),
                "lambda_T = ((w-1)/(w+1))^2 <= (s-1)/(s+1) = rho_T^2",
                roots=ROOTS,
                false=(
                    lambda a, s, w: (
                        [a >= 0],
                        (w - 1) ** 2 * (s + 1) ** 2,
                        (s - 1) ** 2 * (w + 1) ** 2,
                    ),
                ),
            ),
        ),
        kind="lemma",
        uses=(f"{TEMPORAL}[difference]",),
    ),
    Claim(
        TEMPORAL,
        "the difference",
        "lambda_T - rho_T^2 = 4 s (s - w)/((s+1)(w+1)^2), s = sqrt(1+2a), w = sqrt(1+4a)",
        "",
        (
            Identity(
                _difference,
                "the curve w^2 = 2 s^2 - 1 by the lines through (1, 1): s = 1 + t, w = 1 + m "
                "t, t = "
                "(4-2m)/(m^2-2)",
            ),
        ),
        part="difference",
        kind="step",
    ),
    Claim(
        SPATIAL,
        "the printed rates in space",
        "rho_S^32 <= lambda_S",
        "rho_S^2 = g(x); lambda_S = x/(3+3x), from x = 48 on at least (1 - 4 sqrt(3)/sqrt(x))^2; "
        "three cases: x < 1, 1 <= x < 224, x >= 224",
        (
            Decision(
                ("x",),
                lambda x, s: ([x >= 0, x < 1], (s - 1) ** 2 * (3 + 3 * x), x * (s + 1) ** 2),
                "x < 1: rho_S^4 = g(x)^2 <= x/(3+3x), s = sqrt(1+x)",
                roots={"s": lambda x: 1 + x},
                false=(lambda x, s: ([x >= 0, x < 1], (s - 1) * (3 + 3 * x), x * (s + 1)),),
            ),
            Decision(
                ("x", "rate"),
                lambda x, rate: ([x >= 1, x < 224, 8 * rate <= 7], Q(7**14) * 6, Q(8**14)),
                "1 <= x < 224: rho_S^2 <= 7/8, rho_S^28 <= (7/8)^14 <= 1/6 <= x/(3+3x)",
                false=(lambda x, rate: ([x >= 1, x < 224], Q(7**13) * 6, Q(8**13)),),
            ),
            Decision(
                ("s",),
                lambda s: ([s >= 15], 48 * (s + 1) ** 2, 64 * (s * s - 1)),
                "x >= 224: rho_S^16 = (1-p)^8 <= 1 - 4p, p = 2/(s+1) <= 1/8, s = sqrt(1+x), "
                "and 1 - "
                "4p <= 1 - q, q = 4 sqrt(3)/sqrt(x), by q^2 <= 16 p^2; so rho_S^32 <= (1-q)^2",
                false=(lambda s: ([s >= 15], 60 * (s + 1) ** 2, 64 * (s * s - 1)),),
            ),
            Boxes(
                _weak,
                {"x": (0, 224)},
                "again, without cases: rho_S^32/x = x^15/(sqrt(1+x) + 1)^32 < 1/(3+3x) for x <= "
                "224",
                nudge=Q(1, 800),
            ),
            Boxes(
                _strong,
                {"v": (0, Q(1, 14))},
                "and rho_S^16 = w^16 < 1 - 4 sqrt(3) v for x >= 196, v = 1/sqrt(x), w = sqrt(1+"
                "v^2) - v; 1 - w^16 = (1 - w)(1 + w + .. + w^15) divided by v",
                nudge=3,
            ),
        ),
        kind="lemma",
        uses=(f"{SPATIAL}:e1",),
    ),
    Claim(
        f"{SPATIAL}:e1",
        "a power below its chord",
        "(1-x)^{2n} <= 1 - n x for 0 <= x <= 1/(2n); used with n = 4",
        "n a positive integer: g(x) = (1-x)^{2n} + n x - 1 is convex, g(0) = 0, and at the "
        "other end "
        "g <= e^{-1} - 1/2",
        (
            Decision(
                ("x",),
                lambda x: ([x >= 0, 8 * x <= 1], (1 - x) ** 8, 1 - 4 * x),
                "n = 4",
                false=(lambda x: ([x >= 0, 8 * x <= 1], (1 - x) ** 8, 1 - 6 * x),),
            ),
            Decision(
                ("share", "end"),
                lambda share, end: (
                    [share >= 0, share <= 1, end <= Q(37, 100)],
                    share * (end - Q(1, 2)),
                    0,
                ),
                "any n: on a share of the way to 1/(2n) a convex g is at most that share of "
                "its end, "
                "(1 - 1/(2n))^{2n} - 1/2 with (1 - 1/(2n))^{2n} <= e^{-1} < 0.37",
                false=(
                    lambda share, end: (
                        [share >= 0, share <= 1, end <= 1],
                        share * (end - Q(1, 2)),
                        0,
                    ),
                ),
            ),
        ),
        kind="step",
    ),
    Claim(
        SPATIAL,
        "the last line of case 1",
        "1 - 4 sqrt(3)/sqrt(x) = sqrt(lambda_S) for x >= 224",
        "lambda_S = max(x/(3+3x), (1 - 4 sqrt(3)/sqrt(x))^2)",
        (
            Counterexample(
                lambda: (Q(243, 3 + 3 * 243), (1 - Q(4, 9)) ** 2),
                {"x": 243},
                "x = 243: 4 sqrt(3)/sqrt(243) = 4/9, (5/9)^2 = 25/81 = 0.309, but x/(3+3x) = "
                "81/244 = "
                "0.332 is the larger one, up to x = 268",
            ),
        ),
        part="case 1",
        kind="step",
        repaired=f"with <=, which is what is used: {SPATIAL}[case 1 lines]",
    ),
)
