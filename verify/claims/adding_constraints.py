"""``apx:adding-constraints``: logarithmic barriers."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.search import Search, Trial
from ._sampled import seed_of

LABEL = "apx:adding-constraints"


def cube(y: Fraction) -> Fraction:
    """Return ``max(|y| - 1, 0)^3``: convex, C^2, at most 0 on [-1, 1], never below."""
    return max(abs(y) - 1, Fraction(0)) ** 3


def _slater() -> tuple[Fraction, Fraction]:
    grid = [Fraction(i, 100) for i in range(-200, 201)]
    return Fraction(1), Fraction(sum(cube(y) < 0 for y in grid))


def _on_the_boundary() -> tuple[Fraction, Fraction]:
    theta = max(Fraction(-1), Fraction(0))  # minimiser of (y+1)^2/2 over y >= 0, g(y) = -y
    return Fraction(1), Fraction(int(theta > 0))


def _barrier(rng: np.random.Generator) -> Trial:
    """``(mu/2)(y - theta)^2`` on an interval, several linear constraints, by bisection."""
    m, mu, theta = int(rng.integers(1, 5)), float(10 ** rng.uniform(-1, 1)), float(rng.normal())
    weight = float(10 ** rng.uniform(-8, 0))
    slopes = rng.choice([-1.0, 1.0], m) * 10 ** rng.uniform(-1, 1, m)
    limits = np.abs(slopes) * rng.choice([theta * 0 + 1.0, abs(theta), 0.1], m)  # g = s y - b
    edge = limits / slopes
    low = max([float(e) for e, s in zip(edge, slopes, strict=True) if s < 0], default=-np.inf)
    high = min([float(e) for e, s in zip(edge, slopes, strict=True) if s > 0], default=np.inf)
    if low > high - 1e-9:
        return 0.0, 1.0, {}
    best = float(np.clip(theta, low, high))
    left, right = max(low, best - 1e4), min(high, best + 1e4)
    for _ in range(200):
        y = 0.5 * (left + right)
        with np.errstate(divide="ignore"):
            slope = mu * (y - theta) + weight * float((slopes / (limits - slopes * y)).sum())
        left, right = (y, right) if slope < 0 else (left, y)
    about = {"m": m, "mu": mu, "theta": theta, "barrier": weight}
    return abs(0.5 * (left + right) - best), float(np.sqrt(m * weight / mu)), about


def _jump(rng: np.random.Generator) -> Trial:
    """A whole boundary of a problem with boxes moves at once."""
    from ...bounds import Parameters
    from ...graphs import parse_graph
    from ...perturbation import Spec
    from ...perturbation.promised import TIERS

    seed = seed_of(rng)
    graph = str(rng.choice(["ring:7", "path:5", "star:5", "grid:3x3"]))
    mu, l_T, l_S = (float(z) for z in 10 ** rng.uniform([-0.5, -1, -1], [0.5, 1, 1]))
    spec = Spec(
        parse_graph(graph), Parameters(mu, 2 * mu, l_T, l_S), 3, 2, box=(-0.6, 0.5), seed=seed
    )
    ratio = float(spec.cells(0)[-len(TIERS) :][TIERS.index("repaired")])
    return ratio, 1.0, {"graph": graph, "seed": seed, "mu": mu, "l_T": l_T, "l_S": l_S}


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "a nonempty interior makes the barrier finite somewhere",
        "If int D is not empty, D = {g_i <= 0} with g_i convex and C^2, then -ln(-g_i) is finite "
        "at some point, so that psi(.; mu) is defined.",
        "Assumption 2.1",
        (
            Counterexample(
                _slater,
                {"g": "max(|y|-1, 0)^3", "D": [-1, 1]},
                "g is convex and C^2 (g'' = 6 max(|y|-1, 0)), D = [-1, 1] has interior points, and "
                "g >= 0 everywhere as the cube of a number >= 0: at no point is g < 0; one is "
                "needed, none is there (looked at: 401 points of [-2, 2])",
            ),
        ),
        repaired=f"{LABEL}[a] with a Slater point g < 0; {LABEL}[r] without.",
    ),
    Claim(
        LABEL,
        "minimisers with a barrier converge",
        "With a Slater point the minimiser with barrier weight e is within sqrt(m e/mu) of the "
        "constrained one (m constraints).",
        "mu-strongly convex f, convex g_1..g_m, a point with g < 0",
        (
            Decision(
                ("value", "least", "m", "e", "mu", "d"),
                lambda value, least, m, e, mu, d: (
                    [
                        2 * least >= 2 * value - 2 * m * e + mu * d * d,
                        2 * value >= 2 * least + mu * d * d,
                    ],
                    mu * d * d,
                    m * e,
                ),
                "f + sum_i lam_i g_i with lam_i = e/(-g_i(y_e)) is mu-strongly convex and least at "
                "y_e, where it is f(y_e) - m e, and at most f at the optimum y*; and f(y_e) >= "
                "f(y*) + (mu/2) d^2 as y* is optimal among the feasible; d = |y_e - y*|, both "
                "times 2",
                false=(
                    lambda value, least, m, e, mu, d: (
                        [
                            2 * least >= 2 * value - 2 * m * e + mu * d * d,
                            2 * value >= 2 * least,
                        ],
                        mu * d * d,
                        m * e,
                    ),
                ),
            ),
            Search(
                _barrier,
                "one number, 1 to 4 linear constraints, weights from 1e-8 to 1",
                nudge=0.8,
                rounding=1e-6,
            ),
        ),
        part="a",
        kind="step",
        uses=(f"{LABEL}[d]",),
    ),
    Claim(
        LABEL,
        "the barrier problem at LPC's own boundary values",
        "The objective with B_tau^u summed over all u in N_v^r is finite somewhere, for z_tau^u = "
        "argmin over D of f.",
        "D = [0, oo), g(y) = -y, f(y) = (y+1)^2/2",
        (
            Counterexample(
                _on_the_boundary,
                {"g": "-y", "f": "(y+1)^2/2", "z": 0},
                "the minimiser 0 lies on the boundary of D: the fixed term -ln(-g(0)) is infinite "
                "whatever the free actions are. One finite term is needed, none is there",
            ),
        ),
        part="b",
        kind="step",
        repaired=f"{LABEL}[r]: barriers (or penalties) of free actions only, as node costs in "
        "equ:LPC-opt-problem are those of N_v^(r-1).",
    ),
    Claim(
        LABEL,
        "the barrier problem's spatial costs",
        "The printed objective, with spatial costs of x_t^u, x_t^q (time t) in the sum over tau, "
        "couples agents at as many steps as equ:LPC-opt-problem.",
        "k = 3",
        (
            Counterexample(
                lambda: (Fraction(2), Fraction(1)),
                {"k": 3, "free steps": ["t", "t+1"]},
                "two free steps are coupled in space there, one here (k times over)",
            ),
        ),
        part="c",
        kind="step",
        repaired=f"{LABEL}[r]: s_tau^(u,q)(x_tau^u, x_tau^q).",
    ),
    Claim(
        LABEL,
        "one barrier, by hand",
        "(y - theta)^2/2 - e ln(-y): |y_e - min(theta, 0)| <= sqrt(e).",
        "e > 0",
        (
            Decision(
                ("theta", "e"),
                lambda theta, e, w: ([theta >= 0, e > 0], (w - theta) * (w - theta), 4 * e),
                "y_e = (theta - w)/2 with w = sqrt(theta^2 + 4e); for theta < 0 the distance is "
                "(w - |theta|)/2 as well",
                roots={"w": lambda theta, e: theta * theta + 4 * e},
                false=(
                    lambda theta, e, w: ([theta >= 0, e > 0], (w - theta) * (w - theta), 3 * e),
                ),
            ),
        ),
        part="d",
        kind="step",
    ),
    Claim(
        LABEL,
        "constraints do no harm",
        "The mended local bound holds for products of convex sets, without any Slater point.",
        "Assumption 2.1, any closed convex D",
        (
            Search(
                _jump,
                "random local problems with boxes that bind at some boundary values, whole "
                "boundaries moved at once",
                quick=15,
                full=600,
                nudge=0.1,
            ),
        ),
        part="r",
        uses=("thm:networked-exp-decay[r]",),
    ),
)
