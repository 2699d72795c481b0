"""``thm:networked-exp-decay``: what the text says on averages, limits and scalings."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..claim import Claim
from ..engines.exact import Counterexample
from ..engines.symbolic import Nonnegative
from .networked_exp_decay import LABEL


def _below() -> tuple[Any, Any]:
    import sympy

    u = sympy.symbols("u", nonnegative=True)
    return u / (u + 2), ((1 + u) ** 2 - 1) / 4


def _above() -> tuple[Any, Any]:
    import sympy

    u = sympy.symbols("u", nonnegative=True)
    y = (1 + u) ** 2 - 1
    return (y / 4) / (1 + y / 2), u / (u + 2)


def _joint() -> tuple[Any, Any]:
    import sympy

    u, w = sympy.symbols("u w", nonnegative=True)
    return u / (u + 2), (u + w) / (u + w + 2)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        "sec:main:perturb#averaging",
        "the average of two bounds",
        "The (arithmetic) average of the two bounds is at most the product bound: "
        "(p + q)/2 <= sqrt(p q).",
        "p, q >= 0: the values of the two bounds",
        (
            Counterexample(
                lambda: (Fraction(1, 2) ** 2, Fraction(0)),
                {"p": 1, "q": 0},
                "p = 1, q = 0, squares: (1/2)^2 > 0",
            ),
        ),
        kind="remark",
        repaired=f"{LABEL}:e3[a]: the geometric average.",
    ),
    Claim(
        "sec:main:perturb#rates",
        "rho = Theta(sqrt(coupling)), from above",
        "g(y) <= y/4: rho_T <= sqrt(l_T/(2 mu)), rho_S <= sqrt(Delta l_S/mu)/2.",
        "y >= 0",
        (Nonnegative(_below, "y = (1+u)^2 - 1, u >= 0"),),
        part="a",
        kind="remark",
    ),
    Claim(
        "sec:main:perturb#rates",
        "rho = Theta(sqrt(coupling)), from below",
        "g(y) >= (y/4)/(1 + y/2): both rates go to 0 as the root of the coupling does.",
        "y >= 0",
        (Nonnegative(_above, "y = (1+u)^2 - 1, u >= 0"),),
        part="b",
        kind="remark",
    ),
    Claim(
        "sec:main:perturb#rates",
        "one rate for time and space is worse",
        "The rate g(2a + x) of the direct approach is at least g(2a) and g(x).",
        "a, x >= 0",
        (Nonnegative(_joint, "g is u/(u+2) with u = sqrt(1+y) - 1, which increases with y"),),
        part="c",
        kind="remark",
    ),
)
