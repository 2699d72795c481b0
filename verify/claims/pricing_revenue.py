"""``le:cr-rev``: what a competitive ratio in cost says about revenue."""

from __future__ import annotations

from fractions import Fraction as Q
from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample

LEMMA = "le:cr-rev"


def give_away(eta: Q, b: Q, x_0: Q = Q(0), cap: Q | None = None, products: int = 2) -> tuple[Q, Q]:
    """Return the promised share of the revenue, and that of giving everything away, 0.

    H = 1, ``a = k = 1``, equal products, joined if there are two. The algorithm that plays prices
    0 costs exactly CR times the optimum.
    """
    joined = eta * (products - 1)
    xi = 1 - joined - b / 2
    price = (1 + b * x_0) / (2 * (1 + joined))
    price = price if cap is None else min(price, cap)
    best = products * price * (1 + b * x_0 - (1 + joined) * price)
    constant = products * (1 / (4 * xi) + b * x_0**2 / 2)
    cr = constant / (constant - best)
    mu, l_f = 2 * xi, Q(2)
    lemma = max(2 * (l_f + joined) / mu, (1 / cap if cap else Q(0)) / mu)
    return 1 - lemma / 2 * (cr - 1), Q(0)


def _share(factor: int) -> Any:
    """Return the statement ``a^2/(4 xi) <= factor s^2/(4 mu (s - K)) (a^2/s)(1 - K/s)``."""

    def statement(a: Any, xi: Any, mu: Any) -> tuple[list[Any], Any, Any]:
        return [a > 0, mu > 0, 2 * xi >= mu], a * a * mu, factor * a * a * xi

    return statement


RATIO = "rev(ALG)/rev(OPT) >= 1 - (eta/2)(CR - 1), eta = max(2 (l_f + Delta b~ gamma)/mu, c~/mu)"
HYPOTHESES = "the assumptions of the pricing example, cost(ALG) <= CR cost(OPT)"

CLAIMS: tuple[Claim, ...] = (
    Claim(
        LEMMA,
        "from cost to revenue",
        RATIO,
        HYPOTHESES,
        (
            Counterexample(
                lambda: give_away(Q(9, 10), Q(1, 10)),
                {"N": 2, "H": 1, "a": 1, "k": 1, "eta": Q(9, 10), "b": Q(1, 10), "x_0": 0},
                "Two complements, xi = 1/20, mu = 1/10, l_f = 2: cost(OPT) = 185/19, giving "
                "everything "
                "away costs 10, CR = 38/37, and earns nothing; the lemma has eta = 58 and promises "
                "8/37",
            ),
            Counterexample(
                lambda: give_away(Q(0), Q(9, 5), cap=Q(1, 4), products=1),
                {"N": 1, "H": 1, "a": 1, "k": 1, "b": Q(9, 5), "x_0": 0, "cap": Q(1, 4)},
                "One product, no edge, a cap that binds: xi = 1/10",
            ),
        ),
        kind="lemma",
        uses=(f"{LEMMA}[C]", f"{LEMMA}[last]", "eq:CR-cost-revenue"),
        repaired="1 - (F - 1)(CR - 1), F = s^2/(2 mu (s-K)), for x_0 = 0: le:cr-rev[repaired]",
    ),
    Claim(
        LEMMA,
        "prices before the first step",
        RATIO,
        HYPOTHESES + ", x_0 > 0; C = sum a^2/(4 xi) as printed",
        (
            Counterexample(
                lambda: give_away(Q(0), Q(1, 2), x_0=Q(10), cap=Q(10), products=1),
                {"N": 1, "H": 1, "a": 1, "k": 1, "b": Q(1, 2), "x_0": 10, "cap": 10},
                "One product: b_1 x_0^2/2 = 25 is missing in C",
            ),
        ),
        part="x_0",
        kind="lemma",
        uses=("apx:application#equivalence",),
        repaired="for x_0 = 0, le:cr-rev[repaired]; else with sum_v b_1 x_0^2/2 in C, by "
        "apx:application#equivalence[repaired]",
    ),
    Claim(
        LEMMA,
        "from cost to revenue, repaired",
        "rev(ALG)/rev(OPT) >= 1 - (F - 1)(CR - 1), F = s^2/(2 mu (s - K)), K = max k + Delta b~ "
        "max(eta, 0), s = max(2K, c~)",
        HYPOTHESES + ", x_0 = 0, b_{H+1} = 0",
        (
            Decision(
                ("CR", "C", "R", "alg", "F"),
                lambda CR, C, R, alg, F: (
                    [CR >= 1, R > 0, C <= F * R, C - alg <= CR * (C - R)],
                    R - (F - 1) * (CR - 1) * R,
                    alg,
                ),
                "cost = C - revenue, C <= F rev(OPT); multiplied by R = rev(OPT)",
                false=(
                    lambda CR, C, R, alg, F: (
                        [CR >= 1, R > 0, C <= F * R, C - alg <= CR * (C - R)],
                        2 * R - (F - 1) * (CR - 1) * R,
                        2 * alg,
                    ),
                ),
            ),
        ),
        part="repaired",
        kind="lemma",
        uses=(f"{LEMMA}[demand]", f"{LEMMA}[C repaired]", "apx:application#equivalence[repaired]"),
    ),
    Claim(
        LEMMA,
        "the demand at the safe prices",
        "a - (k + Delta b~ gamma) a/(eta mu) >= a/2 at prices a/(eta mu)",
        "k <= l_f/2, |eta| <= gamma, a^u <= b~ a^v; at step 1 with b_1 x_0 >= 0 in place of b_1 "
        "a_0/(eta mu)",
        (
            Decision(
                ("a", "k", "l_f", "edges", "p"),
                lambda a, k, l_f, edges, p: (
                    [a > 0, k > 0, 2 * k <= l_f, edges >= 0, p >= 2 * (l_f + edges)],
                    a * p,
                    2 * (a * p - (k + edges) * a),
                ),
                "p = eta mu >= 2 (l_f + Delta b~ gamma), edges = Delta b~ gamma; multiplied by 2 p",
                false=(
                    lambda a, k, l_f, edges, p: (
                        [a > 0, k > 0, 2 * k <= l_f, edges >= 0, p >= l_f],
                        a * p,
                        2 * (a * p - (k + edges) * a),
                    ),
                ),
            ),
        ),
        part="demand",
        kind="step",
    ),
    Claim(
        LEMMA,
        "the revenue of the safe prices",
        "sum (a/(eta mu)) (a/2) >= (2/eta) C, C = sum a^2/(4 xi)",
        "xi >= mu/2",
        (
            Decision(
                ("xi", "mu"),
                lambda xi, mu: ([mu > 0, 2 * xi >= mu], mu, xi),
                "term by term a^2/(2 eta mu) >= a^2/(2 eta xi), that is xi >= mu",
            ),
        ),
        part="C",
        kind="step",
        uses=(f"{LEMMA}[demand]",),
        repaired="C/eta, twice less: le:cr-rev[C repaired]",
    ),
    Claim(
        LEMMA,
        "the revenue of the safe prices, repaired",
        "sum (a/(eta mu)) (a/2) >= C/eta; and with s, K: sum (a/s)(a - K a/s) >= C/F",
        "xi >= mu/2, F = s^2/(2 mu (s-K))",
        (
            Decision(
                ("a", "xi", "mu"),
                _share(2),
                "term by term a^2/(4 xi) <= a^2/(2 mu)",
                false=(_share(1),),
            ),
        ),
        part="C repaired",
        kind="step",
        uses=(f"{LEMMA}[demand]",),
    ),
    Claim(
        "eq:CR-cost-revenue",
        "from cost to revenue",
        "CR (C - rev(OPT)) >= C - rev(ALG) gives (CR - 1) C >= CR rev(OPT) - rev(ALG)",
        "cost = C - revenue",
        (
            Decision(
                ("CR", "C", "R", "alg"),
                lambda CR, C, R, alg: ([C - alg <= CR * (C - R)], CR * R - alg, (CR - 1) * C),
                "rearranged",
                false=(lambda CR, C, R, alg: ([C - alg <= CR * (C - R)], CR * R, (CR - 1) * C),),
            ),
        ),
        kind="step",
        uses=("apx:application#equivalence",),
    ),
    Claim(
        LEMMA,
        "the last lines",
        "(CR - 1) C >= CR rev(OPT) - rev(ALG) gives rev(ALG)/rev(OPT) >= 1 - (CR - 1) C/rev(OPT)",
        "CR >= 1, rev(OPT) > 0",
        (
            Decision(
                ("CR", "C", "R", "alg"),
                lambda CR, C, R, alg: (
                    [CR >= 1, R > 0, C - alg <= CR * (C - R)],
                    R - (CR - 1) * C,
                    alg,
                ),
                "multiplied by rev(OPT)",
                false=(
                    lambda CR, C, R, alg: (
                        [CR >= 1, R > 0, C - alg <= CR * (C - R)],
                        2 * R - (CR - 1) * C,
                        alg,
                    ),
                ),
            ),
        ),
        part="last",
        kind="step",
    ),
)
