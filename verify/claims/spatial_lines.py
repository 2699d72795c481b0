"""``thm:spatial_lower_bound``: the lines of its proof that are displayed on the way."""

from __future__ import annotations

from fractions import Fraction as Q
from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.symbolic import Identity

THEOREM = "thm:spatial_lower_bound"
EQUATION = "equ:graph-Laplacian-inverse"


def couplings() -> tuple[Q, Q]:
    """Return ``l_S/mu`` of the instance for l = 1, and l."""
    convexity, smoothness = Q(2), 4 * Q(1)  # of (x+w)^2 and l (x-y)^2
    return smoothness / convexity, Q(1)


def _square() -> tuple[Any, Any]:
    import sympy

    x, w, t = sympy.symbols("x w t", positive=True)  # 1 + z = t^2, z an eigenvalue of l L
    left = (x + w) ** 2 + (t**2 - 1) * x**2
    return left, (t * x + w / t) ** 2 + w**2 * (1 - 1 / t**2)


def _neumann() -> tuple[Any, Any]:
    import sympy

    l, d, m = sympy.symbols("l d m", positive=True)  # noqa: E741 - the paper's letter
    whole = 2 * d * l + 1
    return 1 / (1 + l * (2 * d - m)), (1 / whole) / (1 - l * m / whole)


def _half() -> tuple[Any, Any]:
    import sympy

    D = sympy.Symbol("D", positive=True)
    return D / (2 * D + 1), (1 - 1 / (2 * D + 1)) / 2


CLAIMS: tuple[Claim, ...] = (
    Claim(
        THEOREM,
        "the normalisation of the instance",
        "Node costs (x_i + w_i)^2 and spatial costs l (x_i - x_j)^2 with l = l_S/mu are in the "
        "class with these l_S and mu",
        "up to a factor on all costs",
        (
            Counterexample(
                couplings,
                {"l": 1, "mu": 2, "l_S": 4},
                "(x+w)^2 is 2-strongly convex and no more, (x-y)^2 is 4-smooth and no less: "
                "l_S/mu = 2, twice the l that is used",
            ),
        ),
        part="class",
        kind="step",
        repaired="l = l_S/(2 mu): nearsight:ring-of-blocks",
    ),
    Claim(
        THEOREM,
        "the cost of the optimum, completed to a square",
        "|x + w|^2 + l x'Lx = |(I + l L)^{1/2} x + (I + l L)^{-1/2} w|^2 + w'(I - (I + l "
        "L)^{-1}) w",
        "",
        (Identity(_square, "in the eigenvectors of L; 1 + z = t^2, z an eigenvalue of l L"),),
        part="value",
        kind="step",
    ),
    Claim(
        EQUATION,
        "the series",
        "(I + l L)^{-1} = (1/(2dl+1)) sum_t (l/(2dl+1))^t M^t",
        "L = 2 d I - M, eigenvalues m of M at most 2d in size",
        (
            Identity(_neumann, "in the eigenvectors of M: a geometric series in l m/(2dl+1)"),
            Decision(
                ("l", "d", "m"),
                lambda l, d, m: (  # noqa: E741
                    [l >= 0, d >= 0, m <= 2 * d, m >= -2 * d],
                    l * l * m * m,
                    4 * d * d * l * l,
                ),
                "it converges: (l m)^2 <= (2dl)^2 < (2dl+1)^2",
                false=(
                    lambda l, d, m: (  # noqa: E741
                        [l >= 0, d >= 0, m <= 3 * d, m >= -3 * d],
                        l * l * m * m,
                        4 * d * d * l * l,
                    ),
                ),
            ),
        ),
        part="series",
        kind="step",
    ),
    Claim(
        EQUATION,
        "a term of the series, as powers of one number",
        "l^{kappa+2m} d^{kappa+2m}/(2dl+1)^{kappa+2m} = (1 - 1/(2dl+1))^{kappa+2m}/2^{kappa+2m}",
        "",
        (Identity(_half, "the base, D = d l"),),
        part="term",
        kind="step",
    ),
    Claim(
        EQUATION,
        "the binomial coefficient, shorter",
        "e^{-1/(6m)} sqrt((2+eps)/(1+eps)) >= 1/2",
        "m >= 1, eps >= 0",
        (
            Decision(
                ("y", "v", "q"),
                lambda y, v, q: ([y >= 0, 6 * y <= 1, v >= 1 - y, q >= 1], 1, 2 * v * q),
                "y = 1/(6m), v = e^{-y} >= 1 - y, q the root, at least 1 (5/6 would do)",
                false=(lambda y, v, q: ([y >= 0, y <= 1, v >= 1 - y, q >= 1], 1, 2 * v * q),),
            ),
        ),
        part="binomial",
        kind="step",
        uses=("lemma:combinatorial-number-near-center",),
    ),
    Claim(
        f"{EQUATION}:e4",
        "Bernoulli's inequality, twice",
        "(1-y)^p >= 1 - p y for y = 1/(2dl) and 1/(2dl+1), p = 4 sqrt(dl) + 1",
        "0 <= y < 1, p >= 1: the difference is 0 at y = 0 and has the slope p (1 - (1-y)^{p-1})",
        (
            Decision(
                ("p", "w"),
                lambda p, w: ([p >= 1, w >= 0, w <= 1], 0, p * (1 - w)),
                "w = (1-y)^{p-1}, in [0, 1] as p >= 1",
                false=(lambda p, w: ([p >= 0, w >= 0, w <= 2], 0, p * (1 - w)),),
            ),
        ),
        part="Bernoulli",
        kind="step",
    ),
    Claim(
        f"{EQUATION}:e4",
        "rounding 1/eps down",
        "1/eps = floor(2 sqrt(dl)) gives 1 - eps^2/2 >= 1 - 1/(2dl), 2/eps + 1 <= 4 sqrt(dl) + 1 "
        "and kappa/eps <= 2 kappa sqrt(dl)",
        "d l > 16",
        (
            Decision(
                ("t", "n"),
                lambda t, n: ([t > 4, n <= 2 * t, n > 2 * t - 1], t * t, n * n),
                "t = sqrt(dl), n = 1/eps: eps^2 <= 1/(dl); the other two say n <= 2t",
                false=(lambda t, n: ([t > 4, n <= 2 * t, n > t - 1], t * t, n * n),),
            ),
        ),
        part="eps",
        kind="step",
    ),
)
