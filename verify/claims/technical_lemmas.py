"""``lemma:combinatorial-number-near-center`` and ``lemma:numerical-lower-bound``."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.search import Search, Trial
from ..engines.symbolic import Identity, Nonnegative

BINOMIAL = "lemma:combinatorial-number-near-center"
ENTROPY = "lemma:numerical-lower-bound"


def _stirling() -> tuple[Any, Any]:
    """The exponents of the two last lines, ``n = eps m``: -1/(6m) and what Stirling leaves."""
    import sympy

    u, n = sympy.symbols("u n", nonnegative=True)
    m = 1 + u
    left = 1 / (12 * (2 * m + n) + 1) - 1 / (12 * m) - 1 / (12 * (m + n))
    return -1 / (6 * m), left


def _binomials(rng: np.random.Generator) -> Trial:
    from ...lowerbounds.lemmas import central_binomial

    m = int(rng.choice([1, 2, 3, int(rng.integers(1, 400))]))
    n = int(rng.choice([0, 1, int(rng.integers(0, 2000))]))
    found = central_binomial(m, n)
    return float(found.claimed / found.exact), 1.0, {"m": m, "eps m": n}


def _slope() -> tuple[Any, Any]:
    """The derivative of the proof's function g(eps), and the printed one."""
    import sympy

    e = sympy.Symbol("epsilon", positive=True)
    half = sympy.Rational(1, 2)
    g = sympy.log(1 + e / 2) - (1 + e) / 2 * sympy.log(1 + e) - sympy.log(1 - e**2 / 2)
    log = sympy.Symbol("log")  # stands for log(1 + eps): the rest is rational
    slope = sympy.diff(g, e).subs(sympy.log(1 + e), log)
    return slope, 1 / (2 + e) - half - log / 2 + e / (1 - e**2 / 2)


def _chain() -> tuple[Any, Any]:
    """The two equalities of the chain."""
    import sympy

    e, u = sympy.symbols("epsilon u", positive=True)
    first = 1 / (2 + e) - sympy.Rational(1, 2) - e / 2 + e
    second = (2 - (2 + e) * (1 - e)) / (2 * (2 + e))
    return first + u * second, second + u * (e + e**2) / (2 * (2 + e))


CLAIMS: tuple[Claim, ...] = (
    Claim(
        BINOMIAL,
        "binomial coefficients near the centre",
        "binom((2+eps) m, m) > (2 pi m)^{-1/2} (2+eps)^{(2+eps)m+1/2}/(1+eps)^{(1+eps)m+1/2} "
        "e^{-1/(6m)}",
        "m >= 1, eps >= 0, eps m an integer",
        (
            Nonnegative(
                _stirling,
                "Robbins' form of Stirling's formula for the three factorials (strict there) "
                "leaves the exponents 1/(12(2+eps)m+1) - 1/(12m) - 1/(12(1+eps)m) >= "
                "-1/(6m); m = 1 "
                "+ u, n = eps m",
            ),
            Search(
                _binomials,
                "the quotient of the two sides, 50 digits",
                quick=100,
                full=3000,
                nudge=0.99,
            ),
        ),
        kind="lemma",
    ),
    Claim(
        ENTROPY,
        "an entropy near its maximum",
        "(2+eps)/(2 (1+eps)^{(1+eps)/(2+eps)}) >= 1 - eps^2/2",
        "0 <= eps < sqrt(2)",
        (
            Decision(
                ("e", "w", "log", "slope"),
                lambda e, w, log, slope: (
                    [
                        e >= 0,
                        e * e < 2,
                        log <= e,
                        w * (2 - e * e) == 2 * e,
                        slope * 2 * (2 + e) == -e - (2 + e) * log + 2 * (2 + e) * w,
                    ],
                    0,
                    slope,
                ),
                "in logarithms, and with (1+eps)/2 for (1+eps)/(2+eps), the difference of the two "
                "sides is at least g(eps), g(0) = 0; log = log(1+eps) <= eps, w = eps/(1 - "
                "eps^2/2), "
                "slope = g'(eps) = 1/(2+eps) - 1/2 - log/2 + w",
                false=(
                    lambda e, w, log, slope: (
                        [
                            e >= 0,
                            e * e < 2,
                            log <= 4 * e,
                            w * (2 - e * e) == 2 * e,
                            slope * 2 * (2 + e) == -e - (2 + e) * log + 2 * (2 + e) * w,
                        ],
                        0,
                        slope,
                    ),
                ),
            ),
        ),
        kind="lemma",
        uses=(f"{ENTROPY}[slope]",),
    ),
    Claim(
        ENTROPY,
        "the derivative",
        "g'(eps) = 1/(2+eps) - 1/2 - log(1+eps)/2 + eps/(1 - eps^2/2)",
        "g(eps) = log(1+eps/2) - (1+eps)/2 log(1+eps) - log(1 - eps^2/2)",
        (Identity(_slope, "log(1+eps) as a symbol of its own"),),
        part="slope",
        kind="step",
    ),
    Claim(
        ENTROPY,
        "a smaller denominator",
        "(1+eps)/(2+eps) log(1+eps) <= (1+eps)/2 log(1+eps)",
        "eps >= 0",
        (
            Decision(
                ("e", "log"),
                lambda e, log: (
                    [e >= 0, log >= 0],
                    2 * (1 + e) * log,
                    (1 + e) * (2 + e) * log,
                ),
                "log = log(1+eps) >= 0, times 2 (2 + eps)",
                false=(
                    lambda e, log: (
                        [e >= 0, log >= 0],
                        3 * (1 + e) * log,
                        (1 + e) * (2 + e) * log,
                    ),
                ),
            ),
        ),
        part="first",
        kind="step",
    ),
    Claim(
        ENTROPY,
        "the chain for the derivative",
        "g'(eps) >= 1/(2+eps) - 1/2 - eps/2 + eps = (2 - (2+eps)(1-eps))/(2 (2+eps)) = (eps + "
        "eps^2)/(2 (2+eps)) >= 0",
        "0 <= eps < sqrt(2)",
        (
            Decision(
                ("e", "log", "w"),
                lambda e, log, w: (
                    [e >= 0, e * e < 2, log <= e, w * (2 - e * e) == 2 * e],
                    -e / 2 + e,
                    w - log / 2,
                ),
                "log = log(1+eps) <= eps, w = eps/(1 - eps^2/2) >= eps",
                false=(
                    lambda e, log, w: (
                        [e >= 0, e * e < 2, log <= 2 * e, w * (2 - e * e) == 2 * e],
                        -e / 2 + e,
                        w - log / 2,
                    ),
                ),
            ),
            Identity(_chain, "both equalities, with an unlike factor u"),
        ),
        part="chain",
        kind="step",
        uses=(f"{ENTROPY}[slope]",),
    ),
)
