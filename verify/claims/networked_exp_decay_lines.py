"""``thm:networked-exp-decay:e3``, ``e4``: both regroupings put together."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.symbolic import Identity
from .networked_exp_decay import CLASS, LABEL, WEAK_SPACE, WINDOW, gamma, smallest
from .networked_exp_decay_columns import printed_rate


def _constant() -> tuple[Any, Any]:
    import sympy

    p, q, mu = sympy.symbols("p q mu", positive=True)
    return (2 * p**2 / mu) * (2 * q**2 / mu), (2 * p * q / mu) ** 2


CLAIMS: tuple[Claim, ...] = (
    Claim(
        f"{LABEL}:e3",
        "a minimum is below the geometric mean",
        "min{p, q} <= sqrt(p q) for p, q >= 0.",
        "p, q >= 0",
        (
            Decision(
                ("p", "q", "m"),
                lambda p, q, m: ([p >= 0, q >= 0, m >= 0, m <= p, m <= q], m * m, p * q),
                "m = min{p, q} satisfies m <= p and m <= q; squares are compared",
                false=(lambda p, q, m: ([p >= 0, q >= 0, m >= 0, m <= p], m * m, p * q),),
            ),
        ),
        part="a",
        kind="step",
    ),
    Claim(
        f"{LABEL}:e3",
        "the product of the two constants",
        "sqrt(C_1^0 C_1^1) = C_1 with C_1^0 = 2 l_T/mu, C_1^1 = 2 Delta l_S/mu.",
        "l_T, l_S >= 0",
        (Identity(_constant, "l_T = p^2, Delta l_S = q^2, both sides squared"),),
        part="b",
        kind="step",
    ),
    Claim(
        f"{LABEL}:e3",
        "the third inequality",
        "(rho_S^0)^(d/2) <= rho_S^d with the rho_S of the theorem.",
        "Delta l_S/mu >= 3/2, where rho_S^0 >= 0",
        (
            Counterexample(
                lambda: (printed_rate(Fraction(24)), gamma(Fraction(24))),
                {"Delta l_S/mu": Fraction(24), "d": 1},
                "squares at d = 1: rho_S^0 = 1 - 2/7 = 5/7, rho_S^2 = 1 - 2/6 = 2/3. The proof "
                "has 2 Delta l_S, and no + 1; the theorem has Delta l_S; they differ for "
                "all couplings but one",
            ),
        ),
        part="c",
        kind="step",
        repaired=f"{LABEL}[r]: gamma_S = rho_S^2 throughout.",
    ),
    Claim(
        f"{LABEL}:e3",
        "one top or lateral variable",
        "|x - x'| <= C_1 rho_T^|t0-tau| rho_S^d(v0,u) |z - z'|.",
        CLASS,
        (
            Counterexample(
                lambda: (smallest(WEAK_SPACE, "top"), Fraction(1, 9)),
                WEAK_SPACE | {"k": 2, "r": 1, "moved": "(t+1, v)"},
                f"{WINDOW}. The top action moves (t, v) by 64/273; promised is C_1 rho_T = "
                "2/9 * 1/2",
            ),
        ),
        kind="step",
        uses=tuple(
            f"{LABEL}:{k}" for k in ("e1", "e1[a]", "e2", "e2[b]", "e3[a]", "e3[b]", "e3[c]")
        ),
        repaired=f"{LABEL}[r].",
    ),
    Claim(
        f"{LABEL}:e4",
        "one bottom variable",
        "|x - x'| <= C_2 rho_T^(t0-(t-1)) rho_S^d(v0,u) |y - y'|.",
        CLASS,
        (
            Counterexample(
                lambda: (smallest(WEAK_SPACE, "bottom"), Fraction(1, 9)),
                WEAK_SPACE | {"k": 2, "r": 1, "moved": "(t-1, v)"},
                f"{WINDOW}. 64/273 against C_2 rho_T = 2/9 * 1/2",
            ),
        ),
        kind="step",
        uses=(f"{LABEL}:e1", f"{LABEL}:e2[b]"),
        repaired=f"{LABEL}[r].",
    ),
)
