"""``nearsight:weighted-energy``: (E), and its weights for the lateral boundary (E2)."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..claim import Claim
from ..engines.search import Search, Trial
from ..engines.symbolic import Identity
from ._sums import counted

LABEL = "nearsight:weighted-energy"


def _inner() -> tuple[Any, Any]:
    import sympy

    lam, nu, f, delta, strength = sympy.symbols("lam nu f delta l", positive=True)
    left = lam * f**2 / strength + (nu - lam) * f * delta
    left += strength * (nu - lam) ** 2 / (4 * lam) * delta**2
    return left, lam / strength * (f + strength * (nu - lam) * delta / (2 * lam)) ** 2


def _boundary() -> tuple[Any, Any]:
    import sympy

    lam, z, f, strength = sympy.symbols("lam z f l", positive=True)
    left = lam * f**2 / strength - lam * f * z + strength * lam / 4 * z**2
    return left, lam / strength * (f - strength * z / 2) ** 2


def _bulk() -> tuple[Any, Any]:
    """What two temporal and Delta spatial edges cost a vertex, over nu."""
    import sympy

    A, B, a, x = sympy.symbols("A B a x", positive=True)  # A = e^alpha, B = e^beta

    def paid(q: Any) -> Any:
        return (1 - q) ** 2 / (4 * q)

    left = a * (paid(A) + paid(1 / A)) + x * (paid(B) + paid(1 / B)) / 2
    return left, a * ((A + 1 / A) / 2 - 1) + x / 2 * ((B + 1 / B) / 2 - 1)


def _source() -> tuple[Any, Any]:
    """The discriminant at the source for the stated N, which vanishes."""
    import sympy

    A, B, e, x = sympy.symbols("A B e x", positive=True)
    X, Y = e * A + x * B, e / A + x / B
    apart = (A / B + B / A) / 2 - 1  # cosh(alpha - beta) - 1
    N = 4 * X / (4 + 4 * (e + x) - 2 * e * x * apart)
    return (1 + (e + x) / 2) ** 2, X / N * (1 + N * Y / 4)


def amplitude(a: float, a_S: float, degree: int, eta: int, k: int, r: int, share: float) -> Any:
    """Return A and ``w_j`` of the own row, in the formulas of (E2) as they are written down."""
    x = degree * a_S
    still = k == 2 or a == 0
    F, e = (0.0, 0.0) if still else (share, a)
    b = 0.5 if k == 3 else 1.0
    alpha = 0.0 if still else float(np.arccosh(1 + F / (b * a)))
    beta = float(np.arccosh(1 + 2 * (1 - F) / x))
    X = e * np.exp(alpha) + x * np.exp(beta)
    below = 4 + 4 * (e + x) - 2 * e * x * (np.cosh(alpha - beta) - 1)
    if below <= 0:
        return np.inf, np.ones(k - 1)
    weights = np.exp(-2 * alpha * np.arange(k - 1))
    return a_S * eta / 4 * 4 * X / below * np.exp(-beta * (2 * r - 1)), weights


def _lateral(rng: np.random.Generator) -> Trial:
    """Largest ``sum_v |delta_(t,v)|^2`` over all lateral perturbations of weighted size 1."""
    from ._networks import sample
    from ._window import step_map

    given = sample(rng, a=(-2, 0.5), x=(-2, 1), k=(2, 5), H=6)
    p, k, r, N = given.parameters, given.k, given.r, given.problem.N
    if p.l_S == 0:
        return 0.0, 1.0, given.about
    share = float(rng.uniform(0.05, 0.95))
    growth = given.growth
    A, weights = amplitude(p.l_T, p.l_S, growth.max_degree, growth.eta(r), k, r, share)
    moved = step_map(given.problem, k, r)[1]
    total = np.zeros((N, N))
    for j in range(min(k - 1, given.problem.H)):
        part = moved[:, j * N : (j + 1) * N]  # only the top lies at j = k - 1
        total += part @ part.T / weights[j]
    return float(np.linalg.eigvalsh(total)[-1]), float(A), {**given.about, "F": share}


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "weighted energy (E)",
        "if nu_i - 1[i in source] >= sum_e l_e (nu_i - lam_e)^2/(4 lam_e) at every free i, then "
        "sum_source |delta|^2 <= sum_boundary (l_e lam_e/4) |dz_e|^2 (mu = 1)",
        "two solutions of a local problem, closed convex product sets, convex l_e-smooth "
        "pair costs, "
        "nu, lam > 0",
        (
            Identity(
                _inner,
                "Sum nu_i <gradient difference_i, delta_i> <= 0; on an edge lam <xi, f> >= lam "
                "|f|^2/l (Baillon, Haddad), and what is left at either end is a square: lam "
                "f^2/l + "
                "(nu - lam) f delta + l (nu-lam)^2/(4 lam) delta^2",
            ),
            Identity(
                _boundary,
                "at the fixed end of a boundary edge: lam f^2/l - lam f dz + (l lam/4) dz^2 is a "
                "square",
            ),
        ),
    ),
    Claim(
        LABEL,
        "weights away from the source",
        "with nu = N e^{-2 alpha |tau-t0| - 2 beta d} and geometric means for lam a vertex "
        "pays b a "
        "(cosh alpha - 1) + (x/2)(cosh beta - 1) = F + (1 - F) = 1 times nu",
        "cosh alpha = 1 + F/(b a), cosh beta = 1 + 2(1-F)/x; b = 1 with two temporal edges",
        (Identity(_bulk, "A = e^alpha, B = e^beta; half of the spatial edges either way"),),
        part="bulk",
        kind="step",
        uses=(LABEL,),
    ),
    Claim(
        LABEL,
        "the weight at the source",
        "nu_0 - 1 >= e (nu_0 - lam_T)^2/(4 lam_T) + x' (nu_0 - lam_S)^2/(4 lam_S), lam_T = N "
        "e^{-alpha}, lam_S = N e^{-beta}, has a solution for N = 4X/(4 + 4(e+x') - 2 e x' "
        "(cosh(alpha-beta) - 1))",
        "X = e e^alpha + x' e^beta, the denominator positive",
        (
            Identity(
                _source,
                "(X/(4N)) nu_0^2 - (1 + (e+x')/2) nu_0 + 1 + (N/4)(e e^{-alpha} + x' "
                "e^{-beta}) <= 0 "
                "has discriminant 0",
            ),
        ),
        part="source",
        kind="step",
        uses=(LABEL,),
    ),
    Claim(
        LABEL,
        "the lateral boundary (E2)",
        "sum_v |delta_(t,v)|^2 <= A sum_j w_j |dz_{t+j}|^2, A = (a_S eta_r/4) N "
        "e^{-beta(2r-1)}, w_j "
        "= e^{-2 alpha j}",
        "Assumption 2.1, closed convex product sets, k >= 2, r >= 1, any share F in (0, 1); "
        "the row "
        "of the agent itself",
        (
            counted(
                "eta_r",
                "(E) with nu = N e^{-2 alpha |tau-t| - 2 beta d(u,v)} and geometric means for lam: "
                "what it asks for is [bulk] away from the source and [source] there; an edge to "
                "the boundary carries lam = N e^{-2 alpha j} e^{-beta (2r-1)} and pays (a_S "
                "lam/4)|dz|^2, edges to what stays take lam = nu; summed over v a boundary agent "
                "occurs once for each edge that leads to it from distance r - 1 of a v at "
                "distance r",
            ),
            Search(
                _lateral,
                "largest lateral sensitivity of random quadratic networks, random shares",
                quick=60,
                full=4000,
                nudge=0.9,
            ),
        ),
        part="E2",
        uses=(LABEL, f"{LABEL}[bulk]", f"{LABEL}[source]"),
    ),
)
