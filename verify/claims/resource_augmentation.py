"""``coro:resource-augmentation``: how much more LPC has to see than the best algorithm."""

from __future__ import annotations

from fractions import Fraction as Q

import numpy as np

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.search import Search, Trial

COROLLARY = "coro:resource-augmentation"
TEMPORAL = "lemma:temporal-upper-and-lower"
SPATIAL = "lemma:spatial-upper-and-lower"


def _needed(rng: np.random.Generator) -> Trial:
    """How much more than (k*, r*) the sharp certificate asks for, over (4, 32)."""
    from ...bounds import bounds_for
    from ...bounds.parameters import Parameters
    from ...bounds.setting import Setting
    from ...graphs import parse_growth

    name = str(rng.choice(["ring-of-blocks:2", "ring-of-blocks:3", "grid2", "grid3"]))
    growth = parse_growth(name)
    a, x = 10 ** rng.uniform(-1, 1, 2)
    k, r = (int(v) for v in rng.integers(12, 20, 2))
    p = Parameters(1.0, 1.0, float(a), float(x) / growth.max_degree)
    (bound,) = (b for b in bounds_for(COROLLARY) if b.tier == "sharp")
    found = bound.evaluate(Setting(p, growth, k, r, unconstrained=True)).values
    about = {"growth": name, "a": a, "x": x, "k*": k, "r*": r}
    if found["k_needed"] is None:
        return float("inf"), 1.0, about
    return max(found["k_needed"] / (4 * k), found["r_needed"] / (32 * r)), 1.0, about


CLAIMS: tuple[Claim, ...] = (
    Claim(
        COROLLARY,
        "the factor 32 from the printed rates",
        "rho_S^{r/2} <= lambda_S^{r*} for r = 32 r*, that is rho_S^16 <= lambda_S",
        "h(r)^2 rho_S^r = O~(rho_S^{r/2}) under h = O~(rho_S^{-q/4})",
        (
            Counterexample(
                lambda: (Q(7, 8) ** 8, Q(224, 3 + 3 * 224)),
                {"x": 224},
                "x = 224: sqrt(1+x) = 15, rho_S^2 = 7/8, rho_S^16 = (7/8)^8 = 0.344 > "
                "224/675 = 0.332 "
                "(the second branch of lambda_S is 0.288). The lemma gives rho_S^32, so r = 64 r*; "
                "the printed rates need a factor 36.1 at worst, near x = 268",
            ),
        ),
        part="32",
        kind="step",
        uses=(SPATIAL,),
        repaired="r = 64 r* from the lemma; the proven rates give 16: coro:resource-augmentation"
        "[rates]",
    ),
    Claim(
        COROLLARY,
        "the factors from the proven rates",
        "rho_T^4 = gamma_T^2 (k = 4 k*), and rho_S^8 = g(x)^4 <= g(2x/3)^2 (r = 16 r*)",
        "h = O~(rho_S^{-q/4}); Delta >= 3, 2 floor(Delta/2) >= 2 Delta/3; repaired coro:CR-LPC",
        (
            Decision(
                ("y",),
                lambda y, s, w: (
                    [y >= 0],
                    (w - 1) ** 2 * (s + 1),
                    (s - 1) * (w + 1) ** 2,
                ),
                "g(3y/2)^2 <= g(y), y = 2x/3, s = sqrt(1+y), w = sqrt(1+3y/2)",
                roots={"s": lambda y: 1 + y, "w": lambda y, s: 1 + 3 * y / 2},
                false=(lambda y, s, w: ([y >= 0], (w - 1) * (s + 1), (s - 1) * (w + 1)),),
            ),
        ),
        part="rates",
        kind="step",
        uses=("coro:CR-LPC[repaired]", "thm:bottleneck[repaired]"),
    ),
    Claim(
        COROLLARY,
        "resource augmentation",
        "k = (4 + o(1)) k* and r = (32 + o(1)) r* are enough for LPC to be as good as the best "
        "algorithm with (k*, r*)",
        "h(q) = O~(rho_S^{-q/4}), Delta >= 3; checked on networks of subexponential growth",
        (
            Search(
                _needed,
                "least (k, r) of the sharp certificates for the proven lower bound at (k*, r*), "
                "over (4 k*, 32 r*)",
                quick=12,
                full=400,
                nudge=0.2,
            ),
        ),
        kind="corollary",
        uses=(
            "coro:CR-LPC",
            "thm:bottleneck",
            "thm:spatial_lower_bound",
            TEMPORAL,
            SPATIAL,
            f"{COROLLARY}[32]",
        ),
    ),
)
