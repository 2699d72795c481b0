"""``coro:pure-exp-decay``: a ratio without ``h`` and ``C_3``, for very weak couplings."""

from __future__ import annotations

from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.search import Search, Trial
from ._sums import geometric

COROLLARY = "coro:pure-exp-decay"


def _networks(rng: Any) -> Trial:
    """The exact worst case beside the printed bound, at and near the largest couplings."""
    from ...bounds import bounds_for
    from ...bounds.parameters import Parameters
    from ...bounds.setting import Setting
    from ...graphs import network_growth, parse_graph
    from ...lowerbounds.worst_case import worst_case
    from ...lpc.instances import instance
    from ._networks import STYLES

    name = str(rng.choice(["path:2", "path:2", "ring:5", "path:4", "star:3"]))
    network = parse_graph(name)
    weaker = rng.choice([0.0, 1e-3, 0.3, 1.0], 2)
    a, a_S = weaker[0] / 16, weaker[1] * float(network.max_degree) ** -7
    p = Parameters(1.0, float(rng.choice([1.0, 4.0])), a, a_S)
    style, seed = str(rng.choice(STYLES)), int(rng.integers(1000))
    k, r = int(rng.integers(2, 4)), int(rng.integers(1, 3))
    problem = instance(network, 4, p, style=style, seed=seed, varying=bool(rng.random() < 0.5))
    (bound,) = (b for b in bounds_for(COROLLARY) if b.tier == "stated")
    value = bound.evaluate(Setting(p, network_growth(network), k, r)).values["cr_minus_one"]
    about = {"graph": name, "l_T": a, "l_S": a_S, "style": style, "seed": seed, "k": k, "r": r}
    promised = float("inf") if value is None else float(value)
    return worst_case(problem, k, r).cr_minus_one, promised, about


CLAIMS: tuple[Claim, ...] = (
    Claim(
        COROLLARY,
        "competitive ratio for very weak couplings",
        "CR <= 1 + (1 + 32 C_0^2 C_1^2 (l_f + Delta l_S + 2 l_T)/(mu (1-rho_G)^2 (1-rho_T)^2)) "
        "rho_S^{r/2} + (1 + 32 C_0^2 C_1^2 (l_f + Delta l_S + 2 l_T) Delta^2/(mu (1-rho_G)^2 "
        "(Delta "
        "- sqrt(rho_S))^2)) rho_T^{k-1} (printed with l_c for l_T)",
        "l_S/mu <= Delta^{-7}, l_T/mu <= 1/16; thm:networked-exp-decay-tight with b_1 = 2 Delta - "
        "1, b_2 = 4 Delta^2 - 2 Delta; (e2-0) in these constants; k >= 2, r >= 1",
        (
            Search(
                _networks,
                "exact worst case over all data of random quadratic networks",
                quick=30,
                full=1000,
                nudge=1e-5,
            ),
        ),
        kind="corollary",
        uses=(
            "coro:CR-LPC",
            "thm:networked-exp-decay-tight",
            f"{COROLLARY}:e1",
            f"{COROLLARY}:e2",
            f"{COROLLARY}[h]",
            f"{COROLLARY}[conditions]",
        ),
    ),
    Claim(
        COROLLARY,
        "the conditions of the tight bound",
        "l_S/mu <= Delta^{-7} and l_T/mu <= 1/16 give mu >= max(8 a~ l_T, Delta l_S (b_1 + b_2)/4)",
        "Delta >= 1, a~ <= 2 since h(q) <= Delta^q, b_1 + b_2 = 4 Delta^2 - 1",
        (
            Decision(
                ("Delta", "l_S"),
                lambda Delta, l_S: (
                    [Delta >= 1, l_S >= 0, l_S * Delta**7 <= 1],
                    Delta * l_S * (4 * Delta**2 - 1),
                    4,
                ),
                "mu = 1; 8 a~ l_T <= 16/16",
                false=(
                    lambda Delta, l_S: (
                        [Delta >= 1, l_S >= 0, l_S * Delta**2 <= 1],
                        Delta * l_S * (4 * Delta**2 - 1),
                        4,
                    ),
                ),
            ),
        ),
        part="conditions",
        kind="step",
        uses=("sec:main:perturb#b1b2-choice",),
    ),
    Claim(
        f"{COROLLARY}:e1",
        "rho_S beats the growth of any graph",
        "Delta^2 rho_S <= sqrt(rho_S), that is Delta^4 rho_S <= 1",
        "rho_S = 4 Delta^2 g(x), x = Delta l_S/mu <= Delta^{-6}",
        (
            Decision(
                ("Delta", "x"),
                lambda Delta, x, s: (
                    [Delta >= 1, x >= 0, x * Delta**6 <= 1],
                    4 * Delta**6 * (s - 1),
                    s + 1,
                ),
                "s = sqrt(1+x), g(x) = (s-1)/(s+1)",
                roots={"s": lambda Delta, x: 1 + x},
                false=(
                    lambda Delta, x, s: (
                        [Delta >= 1, x >= 0, x * Delta**6 <= 4],
                        4 * Delta**6 * (s - 1),
                        s + 1,
                    ),
                ),
            ),
        ),
        kind="step",
    ),
    Claim(
        f"{COROLLARY}:e1",
        "the chain",
        "Delta^2 sqrt(rho_S) = 2 Delta^3 sqrt(g(x)) <= 2 Delta^3 sqrt((sqrt(1 + Delta^{-6}) - "
        "1)/2) <= 1",
        "x = Delta l_S/mu <= u = Delta^{-6}",
        (
            Decision(
                ("x", "u"),
                lambda x, u, s, t: ([x >= 0, x <= u], 2 * (s - 1), (t - 1) * (s + 1)),
                "g(x) = (s-1)/(s+1) <= (t-1)/2, s = sqrt(1+x), t = sqrt(1+u)",
                roots={"s": lambda x, u: 1 + x, "t": lambda x, u, s: 1 + u},
                false=(lambda x, u, s, t: ([x >= 0, x <= u], 3 * (s - 1), (t - 1) * (s + 1)),),
            ),
            Decision(
                ("u",),
                lambda u, t: ([u >= 0], 2 * (t - 1), u),
                "4 Delta^6 (t-1)/2 <= 1",
                roots={"t": lambda u: 1 + u},
                false=(lambda u, t: ([u >= 0], 3 * (t - 1), u),),
            ),
        ),
        part="chain",
        kind="step",
    ),
    Claim(
        f"{COROLLARY}:e2",
        "the sum C_3",
        "C_3(r) <= sum (sqrt(rho_S)/Delta)^q <= Delta/(Delta - sqrt(rho_S))",
        "h(q) <= Delta^q and (e1): Delta rho_S <= sqrt(rho_S)/Delta < 1",
        (
            geometric("sqrt(rho_S)/Delta"),
            Decision(
                ("Delta", "root"),
                lambda Delta, root: (
                    [Delta >= 1, root >= 0, Delta**2 * root <= 1],
                    Delta**2 * root**2,
                    root,
                ),
                "root = sqrt(rho_S)",
                false=(
                    lambda Delta, root: (
                        [Delta >= 1, root >= 0, Delta * root <= 1],
                        Delta**2 * root**2,
                        root,
                    ),
                ),
            ),
        ),
        kind="step",
        uses=(f"{COROLLARY}:e1",),
    ),
    Claim(
        COROLLARY,
        "h is absorbed",
        "h(r)^2 rho_S^r <= rho_S^{r/2}",
        "h(r) <= Delta^r and (e1)",
        (
            Decision(
                ("power", "root", "Delta", "u"),
                lambda power, root, Delta, u: (
                    [Delta >= 1, root >= 0, Delta**2 * root <= 1, power <= 1, power >= 0, u >= 0],
                    power * Delta**2 * root * u,
                    u,
                ),
                "induction on r: (Delta^2 root)^r = power <= 1 keeps with one more factor, root = "
                "sqrt(rho_S), u = rho_S^{r/2}",
                false=(
                    lambda power, root, Delta, u: (
                        [Delta >= 1, root >= 0, Delta * root <= 1, power <= 1, power >= 0, u >= 0],
                        power * Delta**2 * root * u,
                        u,
                    ),
                ),
            ),
        ),
        part="h",
        kind="step",
        uses=(f"{COROLLARY}:e1",),
    ),
)
