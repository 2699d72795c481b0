"""``thm:spatial_lower_bound``: what no algorithm beats, in space."""

from __future__ import annotations

from fractions import Fraction as Q
from typing import Any

import numpy as np

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.search import Search, Trial
from ._certificate import BITS, certified

THEOREM = "thm:spatial_lower_bound"
WEAK = Q(1, 100)  # Delta l_S/mu
CONSTANT = Q(1, 10**30)


def too_large() -> tuple[Any, Any]:
    """Return ``1e-30 lambda_S^20`` and LPC's certificate on all graphs of degree 3, k = 2."""
    from flint import arb, ctx, fmpq

    from ...graphs import parse_growth

    tree = parse_growth("tree:3")  # h and eta are the largest possible
    rate = WEAK / (3 + 3 * WEAK)
    with ctx.workprec(BITS):
        value = CONSTANT * rate**20
        printed = arb(fmpq(value.numerator, value.denominator))
        return printed, certified(Q(0), WEAK / 3, 3, int(tree.eta(20)), 2, 20)


def variance() -> tuple[Q, Q]:
    """Return ``1e-6 lambda_S^20`` and the exact variance of (e2) on the ring, d = 1, l = 5/16.

    ``s = sqrt(1+4l) = 3/2, q = (s-1)/(s+1) = 1/5``, two vertices at each distance: ``sum_{j
    beyond 20} B_ij^2 = 2 q^42/(s^2 (1-q^2))``.
    """
    x, q, s = 3 * Q(5, 16), Q(1, 5), Q(3, 2)
    rate = x / (3 + 3 * x)
    return Q(1, 10**6) * rate**20, 2 * q**42 / (s * s * (1 - q * q))


def _policies(rng: Any) -> Trial:
    """``sum_{j outside} B_ij^2`` beside the error of one agent's linear policy."""
    from ...graphs import parse_graph
    from ...lowerbounds.spatial import Spatial
    from ._networks import GRAPHS

    name, r = str(rng.choice(GRAPHS)), int(rng.integers(0, 3))
    network, a_S = parse_graph(name), float(10 ** rng.uniform(-2, 1))
    spatial = Spatial(network, a_S, r)
    i = int(rng.integers(network.vertices))
    unit = np.zeros(network.vertices)
    unit[i] = 1.0
    row, seen = -spatial.system.solve(unit), spatial.seen(np.array([i]))[0]
    policy = np.zeros(len(row))
    policy[seen] = row[seen] * (1 + rng.choice([0.0, 1e-3, 1.0]) * rng.normal(size=len(seen)))
    outside = np.delete(row, seen)
    about = {"graph": name, "a_S": a_S, "r": r, "agent": i}
    return float(outside @ outside), float(((policy - row) ** 2).sum()), about


LAMBDA = "lambda_S = x/(3+3x), from x = 48 on the larger of it and (1 - 4 sqrt(3)/sqrt(x))^2"

CLAIMS: tuple[Claim, ...] = (
    Claim(
        THEOREM,
        "lower bound in r with the printed rate",
        f"CR >= 1 + c lambda_S^r with c > 0 that does not depend on r; {LAMBDA}, x = Delta l_S/mu",
        "the class of all networks of degree at most Delta, Delta >= 3",
        (
            Counterexample(
                too_large,
                {"Delta": 3, "x": WEAK, "l_T": 0, "k": 2, "r": 20, "c": CONSTANT},
                "LPC itself is better on every network of degree 3: its certificate "
                "nearsight:sharp-cr[vi], in intervals, with the eta of the 3-regular tree, falls "
                "like (2 g(x)^2)^r, and lambda_S is x/3 for small x. Here c = 1e-30; a smaller c "
                "takes a larger r. The proof squares an entry of the inverse, but not its rate",
            ),
        ),
        uses=(
            "thm:spatial_lower_bound:e2",
            "thm:spatial_lower_bound:e4",
        ),
        repaired="lambda_S = g(2 floor(Delta/2) l_S/mu)^2: nearsight:ring-of-blocks",
    ),
    Claim(
        "thm:spatial_lower_bound:decay_factor",
        "the printed rate for strong couplings",
        f"{LAMBDA}: at most g(2 floor(Delta/2) l_S/mu)^2, the proven rate, for x >= 18",
        "Delta >= 3, so that 2 floor(Delta/2) >= 2 Delta/3",
        (
            Decision(
                ("x",),
                lambda x, s: ([x >= 18], x * (s + 1) ** 2, (3 + 3 * x) * (s - 1) ** 2),
                "x/(3+3x) <= g(2x/3)^2 with s = sqrt(1 + 2x/3), for x >= 18 (17.53 is the "
                "threshold "
                "for Delta = 3)",
                roots={"s": lambda x: 1 + 2 * x / 3},
                false=(lambda x, s: ([x >= 16], x * (s + 1) ** 2, (3 + 3 * x) * (s - 1) ** 2),),
            ),
            Decision(
                ("x",),
                lambda x, s: ([x >= 48], 4 * x, 48 * (s + 1) ** 2),
                "1 - sqrt(48/x) <= 1 - 2/(s+1) = g(2x/3), squared",
                roots={"s": lambda x: 1 + 2 * x / 3},
                false=(lambda x, s: ([x >= 48], 4 * x, 4 * (s + 1) ** 2),),
            ),
        ),
        kind="remark",
        uses=("nearsight:ring-of-blocks",),
    ),
    Claim(
        THEOREM,
        "the minimiser",
        "x* = (I + l L)^{-1} w minimises |x + w|^2 + l x'Lx",
        "",
        (
            Counterexample(
                lambda: (Q(4), Q(0)),
                {"agents": 1, "w": 1},
                "One agent, L = 0: (x + w)^2 at the printed x* = w = 1 is 4, and 0 at x = -1",
            ),
        ),
        part="minimiser",
        kind="step",
        repaired=f"x* = -(I + l L)^{{-1}} w; nothing else changes: {THEOREM}[value]",
    ),
    Claim(
        THEOREM,
        "the optimum does not vanish",
        "P(cost(OPT) = 0) = 0 for w_i independent with any mean-zero distribution",
        "",
        (
            Counterexample(
                lambda: (Q(1, 4), Q(0)),
                {"agents": 2, "w": "0 with probability 1/2, else a standard normal number"},
                "Mean zero, support all of R. Two joined agents: cost(OPT) = 0 if both are 0, "
                "with probability 1/4",
            ),
        ),
        part="atoms",
        kind="step",
        repaired="for distributions without atoms; or compare expectations only, as "
        "nearsight:team-lower-bound does",
    ),
    Claim(
        "thm:spatial_lower_bound:e1",
        "what an agent does not see",
        "E|x_i - x_i*|^2 >= sum_{j beyond r} B_ij^2 Var(w_j)",
        "w independent with mean zero, x_i a function of w within distance r (the first sign is "
        "printed as an equality)",
        (
            Decision(
                ("off", "cross", "unseen"),
                lambda off, cross, unseen: (
                    [off >= 0, cross == 0],
                    unseen,
                    off - 2 * cross + unseen,
                ),
                "x_i - x_i* is a function of what is seen, of mean square off, minus the sum over "
                "j beyond r, of variance unseen; independence and mean zero make the mean of their "
                "product, cross, vanish",
                false=(lambda off, cross, unseen: ([off >= 0], unseen, off - 2 * cross + unseen),),
            ),
            Search(
                _policies,
                "linear policies, the best one among them, on small networks",
                quick=200,
                full=5000,
                nudge=0.99,
            ),
        ),
        kind="step",
    ),
    Claim(
        "thm:spatial_lower_bound:e2",
        "the variance",
        "sum_{j beyond r} B_ij^2 >= c lambda_S^r with c > 0 that does not depend on r",
        "the ring of blocks with d = floor(Delta/2), l = l_S/mu",
        (
            Counterexample(
                variance,
                {"Delta": 3, "d": 1, "l": Q(5, 16), "x": Q(15, 16), "r": 20, "c": Q(1, 10**6)},
                "sqrt(1 + 4 d l) = 3/2: B_ij = (2/3) 5^{-kappa} exactly, so that the sum is "
                "2 q^42 / "
                "(s^2 (1-q^2)) with q = 1/5, s = 3/2, and q^2 = 1/25 < lambda_S = 5/31",
            ),
        ),
        kind="step",
        uses=("thm:spatial_lower_bound:e1", "lemma:inverse-graph-lower-bound"),
        repaired="with the square of the rate of an entry: g(4 d l)^{2r}, "
        "nearsight:ring-of-blocks[entries]",
    ),
    Claim(
        "thm:spatial_lower_bound:e3",
        "the cost of the optimum",
        "E cost(OPT) = sum_i (1 - B_ii) Var(w_i) <= n Var",
        "B = (I + l L)^{-1}: eigenvalues 1/(1+z), z >= 0",
        (
            Decision(
                ("z", "b"),
                lambda z, b: ([z >= 0, b * (1 + z) == 1], 1 - b, 1),
                "eigenvalue by eigenvalue",
                false=(lambda z, b: ([z >= 0, b * (1 + z) == 1], 1 + b, 1),),
            ),
        ),
        kind="step",
    ),
    Claim(
        "thm:spatial_lower_bound:e4",
        "strong convexity",
        "cost(ALG) - cost(OPT) = |x - x*|^2_{I + l L} >= |x - x*|^2/2 (the cost is 2-strongly "
        "convex, not 1)",
        "",
        (
            Decision(
                ("z", "l", "y"),
                lambda z, l, y: ([z >= 0, l >= 0], y * y, 2 * (1 + l * z) * y * y),  # noqa: E741
                "in the eigenvectors of L, z an eigenvalue, y a coefficient of x - x*",
                false=(
                    lambda z, l, y: ([z >= 0, l >= 0], 2 * y * y, (1 + l * z) * y * y),  # noqa: E741
                ),
            ),
        ),
        kind="step",
        uses=("thm:spatial_lower_bound:e2", "thm:spatial_lower_bound:e3"),
    ),
)
