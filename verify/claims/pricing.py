"""The pricing example (``apx:application``): what the costs are, and their constants."""

from __future__ import annotations

from fractions import Fraction as Q
from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.symbolic import Identity

PLACE = "apx:application#"


def _model() -> tuple[Any, Any]:
    """Cost, and objective plus constant: two products, two steps, all numbers symbols."""
    import sympy

    def symbol(name: str, t: int, v: int) -> Any:
        return sympy.Symbol(f"{name}_{t}{v}", positive=True)

    sign = {1: 1, 2: -1}  # complements at step 1, substitutes at step 2
    x = {(t, v): sympy.Symbol(f"x_{t}{v}") for t in (0, 1, 2) for v in (1, 2)}
    cost, objective, constant = (sympy.Integer(0),) * 3
    for t in (1, 2):
        gamma = sympy.Symbol(f"gamma_{t}", positive=True)
        lean = sympy.Symbol(f"lean_{t}")  # the two eta are sign gamma +- lean
        for v in (1, 2):
            a, k, b = (symbol(name, t, v) for name in "akb")
            xi = k - gamma - (b + (symbol("b", 2, v) if t == 1 else 0)) / 2
            eta = sign[t] * gamma + (lean if v == 1 else -lean)
            now, before = x[t, v], x[t - 1, v]
            objective += now * (-a + k * now + eta * x[t, 3 - v] - b * before)
            cost += xi * (now - a / (2 * xi)) ** 2 + b / 2 * (now - before) ** 2
            constant += a**2 / (4 * xi) + (b * before**2 / 2 if t == 1 else 0)
        cost += gamma * (x[t, 1] + sign[t] * x[t, 2]) ** 2
    return cost, objective + constant


def _start() -> tuple[Q, Q]:
    """Cost, and objective plus constant: one product, one step, ``x_0 = 1``."""
    a, k, b, x, before = Q(1), Q(1), Q(1, 2), Q(0), Q(1)
    xi = k - b / 2
    cost = xi * (x - a / (2 * xi)) ** 2 + b / 2 * (x - before) ** 2
    return cost, x * (-a + k * x - b * before) + a**2 / (4 * xi)


def _after() -> tuple[Q, Q]:
    """Cost of the price that earns most, and of 2/3: ``H = 1, b_1 = b_2 = 1/2``."""
    a, k, b = Q(1), Q(1), Q(1, 2)
    xi = k - (b + b) / 2

    def cost(x: Q) -> Q:
        return xi * (x - a / (2 * xi)) ** 2 + b / 2 * x * x

    return cost(a / (2 * k)), cost(Q(2, 3))


def _parts() -> tuple[Any, Any]:
    """The three rewritten costs, added up with unlike factors."""
    import sympy

    x, y, a, b, gamma, xi, u, v = sympy.symbols("x y a b gamma xi u v", positive=True)
    sign = sympy.Symbol("sign")
    square = sympy.Integer(1)  # sign^2
    left = xi * (x - a / (2 * xi)) ** 2 + u * gamma * (x**2 + 2 * sign * x * y + square * y**2)
    left += v * b / 2 * (x - y) ** 2
    right = xi * x**2 - a * x + a**2 / (4 * xi)
    right += u * (gamma * (x**2 + y**2) + 2 * gamma * sign * x * y)
    return left, right + v * (b / 2 * (x**2 + y**2) - b * x * y)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        f"{PLACE}equivalence",
        "cost and revenue",
        "sum f + c + s = (objective) + sum (a_t^v)^2/(4 xi_t^v)",
        "any prices x_0 before the first step; b_{H+1} = 0",
        (
            Counterexample(
                _start,
                {"N": 1, "H": 1, "a": 1, "k": 1, "b": Q(1, 2), "x_0": 1, "x_1": 0},
                "xi = 3/4: the cost is 1/3 + 1/4 and the right side 1/3. The temporal cost "
                "of step 1 "
                "leaves b_1 x_0^2/2",
            ),
        ),
        kind="remark",
        repaired=f"with sum_v b_1 x_0^2/2 on the right: {PLACE}equivalence[repaired]",
    ),
    Claim(
        f"{PLACE}equivalence",
        "the same optimal prices",
        "the cost is least where the revenue is largest",
        "xi_H holds b_{H+1}/2, as printed, with b_{H+1} > 0 ('parameters b_t > 0')",
        (
            Counterexample(
                _after,
                {"N": 1, "H": 1, "a": 1, "k": 1, "b_1": Q(1, 2), "b_2": Q(1, 2), "x_0": 0},
                "The revenue x (1 - x) is largest at 1/2, the cost (1/2)(x-1)^2 + x^2/4 is "
                "less at 2/3",
            ),
        ),
        part="b_{H+1}",
        kind="remark",
        repaired=f"with b_{{H+1}} = 0: {PLACE}equivalence[repaired]",
    ),
    Claim(
        f"{PLACE}equivalence",
        "cost and revenue, repaired",
        "sum f + c + s = (objective) + sum a^2/(4 xi) + sum_v b_1^v (x_0^v)^2/2",
        "b_{H+1} = 0; any x_0, complements at one step, substitutes at the other, eta^{u->v} != "
        "eta^{v->u}",
        (
            Identity(
                _model,
                "two products, two steps, all parameters and prices symbols (a sum over edges and "
                "steps has no other terms)",
            ),
        ),
        part="repaired",
        kind="remark",
    ),
    Claim(
        f"{PLACE}parts",
        "the costs written out",
        "f = xi x^2 - a x + a^2/(4 xi), s = |gamma| (x^2 + y^2) + 2 gamma x y, c = (b/2)(x^2 "
        "+ y^2) "
        "- b x y",
        "sgn^2 = 1 (gamma != 0)",
        (Identity(_parts, "as they stand; unlike factors u, v keep the three apart"),),
        kind="remark",
    ),
    Claim(
        f"{PLACE}smoothness",
        "the constants of the costs",
        "f is mu-strongly convex and l_f-smooth, s is (4 gamma)-smooth, c is (2 b)-smooth",
        "xi >= mu/2, xi <= k <= l_f/2, |gamma^e| <= gamma, b_t <= b",
        (
            Decision(
                ("xi", "k", "cross", "b", "mu", "l_f"),
                lambda xi, k, cross, b, mu, l_f: (
                    [xi == k - cross - b, cross >= 0, b >= 0, 2 * xi >= mu, 2 * k <= l_f],
                    2 * xi,
                    l_f,
                ),
                "f'' = 2 xi <= 2 k <= l_f; f'' >= mu by assumption",
                false=(
                    lambda xi, k, cross, b, mu, l_f: (
                        [xi == k - cross - b, 2 * xi >= mu, 2 * k <= l_f],
                        2 * xi,
                        l_f,
                    ),
                ),
            ),
            Decision(
                ("x", "y", "g", "gamma"),
                lambda x, y, g, gamma: (
                    [g >= 0, g <= gamma],
                    2 * g * (x + y) ** 2,
                    4 * gamma * (x * x + y * y),
                ),
                "the Hessian's form 2 |gamma^e| (x +- y)^2 <= 4 gamma (x^2 + y^2); the one "
                "of c with "
                "b/2 for |gamma^e|",
                false=(
                    lambda x, y, g, gamma: (
                        [g >= 0, g <= gamma],
                        2 * g * (x + y) ** 2,
                        3 * gamma * (x * x + y * y),
                    ),
                ),
            ),
        ),
        kind="remark",
    ),
)
