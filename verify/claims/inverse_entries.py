"""``lemma:inverse-graph-lower-bound``: entries of ``(I + l L)^{-1}`` on the ring of blocks."""

from __future__ import annotations

from fractions import Fraction as Q
from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.symbolic import Nonnegative

LEMMA = "lemma:inverse-graph-lower-bound"
EQUATION = "equ:graph-Laplacian-inverse"
ELL = Q(5, 16)  # sqrt(1 + 4 l) = 3/2, g(4 l) = 1/5


def ring_entry(blocks: int, kappa: int, ell: Q = ELL, sign: int = 1) -> Q:
    """Return ``((1 + 2l) I - sign l M)^{-1}_{0,kappa}`` on a ring of single vertices, exactly.

    By elimination in fractions; ``sign = 1``: ``(I + l L)^{-1}``.
    """
    rows = [[Q(0)] * (blocks + 1) for _ in range(blocks)]
    for i in range(blocks):
        rows[i][i] = 1 + 2 * ell
        for j in (i - 1, i + 1):
            rows[i][j % blocks] -= sign * ell
    rows[0][blocks] = Q(1)
    for i in range(blocks):
        for j in range(blocks):
            if j != i and rows[j][i]:
                factor = rows[j][i] / rows[i][i]
                rows[j] = [a - factor * b for a, b in zip(rows[j], rows[i], strict=True)]
    return rows[kappa][blocks] / rows[kappa][kappa]


def same_parity(blocks: int, kappa: int) -> Q:
    """Return the part of the series over walks of length ``kappa, kappa + 2, ...``."""
    other = ring_entry(blocks, kappa, sign=-1) * (1 if kappa % 2 == 0 else -1)
    return (ring_entry(blocks, kappa) + other) / 2


def first_claim(kappa: int) -> Q:
    """Return the printed first claim for d = 1."""
    weight: Q = (ELL / (2 * ELL + 1)) ** kappa
    return kappa * weight / (2 * ELL + 1)


def _first() -> tuple[Any, Any]:
    import sympy

    u = sympy.Symbol("u", nonnegative=True)
    s = 1 + u  # sqrt(1 + 4D), D = d l
    D = (s**2 - 1) / 4
    return D / (2 * D + 1), (s - 1) / (s + 1)


def _front() -> tuple[Any, Any]:
    import sympy

    u, e = sympy.symbols("u e", nonnegative=True)
    s, d = 1 + u, 1 + e
    return 1 / (d**2 * (2 * (s**2 - 1) / 4 + 1)), 1 / (d * s)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LEMMA,
        "entries for all couplings",
        "((I + l L)^{-1})_ij >= kappa/(d^2 (2dl+1)) (dl/(2dl+1))^kappa, kappa = d(i,j) >= 3",
        "the ring of blocks of the proof, N large (as printed, 'there exists a finite graph', it "
        "holds vacuously for any graph of diameter 2)",
        (
            Counterexample(
                lambda: (first_claim(3), ring_entry(12, 3)),
                {"d": 1, "l": ELL, "N": 12, "kappa": 3},
                "A ring of 12 vertices: the entry is 2/375 up to 1e-8 (q^3/s, q = 1/5, s = "
                "3/2), the "
                "claim 3 (5/26)^3 (8/13) = 0.0131; more vertices do not change it",
            ),
        ),
        kind="lemma",
        uses=(f"{EQUATION}:e2[m=0]",),
        repaired=f"without the factor kappa: {LEMMA}[repaired]",
    ),
    Claim(
        LEMMA,
        "entries for all couplings, repaired",
        "((I + l L)^{-1})_ij >= (1/(d^2 (2dl+1))) (dl/(2dl+1))^kappa",
        "the ring of blocks, kappa >= 1, any N (the exact entry g(4dl)^kappa/(d sqrt(1+4dl)) only "
        "grows when the ring closes)",
        (
            Nonnegative(_first, "sqrt(1+4dl) = 1 + u: dl/(2dl+1) <= g(4dl)"),
            Nonnegative(_front, "and d = 1 + e: 1/(d^2 (2dl+1)) <= 1/(d sqrt(1+4dl))"),
        ),
        part="repaired",
        kind="lemma",
        uses=("nearsight:ring-of-blocks",),
    ),
    Claim(
        LEMMA,
        "entries for strong couplings",
        "((I + l L)^{-1})_ij >= (1 - 4/sqrt(dl))^kappa/(4 sqrt(pi kappa sqrt(dl)) d^2 (2dl+1))",
        "l > 16/d, kappa >= 3; the ring of blocks",
        (
            Decision(
                ("t",),
                lambda t, s: ([t > 4], t * 2, 4 * (s + 1)),
                "t = sqrt(dl), s = sqrt(1+4t^2): g(4dl) = 1 - 2/(s+1) >= 1 - 4/t >= 0",
                roots={"s": lambda t: 1 + 4 * t * t},
                false=(lambda t, s: ([t > 4], t * 2, s * 0 + 8),),
            ),
            Nonnegative(_front, "1/(d^2 (2dl+1)) <= 1/(d s), and 4 sqrt(pi kappa t) >= 1"),
        ),
        part="strong",
        kind="lemma",
        uses=(f"{EQUATION}:e4", "lemma:numerical-lower-bound"),
    ),
    Claim(
        f"{EQUATION}:e1",
        "walks of one parity only",
        "((I + l L)^{-1})_ij = l^kappa/(2dl+1)^{kappa+1} sum_m (l/(2dl+1))^{2m} (M^{kappa+2m})_ij",
        "N blocks in a ring, N large",
        (
            Counterexample(
                lambda: (ring_entry(7, 3), same_parity(7, 3)),
                {"d": 1, "l": ELL, "N": 7, "kappa": 3},
                "On a ring with N odd, walks the other way around have the other parity: the left "
                "side is larger, by walks of N - kappa = 4 steps and more",
            ),
        ),
        kind="step",
        repaired="for even N, or with >= for =, which is what is used: all terms of "
        f"{EQUATION}[series] are >= 0",
    ),
    Claim(
        f"{EQUATION}:e2",
        "walks through blocks",
        "(M^{kappa+2m})_ij >= binom(kappa+2m, m) d^{kappa+2m-2}",
        "kappa + 2m - 1 vertices lie between the ends: the exact exponent is kappa + 2m - 1",
        (
            Decision(
                ("d", "paths", "power"),
                lambda d, paths, power: (
                    [d >= 1, paths >= 0, power >= 0],
                    paths * power,
                    paths * power * d,
                ),
                "M is the ring's adjacency matrix times the all-ones matrix J, J^n = d^{n-1} J",
                false=(
                    lambda d, paths, power: (
                        [d >= 0, paths >= 0, power >= 0],
                        paths * power,
                        paths * power * d,
                    ),
                ),
            ),
        ),
        kind="step",
        uses=(f"{EQUATION}:e1",),
    ),
    Claim(
        f"{EQUATION}:e2",
        "the first term of the series",
        "the term m = 0 of (e2) is kappa/(d^2 (2dl+1)) (dl/(2dl+1))^kappa",
        "",
        (
            Counterexample(
                lambda: (first_claim(3), first_claim(3) / 3),
                {"d": 1, "l": ELL, "kappa": 3, "m": 0},
                "binom(kappa, 0) = 1, not kappa",
            ),
        ),
        part="m=0",
        kind="step",
        uses=(f"{EQUATION}:e2",),
        repaired=f"without the factor kappa: {LEMMA}[repaired]",
    ),
    Claim(
        f"{EQUATION}:e3",
        "every share of steps back",
        "q >= ((1 - eps^2/2)(1 - 1/(2dl+1)))^{2/eps+1}, q = g(4dl), for all eps in (0, 1) (printed "
        "with I + L for I + l L, and derived where kappa/eps is an integer)",
        "d l > 0; it gives (e3), as 1/(d s) >= 1/(d^2 (2dl+1))",
        (
            Decision(
                ("z", "grown", "shrunk"),
                lambda z, grown, shrunk: (
                    [z >= 0, grown >= 1 + z + z * z / 2, shrunk >= 1 - z - z * z / 4],
                    2,
                    grown + shrunk,
                ),
                "q = exp(-arcosh(e^L)), L = log(1 + 1/(2dl)). The right side is at most "
                "exp(-2 L/eps "
                "- eps - L) <= exp(-z - L), z = 2 sqrt(2L), by log(1-y) <= -y and two positive "
                "numbers' means; so cosh(z + L) >= e^L suffices: grown = e^z, shrunk = e^{-z-2L}",
                false=(
                    lambda z, grown, shrunk: (
                        [z >= 0, grown >= 1 + z, shrunk >= 1 - z - z * z / 4],
                        2,
                        grown + shrunk,
                    ),
                ),
            ),
        ),
        kind="step",
        uses=(f"{EQUATION}:e2", "lemma:numerical-lower-bound"),
    ),
    Claim(
        f"{EQUATION}:e4",
        "the choice of eps",
        "(1 - (4 sqrt(dl)+1)/(2dl)) (1 - (4 sqrt(dl)+1)/(2dl+1)) >= 1 - 4/sqrt(dl)",
        "d l > 16; 1/eps = floor(2 sqrt(dl)), so that eps <= 1/sqrt(dl) and 2/eps + 1 <= 4 "
        "sqrt(dl) "
        "+ 1; the step before is Bernoulli's inequality",
        (
            Decision(
                ("t",),
                lambda t: (
                    [t > 4],
                    (t - 4) * 2 * t * (2 * t * t + 1),
                    (2 * t * t - 4 * t - 1) * (2 * t * t - 4 * t),
                ),
                "t = sqrt(dl), multiplied by 2 t^2 (2 t^2 + 1)",
                false=(
                    lambda t: (
                        [t > 4],
                        (t - 3) * 2 * t * (2 * t * t + 1),
                        (2 * t * t - 4 * t - 1) * (2 * t * t - 4 * t),
                    ),
                ),
            ),
        ),
        kind="step",
        uses=(f"{EQUATION}:e3",),
    ),
)
