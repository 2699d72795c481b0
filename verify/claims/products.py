"""``thm: l-power``, ``le:J-properties``, ``le:J-bound``: products of decaying matrices."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.search import Search, Trial
from ..engines.symbolic import Identity
from ._sampled import lemma
from ._sums import terms

POWER, WALKS, BOUND = "thm: l-power", "le:J-properties", "le:J-bound"


def _pascal() -> tuple[Any, Any]:
    """Cases i != j and i = j of the induction, divided by the binomial on the right."""
    import sympy

    l, k, x = sympy.symbols("l k x", positive=True)  # noqa: E741
    # binom(l-1, k-1)/binom(l, k) = k/l and binom(l-1, k)/binom(l, k) = (l-k)/l; twice the first
    # at k = l/2 for i = j
    return k / l + (l - k) / l + x * 2 * (l / 2) / l, 1 + x


def _count(rng: np.random.Generator) -> Trial:
    """Walks of l steps from i to j on the path 1..S; parity and reach as well."""
    from ...perturbation.lemmas.walks import counts, most

    S, length = int(rng.integers(1, 10)), int(rng.integers(1, 13))
    number = counts(S, length)
    i, j = (int(z) for z in rng.integers(0, S, 2))
    limit = most(length, abs(i - j))
    about = {"S": S, "l": length, "i": i + 1, "j": j + 1}
    return float(number[i, j]), float(limit), about


def weighted(last: str) -> Decision:
    """Return the step from l - 1 to l factors, with the weights ``lambda'^-d``."""
    return Decision(
        ("w_uq", "w_us", "w_sq", "X", "Y"),
        lambda w_uq, w_us, w_sq, X, Y: (
            [w_uq >= 0, w_us >= 0, w_sq >= 0, X >= 0, Y >= 0, w_uq <= w_us * w_sq],
            w_uq * X * Y,
            (w_us * X) * (w_sq * Y),
        ),
        "w = lambda'^-d obeys w_uq <= w_us w_sq by the triangle inequality, X = |(A_1..A_(l-1))"
        "_us|, Y = |(A_l)_sq| <= C_l lambda^d; summed over s (and q) the first factors give "
        f"a~^(l-1) C_1..C_(l-1), {last}",
        false=(
            lambda w_uq, w_us, w_sq, X, Y: (
                [w_uq >= 0, w_us >= 0, w_sq >= 0, X >= 0, Y >= 0, w_uq <= 2 * w_us * w_sq],
                w_uq * X * Y,
                (w_us * X) * (w_sq * Y),
            ),
        ),
    )


CLAIMS: tuple[Claim, ...] = (
    Claim(
        POWER,
        "products of exponentially decaying matrices decay",
        "|(A_1...A_l)_(u,q)| <= a~^l C_1...C_l lambda'^d(u,q), a~ = sum_k (lambda/lambda')^k h(k).",
        "|(A_i)_(u,q)| <= C_i lambda^d(u,q), lambda < lambda' < 1",
        (
            weighted("the last one at most a~ C_l"),
            Search(
                lemma(POWER, "stated"),
                "random blocks, and positive ones at their bounds, on 15 kinds of graphs",
                quick=150,
                full=5000,
                nudge=0.7,
            ),
        ),
        kind="lemma",
    ),
    Claim(
        POWER,
        "one sum less",
        "The same with a~^(l-1).",
        "as above",
        (
            weighted("and the last one is at most C_l (lambda/lambda')^d <= C_l for every q"),
            Search(
                lemma(POWER, "sharp"),
                "the same products; attained at l = 1 and, as lambda -> 1, at every l",
                quick=150,
                full=5000,
                nudge=0.9,
            ),
        ),
        part="a",
        kind="lemma",
    ),
    Claim(
        WALKS,
        "which blocks of J^l vanish, and how many terms the others have",
        "(J^l)_(i,j) = 0 if l < |i-j| or l - |i-j| is odd; else it has at most "
        "binom(l, (l-|i-j|)/2) terms.",
        "l, i, j >= 1; binomials with a negative lower number are 0, too (the paper's note has "
        "only the odd case)",
        (
            Identity(
                _pascal,
                "induction on l: a walk of l steps comes from i - 1 or i + 1, parity and reach "
                "included, so their numbers add up; the binomials obey Pascal's rule in both "
                "cases, and a path's ends only take walks away",
            ),
            Search(
                _count,
                "exact numbers of walks on paths of up to 9 steps, l up to 12; equality wherever "
                "no walk can leave the path",
                quick=400,
                full=20000,
                nudge=0.9,
            ),
        ),
        kind="lemma",
        uses=(f"{WALKS}[a]",),
    ),
    Claim(
        WALKS,
        "the induction step",
        "binom(l-1, k_0-1) + binom(l-1, k_0) = binom(l, k_0), and 2 binom(l-1, l/2-1) = "
        "binom(l, l/2): the number of terms obeys Pascal's rule in both cases.",
        "1 <= k_0 < l",
        (Identity(_pascal, "divided by the right-hand side: k/l + (l-k)/l, and 2 (l/2)/l"),),
        part="a",
        kind="step",
    ),
    Claim(
        BOUND,
        "blocks of J^l decay in space",
        "|((J^l)_(i,j))_(u,q)| <= binom(l, (l-|i-j|)/2) (2 b l_T/mu)^l gamma_S'^d(u,q), "
        "b = sum_q (gamma_S/gamma_S')^q h(q).",
        "Assumption 2.1, gamma_S < gamma_S' < 1",
        (
            terms(
                "a sum of n terms of at most B each: le:J-properties counts them, and B = (2 b l_T"
                "/mu)^l gamma_S'^d is thm: l-power for factors |A| |D^-1| <= l_T (2/mu) gamma_S^d"
            ),
            Search(
                lemma(BOUND, "stated"),
                "random local problems, l <= 8; 1/4 of the bound at most is used",
                quick=40,
                full=3000,
                nudge=0.15,
            ),
        ),
        kind="lemma",
        uses=(WALKS, POWER, "thm:graph-induced-band-mat-inverse"),
    ),
    Claim(
        BOUND,
        "blocks of J^l decay in space, sharper",
        "The same with b^(l-1) (c(1+x) l_T/(2 mu))^l in place of (2 b l_T/mu)^l.",
        "as above",
        (
            Search(
                lemma(BOUND, "sharp"),
                "random local problems, l <= 8",
                quick=40,
                full=3000,
                nudge=0.4,
            ),
        ),
        part="a",
        kind="lemma",
        uses=(
            WALKS,
            f"{POWER}[a]",
            "thm:graph-induced-band-mat-inverse[a]",
            "prop:exp-decay-networked-SOCO[d]",
        ),
    ),
)
