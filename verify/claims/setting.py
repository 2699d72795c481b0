"""What the setting and the abstract say: partial costs, the horizon, optimality, growth."""

from __future__ import annotations

from fractions import Fraction as Q

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ._sums import terms

PERTURB = "sec:main:perturb#optimality"


def partial_cost() -> tuple[Q, Q]:
    """Return ``f^S`` by the text and by the notation table: S one end of an edge."""
    edge = Q(2 - 0) ** 2 / 4  # s = (x_v - x_u)^2/4 at x_v = 0, x_u = 2; it lies in E(S_+)
    return edge, Q(0)  # and not in E(S)


def tree(r: int) -> int:
    """Return ``h(r) = 3 * 2^(r-1)`` of the infinite tree of degree 3."""
    return 3 << (r - 1)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        "eq:partial-costs",
        "partial costs, by the text and by the notation table",
        "f_t^S with the edges E(S_+) of the text is f_t^S with the edges E(S) of the table.",
        "two agents v - u, S = {v}, no node cost",
        (
            Counterexample(
                partial_cost,
                {"s": "(x_v - x_u)^2/4", "x_v": 0, "x_u": 2},
                "the edge has one end in S, so the text counts its cost 1 and the table does not. "
                "With E(S) no local problem would depend on its lateral boundary",
            ),
        ),
        kind="definition",
        repaired="E(S_+), as in the text and in what an agent is told: equ:LPC-opt-problem counts "
        "the edges E(N_v^r), and sec:main:perturb#optimality needs them.",
    ),
    Claim(
        "sec:look-ahead-and-communication#horizon",
        "steps past the horizon",
        "f = (mu/2)|x|^2, c = s = 0 and D = R^n for t > H leave the problem as it is: the added "
        "steps cost at least 0, and 0 at x = 0.",
        "mu > 0",
        (
            Decision(
                ("cost", "opt", "mu", "x"),
                lambda cost, opt, mu, x: ([mu > 0, cost >= opt], 2 * opt, 2 * cost + mu * x * x),
                "cost of the steps up to H and (mu/2) x^2 for one more, times 2; equality at the "
                "optimum and x = 0",
                false=(lambda cost, opt, mu, x: ([cost >= opt], 2 * opt, 2 * cost + mu * x * x),),
            ),
        ),
        kind="remark",
    ),
    Claim(
        PERTURB,
        "the principle of optimality",
        "If the boundary of psi_(t,v)^(k,r) holds the optimal actions (or those of the optimal "
        "continuation from x_(t-1)) then psi_(t,v)^(k,r) returns the optimal ones inside.",
        "Assumption 2.1; every cost of a free action is in the local objective",
        (
            Decision(
                ("inside", "other", "outside"),
                lambda inside, other, outside: (
                    [inside + outside <= other + outside],
                    inside,
                    other,
                ),
                "whole cost = costs of free actions + costs that do not change with them; another "
                "choice of the free actions makes no less of the sum, so no less of the first "
                "part. The minimiser is unique by strong convexity",
                false=(
                    lambda inside, other, outside: (
                        [inside + outside <= other + outside + 1],
                        inside,
                        other,
                    ),
                ),
            ),
        ),
        kind="remark",
        uses=("sec:look-ahead-and-communication#horizon",),
    ),
    Claim(
        "sec:main:CR#grid",
        "grids grow like a polynomial",
        "h(r) <= 2 (2r+1)^(m-1) on a grid of dimension m.",
        "m >= 1, r >= 0",
        (
            terms(
                "h_1 <= 2, and h_m(r) = sum_(|j| <= r) h_(m-1)(r - |j|) has 2r + 1 terms of at "
                "most B = 2 (2r+1)^(m-2); S is the sum of the first n"
            ),
        ),
        kind="remark",
    ),
    Claim(
        "abstract#ratio",
        "the ratio without any condition on growth",
        "The ratio is 1 + O~(rho_T^k) + O~(rho_S^r), O~ hiding factors polynomial in k and r: "
        "h(r)^2 rho_S^r = O~(rho_S^r).",
        "bounded degree; what coro:CR-LPC gives",
        (
            Counterexample(
                lambda: (Q(tree(20) ** 2), Q(1000 * 20**4)),
                {"graph": "tree of degree 3", "r": 20, "hidden factor": "1000 r^4"},
                "h(20)^2 = (3 * 2^19)^2 = 2.5e12, over 1.6e8; the factor is exponential in r, for "
                "other polynomials take a larger r. (That the bound does not say it, not that "
                "the ratio is larger)",
            ),
        ),
        kind="remark",
        uses=("coro:CR-LPC",),
        repaired="h(r)^2 rho_S^r as in coro:CR-LPC; without h where it grows slowly: "
        "sec:main:CR#iota[repaired], sec:main:CR#grid.",
    ),
)
