"""``thm:bottleneck``: what no algorithm beats, in time."""

from __future__ import annotations

from fractions import Fraction as Q
from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.search import Search, Trial
from ._certificate import BITS, certified

BOTTLENECK = "thm:bottleneck"


def too_large() -> tuple[Any, Any]:
    """Return the printed bound of (e2) on CR - 1 at ``l_T = mu = 1``, k = 16, and LPC's."""
    from flint import arb, ctx

    from ...bounds.lower import lambda_T_stated

    with ctx.workprec(BITS):
        mu = l_T = arb(1)
        rate = lambda_T_stated(arb(1))
        printed = mu**3 * (1 - rate.sqrt()) ** 2 / (48 * (mu + 1) ** 2 * l_T) * rate**16
        return printed, certified(Q(1), Q(0), 3, 0, 16, 1)


def constant(mu: Q, l_T: Q) -> Q:
    """Return ``mu^3/((mu+1)^2 l_T)``, the part of (e2) with units."""
    return mu**3 / ((mu + 1) ** 2 * l_T)


def known() -> tuple[Q, Q]:
    """Return the printed gap of (e1) for ``H = k = 3, L = 5/2, mu = 1, l_T = 2``, and 0."""
    root = (Q(3) - 1) / (3 + 1)  # sqrt(lambda_T) = g(4 l_T/mu), sqrt(1 + 8) = 3
    return (1 - root) ** 2 / (96 * 4) * root ** (2 * 3) * Q(5, 2), Q(0)


def _instances(rng: Any) -> Trial:
    """The proven bound beside LPC's exact worst case on the instance of the bound."""
    from ...lowerbounds.spatial import Spatial
    from ...lowerbounds.temporal import Temporal
    from ...lowerbounds.worst_case import worst_case
    from ._networks import GRAPHS

    strength = float(10 ** rng.uniform(-2, 1))
    if rng.random() < 0.5:
        k, H = int(rng.integers(1, 4)), int(rng.integers(2, 9))
        one = Temporal(strength, k, H)
        worst = worst_case(one.problem(), k, 1).cr_minus_one
        return one.cr_minus_one, worst, {"a": strength, "k": k, "H": H}
    from ...graphs import parse_graph

    name, r = str(rng.choice(GRAPHS)), int(rng.integers(0, 3))
    team = Spatial(parse_graph(name), strength, r)
    worst = worst_case(team.problem(), 2, r).cr_minus_one
    return team.cr_minus_one, worst, {"graph": name, "a_S": strength, "r": r}


CLAIMS: tuple[Claim, ...] = (
    Claim(
        BOTTLENECK,
        "lower bound in k with the printed rate",
        "CR >= 1 + mu^3 (1 - sqrt(lambda_T))^2/(48 (mu+1)^2 l_T) lambda_T^k, lambda_T = (1 - "
        "2/(sqrt("
        "1 + 4 l_T/mu) + 1))^2, for every algorithm on l_T-smooth temporal costs",
        "the class of Assumption 2.1; already without spatial costs",
        (
            Counterexample(
                too_large,
                {"mu": 1, "l_T": 1, "l_S": 0, "k": 16},
                "LPC itself is better on the whole class, any constraints and any l_f: its "
                "certificate nearsight:sharp-cr[vi], in intervals, falls like gamma_T^{2k}, "
                "gamma_T = g(2a), and lambda_T = g(4a)^2 is larger. The instance of the proof is "
                "not in the class: thm:bottleneck:e2[class]",
            ),
        ),
        uses=("thm:bottleneck:e1", "thm:bottleneck:e2[path]", "thm:bottleneck[both]"),
        repaired="lambda_T = gamma_T^2: nearsight:temporal-lower-bound",
    ),
    Claim(
        BOTTLENECK,
        "the proven rates",
        "CR - 1 >= max of final_excess(a_T, k), rate gamma_T^2, and spatial_excess(a_S, "
        "floor(Delta/2), r), rate g(2 floor(Delta/2) a_S)^2",
        "over the class of all networks of degree at most Delta, all horizons",
        (
            Search(
                _instances,
                "the bound beside LPC's exact worst case on the instances of the bound (a chain "
                "in time, one step on a network)",
                quick=60,
                full=3000,
                nudge=0.3,
            ),
        ),
        part="repaired",
        uses=("nearsight:temporal-lower-bound", "nearsight:ring-of-blocks"),
    ),
    Claim(
        "thm:bottleneck:e1",
        "an instance for every length of path",
        "for every algorithm that sees k steps and every L in (2R, RH) there is an instance with "
        "cost(ALG) - cost(OPT) >= mu^3 (1 - sqrt(lambda_T))^2/(96 (mu+1)^2) lambda_T^k R L",
        "R = 1; nothing is said about H and k",
        (
            Counterexample(
                known,
                {"mu": 1, "l_T": 2, "R": 1, "L": Q(5, 2), "H": 3, "k": 3},
                "With H <= k everything is seen at the first step, and the algorithm that "
                "plays the "
                "optimum has the gap 0; the right side is (1/4)/384 * (1/2)^6 * 5/2 > 0",
            ),
        ),
        kind="step",
        repaired="for H large against k: nearsight:temporal-lower-bound",
    ),
    Claim(
        "thm:bottleneck:e2",
        "a ratio has no unit",
        "the right side of (e2) is the same for all (mu, l_T) with the same l_T/mu",
        "mu^3/((mu+1)^2 l_T) for (1, 1) and (10, 10)",
        (
            Counterexample(
                lambda: (constant(Q(10), Q(10)), constant(Q(1), Q(1))),
                {"first": (10, 10), "second": (1, 1)},
                "All costs times 10: the ratio cost(ALG)/cost(OPT) stays, the printed factor goes "
                "from 1/4 to 100/121. The bare 1 added to mu has the unit of a cost over a square "
                "of an action",
            ),
        ),
        part="scale",
        kind="remark",
        repaired="its supremum over all scales, mu/l_T; nearsight:temporal-lower-bound has no unit",
    ),
    Claim(
        "thm:bottleneck:e2",
        "for 2 l_T-smooth costs the printed bound is below the exact one",
        "mu^3 (1-g)^2/(48 (mu+1)^2 l_T) g^{2k} <= g^{2k-1} (1+g)^2/((1+g^{2k+1}) sqrt(1+4a)), g = "
        "g(4a): the bound of nearsight:temporal-lower-bound for temporal costs (l_T/2)(x-y)^2",
        "H to infinity",
        (
            Decision(
                ("g", "W", "mu"),
                lambda g, W, mu: (
                    [g >= 0, g < 1, W >= 0, W <= 1, mu > 0],
                    mu * mu * (1 - g) ** 4 * (1 + W),
                    48 * (mu + 1) ** 2 * (1 - g) * (1 + g),
                ),
                "a = g/(1-g)^2, sqrt(1+4a) = (1+g)/(1-g), W = g^{2k+1}; divided by g^{2k-1}",
                false=(
                    lambda g, W, mu: (
                        [g >= 0, g < 1, W >= 0, W <= 1, mu > 0],
                        mu * mu * (1 - g) ** 4 * (1 + W),
                        (mu + 1) ** 2 * (1 - g) * (1 + g),
                    ),
                ),
            ),
        ),
        part="own instance",
        kind="step",
        uses=("nearsight:temporal-lower-bound",),
    ),
    Claim(
        "thm:bottleneck:e2",
        "the length of the path bounds the optimum",
        "R sum |v_t - v_{t-1}| >= sum |v_t - v_{t-1}|^2",
        "|v_t - v_{t-1}| <= R",
        (
            Decision(
                ("R", "d"),
                lambda R, d: ([d >= 0, d <= R], d * d, R * d),
                "term by term",
                false=(lambda R, d: ([d >= 0, d <= 2 * R], d * d, R * d),),
            ),
        ),
        part="path",
        kind="step",
    ),
    Claim(
        BOTTLENECK,
        "two lower bounds in one",
        "max(1 + u, 1 + v) >= 1 + u/2 + v/2",
        "u, v >= 0",
        (
            Decision(
                ("u", "v"),
                lambda u, v: ([u >= v], u + v, 2 * u),
                "u the larger one",
                false=(lambda u, v: ([u >= v, v > 0], u + v, u),),
            ),
        ),
        part="both",
        kind="step",
    ),
)
