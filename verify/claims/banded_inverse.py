"""``thm:graph-induced-band-mat-inverse``: inverses of graph-banded matrices decay."""

from __future__ import annotations

from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.search import Search
from ..engines.symbolic import Identity, Nonnegative
from ._sampled import lemma

LABEL = "thm:graph-induced-band-mat-inverse"
GIVEN = (
    "A positive definite, q-banded on the graph, eigenvalues in [a_0, b_0]; D >= 0 block diagonal"
)


def _demko() -> tuple[Any, Any]:
    import sympy

    u = sympy.symbols("u", nonnegative=True)
    s = 1 + u
    return (1 + s) ** 2 / (2 * s**2), sympy.Integer(2)


def _attained() -> tuple[Any, Any]:
    import sympy

    s = sympy.symbols("s", positive=True)
    kappa = s**2
    A = sympy.Matrix([[1 + kappa, 1 - kappa], [1 - kappa, 1 + kappa]]) / 2
    corner = A.inv()[0, 1]
    return corner, (1 + s) ** 2 / (2 * kappa) * (s - 1) / (s + 1)


def _pole() -> tuple[Any, Any]:
    import sympy

    s = sympy.symbols("s", positive=True)
    gamma = (s - 1) / (s + 1)
    return (gamma + 1 / gamma) / 2, (s**2 + 1) / (s**2 - 1)


def _recurrence() -> tuple[Any, Any]:
    import sympy

    z, w = sympy.symbols("z w", positive=True)  # w = z^n
    chebyshev = [(w * z**k + 1 / (w * z**k)) / 2 for k in (-1, 0, 1)]
    return chebyshev[2], (z + 1 / z) * chebyshev[1] - chebyshev[0]


def chebyshev() -> Identity:
    """Return the recurrence of (c)."""
    return Identity(
        _recurrence,
        "w = z^n for any n: (z^n + z^-n)/2 obeys T_(n+1) = 2 c T_n - T_(n-1) with "
        "c = (z + 1/z)/2, and has its values at n = 0, 1; c = (kappa+1)/(kappa-1) is [f]",
    )


def quotients() -> Decision:
    """Return the Rayleigh quotients of (d)."""
    return Decision(
        ("a_0", "b_0", "alpha", "delta"),
        lambda a, b, alpha, delta: (
            [a > 0, alpha >= a, alpha <= b, delta >= 0],
            (alpha + delta) * a,
            b * (a + delta),
        ),
        "Rayleigh quotients: alpha = x'Ax, delta = x'Dx; (alpha + delta)/(a_0 + delta) is "
        "at least 1 at once, at most b_0/a_0 by this",
        false=(
            lambda a, b, alpha, delta: (
                [a > 0, alpha >= a, alpha <= b, delta >= 0],
                (alpha + delta) * a,
                a * (a + delta),
            ),
        ),
    )


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "blocks of the inverse decay, constant 2/a_0",
        "|((A+D)^-1)_(S_R,S_C)| <= (2/a_0) gamma^d, gamma = ((sqrt(kappa)-1)/(sqrt(kappa)+1))^(2/q)"
        ", kappa = b_0/a_0, d = d(S_R, S_C).",
        GIVEN,
        (
            chebyshev(),
            quotients(),
            Search(
                lemma(LABEL, "stated", "Hessian, stated"),
                "random banded matrices with q = 2, 4, 6, and Hessians of local problems; sets at "
                "all distances",
                quick=40,
                full=2000,
                nudge=0.45,
            ),
        ),
        kind="lemma",
        uses=tuple(f"{LABEL}[{part}]" for part in "bcd"),
    ),
    Claim(
        LABEL,
        "the constant of Demko, Moss and Smith",
        "The same with c(kappa)/a_0, c(kappa) = max{1, (1+sqrt(kappa))^2/(2 kappa)}, and the "
        "exponent ceil(2d/q) of gamma^(q/2).",
        GIVEN,
        (
            Search(
                lemma(LABEL, "sharp", "Hessian, sharp"),
                "the same matrices; attained (part e)",
                quick=40,
                full=2000,
                nudge=0.9,
                seed=1,
            ),
        ),
        part="a",
        kind="lemma",
        uses=(f"{LABEL}[d]",),
    ),
    Claim(
        LABEL,
        "the sharper constant is at most 2",
        "(1+sqrt(kappa))^2/(2 kappa) <= 2, with equality at kappa = 1 only: [a] implies the lemma.",
        "kappa >= 1",
        (Nonnegative(_demko, "sqrt(kappa) = 1 + u, u >= 0"),),
        part="b",
        kind="step",
    ),
    Claim(
        LABEL,
        "polynomials that approximate 1/x",
        "T_n((kappa+1)/(kappa-1)) = (gamma^n + gamma^-n)/2 >= gamma^-n/2 for all n, so the "
        "polynomial (1 - T_n(.)/T_n(c))/x of degree n-1 differs from 1/x on [a_0, b_0] by at most "
        "2 gamma^n/a_0: the constant 2 without any cited theorem.",
        "gamma = (sqrt(kappa)-1)/(sqrt(kappa)+1), kappa > 1",
        (chebyshev(),),
        part="c",
        kind="step",
        uses=(f"{LABEL}[f]",),
    ),
    Claim(
        LABEL,
        "the block diagonal D does no harm",
        "(a_0 I + D)^(-1/2) (A + D) (a_0 I + D)^(-1/2) has its spectrum in [1, b_0/a_0].",
        "a_0 <= x'Ax <= b_0 and x'Dx >= 0 for unit vectors x",
        (quotients(),),
        part="d",
        kind="step",
    ),
    Claim(
        LABEL,
        "the sharper constant is attained",
        "For A with eigenvalues 1, kappa on two vertices |(A^-1)_(1,2)| = ((1+sqrt(kappa))^2/(2 "
        "kappa)) gamma: the constant of [a] without its max, which matters at d = 0 only.",
        "kappa >= 1",
        (Identity(_attained, "kappa = s^2"),),
        part="e",
        kind="remark",
    ),
    Claim(
        LABEL,
        "the pole outside the interval",
        "(gamma + 1/gamma)/2 = (kappa+1)/(kappa-1).",
        "kappa > 1",
        (Identity(_pole, "kappa = s^2"),),
        part="f",
        kind="step",
    ),
)
