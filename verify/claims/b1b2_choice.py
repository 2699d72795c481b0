"""The text around ``thm:networked-exp-decay-tight``: how b_1, b_2 are chosen, and scalings."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..claim import Claim
from ..engines.exact import Counterexample
from ..engines.symbolic import Identity, Nonnegative

LABEL = "sec:main:perturb#b1b2-choice"
TIGHT = "thm:networked-exp-decay-tight"


def _symbols(names: str) -> Any:
    import sympy

    return sympy.symbols(names, positive=True)


def _ratios() -> tuple[Any, Any]:
    """The two ratios of the geometric series at h = Delta^q, as one number each, are 1/2."""
    import sympy

    D, lam = _symbols("Delta lam")
    b_1, b_2 = 2 * D - 1, 4 * D**2 - 2 * D
    ratio, other = D * (1 + b_1) / (1 + b_1 + b_2), D / (1 + b_1)
    total = 1 / (1 - ratio) + lam / (1 - other)
    return total, sympy.Integer(2) + 2 * lam


def _space() -> tuple[Any, Any]:
    D = _symbols("Delta")
    b_1, b_2 = 2 * D - 1, 4 * D**2 - 2 * D
    return D * (b_1 + b_2) / 4, D**3 * (1 - 1 / (4 * D**2))


def _tree() -> tuple[Any, Any]:
    import sympy

    m = sympy.symbols("m", nonnegative=True)  # Delta = 1 + m
    D = 1 + m
    return 1 + D / (2 * D) / (1 - (D - 1) / (2 * D)), sympy.Integer(2)


def _hockey() -> tuple[Any, Any]:
    """binom(q+p+1, p+1) - binom(q+p, p+1) = binom(q+p, p), divided by the last."""
    import sympy

    q, p = _symbols("q p")
    return (q + p + 1) / (p + 1) - q / (p + 1), sympy.Integer(1)


def _scaling() -> tuple[Any, Any]:
    import sympy

    u = sympy.symbols("u", nonnegative=True)
    y = (1 + u) ** 2 - 1
    return u / (u + 2), y / 4


def grid_sum(m: int) -> Fraction:
    """Return ``a_tilde = sum_q 2^-q h(q)`` of the infinite grid of dimension m.

    A product over coordinates: ``sum_{z in Z} 2^-|z| = 1 + 2 (1/2 + 1/4 + ..) = 3``.
    """
    return (1 + 2 * Fraction(1, 2) / (1 - Fraction(1, 2))) ** m


def _exponential() -> tuple[Fraction, Fraction]:
    return 8 * grid_sum(4), Fraction(8) ** 3


def _ring() -> tuple[Fraction, Fraction]:
    h = (1, 2, 2)  # of a ring of 5
    here = 8 * sum((Fraction(n, 2**q) for q, n in enumerate(h)), Fraction(0))
    D = Fraction(2)
    return max(here, D / 2), max(Fraction(16), D**3 * (1 - 1 / (4 * D**2)))


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "a = a~ = 2 for h(q) = Delta^q",
        "b_1 = 2 Delta - 1 and b_2 = 4 Delta^2 - 2 Delta give a = a~ = 2, so 8 a~ l_T = 16 l_T.",
        "h(q) = Delta^q for all q (an upper bound that no graph attains at q = 2)",
        (Identity(_ratios, "both series are geometric with ratio 1/2; a + lam a~ for all lam"),),
        kind="remark",
    ),
    Claim(
        LABEL,
        "the condition on l_S",
        "Delta l_S (b_1 + b_2)/4 = Delta^3 l_S (1 - 1/(4 Delta^2)).",
        "",
        (Identity(_space, "b_1 + b_2 = 4 Delta^2 - 1"),),
        part="a",
        kind="remark",
    ),
    Claim(
        LABEL,
        "a, a~ < 2 on every graph",
        "With h(q) <= Delta (Delta-1)^(q-1), the truth for trees, both are at most "
        "1 + Delta/(Delta+1) <= 2.",
        "Delta >= 1",
        (Nonnegative(_tree, "Delta = 1 + m, geometric series with ratio (Delta-1)/(2 Delta)"),),
        part="b",
        kind="remark",
    ),
    Claim(
        LABEL,
        "polynomial growth makes both sums finite",
        "If h(q) <= c (q+1)...(q+p) then sum_q z^q h(q) <= c p!/(1-z)^(p+1) for 0 <= z < 1: "
        "a, a~ < infinity for all b_1, b_2 > 0.",
        "0 <= z < 1",
        (
            Identity(
                _hockey,
                "sum_q binom(q+p,p) z^q = (1-z)^-(p+1) by induction on p: (1-z) times the series "
                "for p + 1 has the coefficients binom(q+p+1,p+1) - binom(q+p,p+1) = binom(q+p,p), "
                "divided by binom(q+p,p)",
            ),
        ),
        part="c",
        kind="remark",
    ),
    Claim(
        LABEL,
        "b_1 = b_2 = 1: linear growth in Delta",
        "The requirement mu > max{8 a~ l_T, Delta l_S/2}, a~ = sum_q 2^-q h(q), grows only "
        "linearly in Delta and compares favourably with Omega(Delta^3).",
        "grids, l_T = l_S",
        (
            Counterexample(
                _exponential,
                {"graph": "infinite grid of dimension 4", "Delta": 8, "a~": 81},
                "sum_q 2^-q h(q) is a product over coordinates, 3^4 = 81, so that 8 a~ = 648 > "
                "Delta^3 = 512: a~ depends on Delta, on grids like 3^(Delta/2)",
            ),
        ),
        part="d",
        kind="remark",
        repaired=f"{LABEL}: the requirement on l_S alone is Delta l_S/2; that on l_T is 8 a~ l_T "
        "with a~ = 3^(Delta/2) on grids. See also [e].",
    ),
    Claim(
        LABEL,
        "b_1 = b_2 = 1 weakens the requirement",
        "For polynomial growth b_1 = b_2 = 1 gives a weaker requirement on mu than "
        "b_1 = 2 Delta - 1, b_2 = 4 Delta^2 - 2 Delta.",
        "l_T = l_S",
        (
            Counterexample(
                _ring,
                {"graph": "ring of 5", "Delta": 2, "h": [1, 2, 2], "l_T": 1, "l_S": 1},
                "a~ = 1 + 2/2 + 2/4 = 5/2: mu >= max{20, 1} here, mu >= max{16, 15/2} there "
                "(on infinite grids of dimension 1, 2, 3: 24 > 16, 72 > 63, 216 > 214.5)",
            ),
        ),
        part="e",
        kind="remark",
        repaired=f"{LABEL}[a]: only the half on l_S is weaker; b_1, b_2 should be optimised for "
        "the given h, l_T and l_S.",
    ),
    Claim(
        "sec:main:perturb#tight-scaling",
        "gamma_S = Theta(l_S/mu)",
        "(x/4)/(1 + x/2) <= gamma_S <= x/4 with x = Delta l_S/mu (the first half is "
        "sec:main:perturb#rates[b]).",
        "x >= 0",
        (Nonnegative(_scaling, "x = (1+u)^2 - 1, u >= 0"),),
        kind="remark",
        uses=("sec:main:perturb#rates[b]",),
    ),
)
