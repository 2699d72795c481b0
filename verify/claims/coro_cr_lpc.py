"""``coro:CR-LPC``: the competitive ratio of LPC, as printed and repaired."""

from __future__ import annotations

from fractions import Fraction as Q
from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.search import Search, Trial
from ..engines.symbolic import Identity
from ._two_agents import TwoAgents

COROLLARY = "coro:CR-LPC"
B, FIRST, LAST = Q(6), Q(0), Q(1)


def lone_agent() -> tuple[Q, Q]:
    """Return CR of LPC with k = 2 for one agent and two steps, and 2."""
    b, first, last = B, FIRST, LAST

    def cost(x: Q, y: Q) -> Q:
        return ((x - first) ** 2 + (y - last) ** 2) / 2 + b * (x * x + (y - x) ** 2)

    def then(x: Q) -> Q:
        return (last + 2 * b * x) / (1 + 2 * b)

    lpc = (first + 2 * b * last) / (1 + 4 * b)
    # the optimum: (1 + 4b) x - 2b y = first, (1 + 2b) y - 2b x = last
    best = ((1 + 2 * b) * first + 2 * b * last) / ((1 + 4 * b) * (1 + 2 * b) - 4 * b * b)
    return cost(lpc, then(lpc)) / cost(best, then(best)), Q(2)


def star() -> tuple[Any, Any]:
    """Return 4, and the repaired bound at r = 0 for a star of degree 4000, in intervals."""
    from flint import arb, fmpq

    from ...bounds.global_bound import global_repaired
    from ...bounds.local_bound import local_repaired
    from ...bounds.ratio import Reach, ratio_parts

    degree, nothing, one = 4000, arb(0), arb(1)
    local = local_repaired(nothing, arb(fmpq(3, degree)), degree)
    p = ratio_parts(local, global_repaired(nothing), arb(4), Reach(one, one), 2, 0)
    if not p.condition <= 0.5:
        raise RuntimeError("(e2-0) does not hold")
    return arb(4), 1 + p.lateral + p.top


def _scaled() -> tuple[Any, Any]:
    """The constants of e1 and e2-0 for costs multiplied by s."""
    import sympy

    mu, l_f, l_T, l_S, s, degree = sympy.symbols("mu l_f l_T l_S s Delta", positive=True)
    C_0, C_1, rho, size = sympy.symbols("C_0 C_1 rho h", positive=True)  # of ratios only

    def weight(*given: Any) -> Any:
        m, f, t, x = given
        return 32 * C_0**2 * C_1**2 * (f + degree * x + 2 * t) * size / (m * (1 - rho) ** 2)

    return weight(mu, l_f, l_T, l_S), weight(s * mu, s * l_f, s * l_T, s * l_S)


def _networks(rng: Any) -> Trial:
    from ._networks import promised, sample

    given = sample(rng, a=(-1.5, 1.3), x=(-1.5, 1.3), k=(2, 5), H=6)
    return given.worst(), promised(COROLLARY, "repaired", given), given.about


E1 = (
    "CR <= 1 + (1 + 32 C_0^2 C_1^2 (l_f + Delta l_S + 2 l_T) h(r)^2/(mu (1-rho_G)^2 (1-rho_T)^2)) "
    "rho_S^r + (1 + 32 C_0^2 C_1^2 (l_f + Delta l_S + 2 l_T) C_3(r)^2/(mu (1-rho_G)^2)) "
    "rho_T^{k-1} if (e2-0): the history term of thm:per-step-err times C_0^2/(1-rho_G)^2 is <= 1/2"
)
PRINTED = (
    "Assumption 2.1, k >= 2, r >= 1; C_1 = 2 sqrt(Delta l_S l_T)/mu, C_0 = max(1, 2 l_T/mu), rates "
    "of thm:networked-exp-decay"
)
USES = ("coro:CR-LPC:e4", "coro:CR-LPC:e1")

CLAIMS: tuple[Claim, ...] = (
    Claim(
        COROLLARY,
        "competitive ratio of LPC with the printed constants",
        E1,
        PRINTED,
        (
            Counterexample(
                lambda: (TwoAgents(Q(5, 2)).ratio, Q(2)),
                {"l_T": 0, "l_S": 10, "k": 2, "r": 1, "H": 1, "theta": (1, -1)},
                "Two agents, mu = l_f = 1, (x_1-1)^2/2 + (x_2+1)^2/2 + (5/2)(x_1-x_2)^2: C_1 "
                "= 0, so "
                "that (e2-0) holds and (e1) is 1 + rho_S < 2 (1.7325). LPC plays -+2/3, the "
                "optimum "
                "is +-1/11, CR = 143/18 = 7.94",
            ),
        ),
        uses=("thm:per-step-err", "thm:alg-perf-bound-err-inject", *USES),
        repaired="with the repaired C_1, C_G, for k >= 2 and r >= 1: coro:CR-LPC[repaired]",
    ),
    Claim(
        COROLLARY,
        "one agent, the printed constants",
        E1 + "; without any edge C_1 = 0 and rho_S = 0",
        PRINTED,
        (
            Counterexample(
                lone_agent,
                {"b": B, "theta": (FIRST, LAST), "l_T": 24, "k": 2, "H": 2, "x_0": 0},
                "One agent, x_1^2/2 + (x_2-1)^2/2 + 6 x_1^2 + 6 (x_2-x_1)^2: C_1 = 0, and (e1) is "
                "1 + rho_T < 2. LPC sees x_2 at its target 1 and plays x_1 = 12/25",
            ),
        ),
        part="one agent",
        uses=("thm:per-step-err",),
        repaired="coro:CR-LPC[repaired]",
    ),
    Claim(
        COROLLARY,
        "radius 0, even with the repaired constants",
        E1,
        "as coro:CR-LPC[repaired], but r >= 0",
        (
            Counterexample(
                star,
                {"l_T": 0, "l_S": Q(3, 4000), "Delta": 4000, "k": 2, "r": 0, "H": 1},
                "A star with 4000 leaves, mu = l_f = 1, targets 1 at the centre and 0 at the "
                "leaves, each spatial cost (l_S/2) x_centre^2 (convex, l_S-smooth). With r = 0 the "
                "action itself is on the boundary: LPC plays the targets and pays 3/2, the optimum "
                "x = 1/4 pays 3/8, CR = 4. C_1 falls like Delta^{-1/2}: C_1^2 = 243/64000, C_0 = 2 "
                "and (e1) is 2 + 32 * 4 * 4 C_1^2 = 493/125 = 3.944",
            ),
        ),
        part="r=0",
        repaired="for r >= 1, where the local problem has a free variable: coro:CR-LPC[repaired]",
    ),
    Claim(
        COROLLARY,
        "competitive ratio of LPC, repaired",
        E1,
        "Assumption 2.1 with nonnegative costs, k >= 2, r >= 1; C_1 = (c2/2) max(a/rho_T, "
        "sqrt(Delta) a_S/rho_S), C_G = c(1+2a) a/(2 gamma_T)",
        (
            Search(
                _networks,
                "exact worst case over all data of random quadratic networks",
                quick=30,
                full=1500,
                nudge=2e-5,
            ),
        ),
        part="repaired",
        uses=("thm:per-step-err[repaired]", "thm:alg-perf-bound-err-inject", *USES),
    ),
    Claim(
        COROLLARY,
        "a ratio has no unit",
        "(e1) and (e2-0) do not change if all costs are multiplied by s > 0",
        "C_0, C_1, h, C_3 and all rates are functions of l_T/mu and Delta l_S/mu",
        (Identity(_scaled, "mu, l_f, l_T, l_S multiplied by s"),),
        part="scale",
        kind="remark",
    ),
    Claim(
        COROLLARY,
        "factors that the O(.) hides, in l_T/mu",
        "(e1) is 1 + O(h(r)^2 rho_S^r) + O(C_3(r)^2 rho_T^k) with factors polynomial in l_f/mu, "
        "l_T/mu, Delta l_S/mu",
        "",
        (
            Counterexample(
                lambda: (Q(1) / Q(1, 2000), Q(1000)),
                {"rho_T": Q(1, 2000), "largest value of the polynomial on [0, 1]": 1000},
                "(e1) holds rho_T^{k-1}, with a factor of at least 1: a polynomial p would need "
                "p(l_T/mu, ..) >= 1/rho_T, which is unbounded as l_T -> 0. For p <= M on [0, "
                "1] take "
                "rho_T = 1/(2M), l_T/mu = 2 rho_T^2/(1-rho_T^2)^2",
            ),
        ),
        part="O",
        kind="remark",
        repaired="O(C_3(r)^2 rho_T^{k-1}), as coro:CR-LPC:e1 has it",
    ),
    Claim(
        COROLLARY,
        "constants that are bounded by polynomials",
        "C_1 = 2 sqrt(x a) <= x + a and (1 - rho_T)^{-1} <= 2 + a",
        "a = l_T/mu >= 0, x = Delta l_S/mu >= 0, printed constants",
        (
            Decision(
                ("a", "x"),
                lambda a, x: ([a >= 0, x >= 0], 4 * x * a, (x + a) ** 2),
                "squared",
                false=(lambda a, x: ([a >= 0, x >= 0], 4 * x * a, x * a + a * a + x * x),),
            ),
            Decision(
                ("rho",),
                lambda rho: (
                    [rho >= 0, rho < 1],
                    (1 - rho**2) ** 2,
                    (2 * (1 - rho**2) ** 2 + 2 * rho**2) * (1 - rho),
                ),
                "a = 2 rho_T^2/(1-rho_T^2)^2, multiplied by (1 - rho_T^2)^2 (1 - rho_T)",
                false=(
                    lambda rho: (
                        [rho >= 0, rho < 1],
                        (1 - rho**2) ** 2,
                        ((1 - rho**2) ** 2 + 2 * rho**2) * (1 - rho),
                    ),
                ),
            ),
        ),
        part="polynomial",
        kind="remark",
    ),
)
