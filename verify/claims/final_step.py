"""``le:final-step``: boundary errors decay in time and space, and the lines of its proof."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..claim import Claim
from ..engines.exact import Counterexample
from ..engines.search import Search
from ..engines.symbolic import Identity, Nonnegative
from ._sampled import lemma
from ._sums import counted
from .products import weighted

LABEL = "le:final-step"
TIGHT = "thm:networked-exp-decay-tight"
CONDITIONS = "the conditions of thm:networked-exp-decay-tight"
DRAWN = "random local problems within the conditions, often at their edge"
TERMS = counted(
    "2^l",
    "M^-1 = sum_l D^-1 (-J)^l by le: H-inverse, each term by [c] with a binomial n, sum over l by "
    "[g], neighbours of the boundary by [e], constants by [f]",
)
PRODUCT = weighted("with Q^-1 (2/mu, [graph-banded]) and J^l (le:J-bound) for the two factors")


def _union() -> tuple[Fraction, Fraction]:
    """Path, r = 3, v0 = v, |y_u| = 1 at both ends: line 1 with a union beside line 2."""
    rate = Fraction(1, 2)
    left = sum((2 * rate ** abs(q) for q in range(-2, 3)), Fraction(0))
    return left, 2 * 2 * rate**2


def _constants() -> tuple[Any, Any]:
    import sympy

    a, t, mu, l, D, w = sympy.symbols("a t mu l D w", positive=True)  # noqa: E741
    rho = 4 * t * l / mu
    first = 2 * l * a**2 / (mu - 4 * t * l) - rho * a**2 / (2 * t * (1 - rho))
    other = 2 * D * a**2 / (w * (mu - 4 * t * l)) - 2 * a**2 * (D / mu) / (w * (1 - rho))
    return first + a * other, sympy.Integer(0)


def _geometric() -> tuple[Any, Any]:
    """sum_(l>=m) rho^l = rho^m/(1-rho): the tail loses its first term."""
    import sympy

    rho, w = sympy.symbols("rho w", positive=True)  # w = rho^m
    return w / (1 - rho) - w, w * rho / (1 - rho)


def _pascal() -> tuple[Any, Any]:
    import sympy

    l, k = sympy.symbols("l k", positive=True)  # noqa: E741
    return k / l + (l - k) / l, sympy.Integer(1)


def _stirling_above() -> tuple[Any, Any]:
    import sympy

    n = sympy.symbols("n", positive=True)
    t2 = 1 / (2 * n + 1) ** 2
    return t2 / (3 * (1 - t2)), (1 / n - 1 / (n + 1)) / 12


def _stirling_below() -> tuple[Any, Any]:
    import sympy

    m = sympy.symbols("m", nonnegative=True)
    n = 1 + m
    t2 = 1 / (2 * n + 1) ** 2
    return 1 / (12 * n + 1) - 1 / (12 * (n + 1) + 1), (t2 / 3) / (1 - t2 / 3)


def _nearer() -> tuple[Any, Any]:
    import sympy

    z = sympy.symbols("z", nonnegative=True)
    return 1 / (1 + z), sympy.Integer(1)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "lateral errors, exponent d - 1",
        "|(M^-1_(tau',tau) K y)_v0| <= C_1 rho_T^|tau'-tau| sum_u rho_S^(d(v0,u)-1) |y_u|.",
        CONDITIONS,
        (TERMS, Search(lemma(LABEL, "K, stated"), DRAWN, quick=40, full=3000, nudge=0.01)),
        kind="lemma",
        uses=(
            "le:J-bound",
            "thm: l-power",
            "thm:graph-induced-band-mat-inverse",
            "eq:19",
            f"{LABEL}[c]",
            f"{LABEL}[e]",
            f"{LABEL}[f]",
            f"{LABEL}[g]",
            f"{LABEL}[h]",
        ),
    ),
    Claim(
        LABEL,
        "top and bottom errors",
        "|(M^-1_(tau',i) R e)_v0| <= C_2 rho_T^(|tau'-i|+1) sum_u rho_S^d(v0,u) |e_u|.",
        CONDITIONS,
        (TERMS, Search(lemma(LABEL, "R, stated"), DRAWN, quick=40, full=3000, nudge=0.05)),
        part="a",
        kind="lemma",
        uses=(f"{LABEL}[c]", f"{LABEL}[f]", f"{LABEL}[g]", f"{LABEL}[h]"),
    ),
    Claim(
        LABEL,
        "the lemma implies the theorem's display",
        "The lemma's C_1 rho_S^(d-1) is at most the C_1 rho_S^d that the display after it, and "
        "thm:networked-exp-decay-tight, have.",
        "rho_S < 1",
        (
            Counterexample(
                lambda: (Fraction(1), Fraction(1, 2)),
                {"C_1": 1, "rho_S": Fraction(1, 2), "d": 1},
                "(1/2)^0 > (1/2)^1: the statement is weaker than what its proof ends with, and "
                "than what is used",
            ),
        ),
        part="b",
        kind="step",
        repaired=f"{LABEL}[r]: exponent d, the last line of the proof.",
    ),
    Claim(
        LABEL,
        "the product D^-1 J^l decays",
        "|(Q^-1 (-J)^l)_(u,q)| <= a^2 (2/mu) binom(l, (l-|tau'-tau|)/2) (2 a~ l_T/mu)^l "
        "rho_S^d(u,q), l >= 0.",
        CONDITIONS,
        (PRODUCT, Search(lemma(LABEL, "product"), DRAWN, quick=40, full=3000, nudge=0.4)),
        part="c",
        kind="step",
        uses=("le:J-bound", "thm: l-power", "thm:graph-induced-band-mat-inverse"),
    ),
    Claim(
        LABEL,
        "the index set of the second inequality",
        "sum_q lambda'^d(v0,q) sum_(u in boundary UNION N_q^1) |y_u| <= sum_u Delta "
        "lambda'^(d(v0,u)-1) |y_u|, as printed with a union.",
        "lambda' < 1",
        (
            Counterexample(
                _union,
                {"graph": "path", "r": 3, "v0": "v", "lambda'": Fraction(1, 2), "|y|": 1},
                "five q between two ends: each q counts both ends, 2 (1 + 2/2 + 2/4) = 5 beside "
                "2 * 2 * 1/4 = 1. With the intersection, the line before, 2/4 <= 1",
            ),
        ),
        part="d",
        kind="step",
        repaired=f"{LABEL}[e]: boundary INTERSECTED with N_q^1.",
    ),
    Claim(
        LABEL,
        "Delta neighbours, one hop nearer",
        "A lateral u has at most Delta neighbours q, with lambda'^d(v0,q) <= lambda'^(d(v0,u)-1).",
        "0 <= lambda' <= 1, d(v0,q) >= d(v0,u) - 1",
        (
            Nonnegative(
                _nearer,
                "a power j >= 0 of lambda' = 1/(1+z) <= 1 is at most 1, d(v0,q) = d(v0,u) - 1 + j",
            ),
        ),
        part="e",
        kind="step",
    ),
    Claim(
        LABEL,
        "the two constants",
        "2 l_T a^2/(mu - 4 a~ l_T) = rho_T a^2/(2 a~ (1-rho_T)), and 2 Delta l_S a^2/(lambda' (mu "
        "- 4 a~ l_T)) = 2 a^2 (Delta l_S/mu)/(rho_S (1-rho_T)).",
        "rho_T = 4 a~ l_T/mu < 1",
        (Identity(_constants, "w = lambda' = rho_S, D = Delta l_S; both differences vanish"),),
        part="f",
        kind="step",
    ),
    Claim(
        LABEL,
        "the geometric series",
        "sum_(l >= m) rho_T^l = rho_T^m/(1 - rho_T).",
        "0 < rho_T < 1",
        (Identity(_geometric, "F(m) = rho^m/(1-rho) obeys F(m) - rho^m = F(m+1), and goes to 0"),),
        part="g",
        kind="step",
    ),
    Claim(
        LABEL,
        "binomials are at most 2^l",
        "binom(l, k) <= 2^l for all l, k >= 0.",
        "integers",
        (
            Identity(
                _pascal,
                "binom(l,k) = binom(l-1,k-1) + binom(l-1,k), divided by binom(l,k); by induction "
                "at most 2^(l-1) + 2^(l-1)",
            ),
        ),
        part="h",
        kind="step",
    ),
    Claim(
        LABEL,
        "Stirling's approximation, upper half",
        "n! < sqrt(2 pi n) (n/e)^n e^(1/(12n)): log n! - (n + 1/2) log n + n - 1/(12n) increases.",
        "n >= 1",
        (
            Identity(
                _stirling_above,
                "t = 1/(2n+1): (n+1/2) log((n+1)/n) - 1 = t^2/3 + t^4/5 + .. < (t^2/3)/(1-t^2), "
                "which is (1/n - 1/(n+1))/12; the limit is log sqrt(2 pi)",
            ),
        ),
        part="i",
        kind="step",
    ),
    Claim(
        LABEL,
        "Stirling's approximation, lower half",
        "n! > sqrt(2 pi n) (n/e)^n e^(1/(12n+1)): the same with 1/(12n+1) decreases.",
        "n >= 1",
        (
            Nonnegative(
                _stirling_below,
                "n = 1 + m; t^2/3 + t^4/5 + .. > (t^2/3)/(1-t^2/3) as 3^j >= 2j + 1",
            ),
        ),
        part="j",
        kind="step",
    ),
    Claim(
        LABEL,
        "lateral errors, exponent d",
        "|(M^-1_(tau',tau) K y)_v0| <= C_1 rho_T^|tau'-tau| sum_u rho_S^d(v0,u) |y_u|.",
        CONDITIONS,
        (TERMS, Search(lemma(LABEL, "K, as used"), DRAWN, quick=40, full=3000, nudge=0.02)),
        part="r",
        kind="lemma",
        uses=(f"{LABEL}[c]", f"{LABEL}[e]", f"{LABEL}[f]", f"{LABEL}[g]", f"{LABEL}[h]"),
    ),
)
