"""``thm:per-step-err``: how far one step of LPC is from the clairvoyant step."""

from __future__ import annotations

from fractions import Fraction as Q

import numpy as np

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.search import Search, Trial
from ._sums import cauchy_schwarz, geometric, two_squares
from ._two_agents import TwoAgents, coupling_of

LOCAL = "the local perturbation bound holds with C_1, rho_T, rho_S; the global one with C_G, rho_G"
GAMMA_T, GAMMA_S = Q(1, 144), Q(1, 4)  # squares of rho_T = 1/12 and rho_S = 1/2


def printed_bound() -> tuple[Q, Q]:
    """Return e_1^2 of LPC and the printed bound, two agents that are not coupled in time."""
    a, x = coupling_of(GAMMA_T) / 2, coupling_of(GAMMA_S)
    two = TwoAgents(x / 4)
    rho_T, rho_S = Q(1, 12), Q(1, 2)
    c_1 = 4 * x * a  # C_1^2, Delta = 1
    f_1 = two.cost(two.optimum)  # step 2 is past the horizon: it costs nothing
    return two.error, 8 * c_1 / (1 - rho_T) * rho_S**2 * f_1


def _windows(rng: np.random.Generator) -> Trial:
    """The largest ``e_t^2`` over the right side, e3 with ``|x* - theta|^2`` in place of f."""
    from ...bounds.global_bound import global_repaired
    from ...bounds.local_bound import local_repaired
    from ...bounds.ratio import per_step
    from ...bounds.reach import reach
    from ._networks import sample
    from ._window import largest, step_map

    given = sample(rng, a=(-1.5, 1.0), x=(-1.5, 1.0))
    p, k, r = given.parameters, given.k, given.r
    local = local_repaired(p.a_T, p.a_S, given.growth.max_degree)
    whole = global_repaired(p.a_T)
    c = per_step(local, whole, reach(given.growth, local.rho_S, r), k, r)
    steps = np.arange(given.problem.H)
    weights = np.where(steps < k, float(c.lateral) / 2 * float(local.rho_T) ** steps, 1.0)
    if k <= given.problem.H:
        weights[k - 1] += float(c.top) / 2
    return largest(step_map(given.problem, k, r), float(c.history), weights), 1.0, given.about


E0 = (
    "e_t^2 <= 4 C_1^2 C_0^2 (h(r)^2 rho_G^2 rho_S^{2r}/((1-rho_T)(1-rho_G^2 rho_T)) + C_3(r)^2 "
    "rho_T^{2(k-1)} rho_G^{2k}) |x_{t-1} - x*_{t-1}|^2 + (8 C_1^2/mu) (h(r)^2 rho_S^{2r}/(1-rho_T) "
    "sum_{tau=t}^{t+k-1} rho_T^{tau-t} f_tau(x*_tau) + C_3(r)^2 rho_T^{2(k-1)} "
    "f_{t+k-1}(x*_{t+k-1}))"
)
STEPS = ("thm:per-step-err:e1:s1", "thm:per-step-err:e1:s2", "thm:per-step-err:e1:s3")

CLAIMS: tuple[Claim, ...] = (
    Claim(
        "thm:per-step-err",
        "error of one step, with the printed constants",
        E0,
        "Assumption 2.1; C_1 = 2 sqrt(Delta l_S l_T)/mu, rho_T, rho_S of thm:networked-exp-decay, "
        "C_0 = max(1, 2 l_T/mu); k >= 2, r >= 1",
        (
            Counterexample(
                printed_bound,
                {"l_T": coupling_of(GAMMA_T) / 2, "l_S": coupling_of(GAMMA_S), "k": 2, "r": 1},
                "Two agents, H = 1, mu = l_f = 1, (x_1-1)^2/2 + (x_2+1)^2/2 + (4/9)(x_1-x_2)^2, "
                "no temporal cost (it is l_T-smooth): rho_T = 1/12, rho_S = 1/2, and LPC plays "
                "+-1/17 where the optimum is +-9/25. C_1 vanishes with l_T, the error does not",
            ),
        ),
        kind="lemma",
        uses=("thm:per-step-err:e3", "thm:networked-exp-decay", "thm:global-exp-decay"),
        repaired="the same with the repaired C_1 and C_G: thm:per-step-err[repaired]",
    ),
    Claim(
        "thm:per-step-err",
        "error of one step, with the repaired constants",
        E0,
        "Assumption 2.1; C_1 = (c2/2) max(a/rho_T, sqrt(Delta) a_S/rho_S), C_G = c(1+2a) a/(2 "
        "gamma_T); k >= 2, r >= 1",
        (
            Search(
                _windows,
                "largest e_t^2 over x_{t-1} and all targets of random quadratic networks, with "
                "|x* - theta|^2 mu/2 <= f on the right",
                quick=40,
                full=1500,
                nudge=0.01,
            ),
        ),
        part="repaired",
        kind="lemma",
        uses=(
            *STEPS,
            "thm:per-step-err:e2",
            "thm:per-step-err:e2-2",
            "thm:networked-exp-decay[r]",
            "thm:global-exp-decay[r]",
        ),
    ),
    Claim(
        "thm:per-step-err:e1:s1",
        "the two parts of the boundary",
        "|x - y|^2 <= 2 (lateral part)^2 + 2 (top part)^2",
        LOCAL,
        (two_squares(),),
        kind="step",
    ),
    Claim(
        "thm:per-step-err:e1:s2",
        "Cauchy-Schwarz",
        "(sum w z)^2 <= (sum w)(sum w z^2), w = rho_T^{tau-t} or rho_S^{d(u,v)}",
        "w >= 0, any number of terms",
        (cauchy_schwarz(),),
        kind="step",
    ),
    Claim(
        "thm:per-step-err:e1:s3",
        "sums of weights",
        "sum_{tau=t}^{t+k-1} rho_T^{tau-t} |boundary of N_v^r| <= h(r)/(1-rho_T)",
        "0 <= rho_T < 1",
        (geometric("rho_T"),),
        kind="step",
    ),
    Claim(
        "thm:per-step-err:e2",
        "every boundary vertex is counted h(r) times",
        "sum_v sum_{u in boundary of N_v^r} z_u <= h(r) sum_v z_v, and sum_v sum_{u in N_v^r} "
        "rho_S^{d(u,v)} z_u <= C_3(r) sum_v z_v (printed with the boundary for N_v^r)",
        "z >= 0; d is symmetric",
        (
            Decision(
                ("n", "h", "z", "w"),
                lambda n, h, z, w: ([n >= 0, n <= h, z >= 0, w >= 0], n * w * z, h * w * z),
                "sums exchanged: z_u occurs for the n <= h(q) agents v with d(v, u) = q, with the "
                "weight w = 1 at q = r, or w = rho_S^q for q = 0..r",
                false=(
                    lambda n, h, z, w: ([n >= 0, n <= 2 * h, z >= 0, w >= 0], n * w * z, h * w * z),
                ),
            ),
            Search(
                lambda rng: _counts(rng),
                "largest of the two quotients, graphs and z of 0 and 1, in whole numbers and "
                "rational rho_S",
                quick=60,
                full=2000,
                nudge=0.95,
            ),
        ),
        kind="step",
        uses=STEPS,
    ),
    Claim(
        "thm:per-step-err:e2-2",
        "from the clairvoyant continuation to the optimum",
        "|x*_{tau|t-1} - theta|^2 <= 2 |x*_{tau|t-1} - x*_tau|^2 + 2 |x*_tau - theta|^2",
        "",
        (two_squares(),),
        kind="step",
    ),
    Claim(
        "thm:per-step-err:e3",
        "the sum over the window",
        "sum_{tau=t}^{t+k-1} rho_T^{tau-t} rho_G^{2(tau-t+1)} <= rho_G^2/(1 - rho_G^2 rho_T), and "
        "2 * 2 = 4 in front",
        "0 <= rho_T, rho_G < 1",
        (geometric("rho_T rho_G^2"),),
        kind="step",
        uses=("thm:per-step-err:e2", "thm:per-step-err:e2-1", "thm:per-step-err:e2-2"),
    ),
    Claim(
        "thm:per-step-err:e3",
        "node costs grow like the square of the distance",
        "f_tau(x*) >= (mu/2) |x* - theta|^2",
        "f nonnegative, mu-strongly convex with minimiser theta; spatial costs nonnegative",
        (
            Decision(
                ("least", "slope", "mu", "D", "f"),
                lambda least, slope, mu, D, f: (
                    [
                        least >= 0,
                        mu > 0,
                        D >= 0,
                        slope >= 0,
                        f >= least + slope * D + mu * D * D / 2,
                    ],
                    mu * D * D / 2,
                    f,
                ),
                "f(x) >= f(theta) + slope D + mu D^2/2 with slope >= 0 along x - theta, as "
                "theta is "
                "the minimiser (over R^n or over the feasible set)",
                false=(
                    lambda least, slope, mu, D, f: (
                        [least >= 0, mu > 0, D >= 0, f >= least + slope * D + mu * D * D / 2],
                        mu * D * D / 2,
                        f,
                    ),
                ),
            ),
        ),
        part="f",
        kind="step",
    ),
)


def _counts(rng: np.random.Generator) -> Trial:
    from ...graphs import network_growth, parse_graph
    from ...lowerbounds.spatial import distances
    from ._networks import GRAPHS

    name = str(rng.choice(GRAPHS))
    network = parse_graph(name)
    growth = network_growth(network)
    d = distances(network, np.arange(network.vertices))
    r, rho = int(rng.integers(0, 4)), Q(int(rng.integers(1, 8)), 8)
    z = [int(bit) for bit in rng.integers(0, 2, network.vertices)]
    z[0] = 1
    weights = [rho**q for q in range(r + 1)]
    C_3 = sum((growth.h(q) * weights[q] for q in range(r + 1)), Q(0))
    rim = sum(z[u] for v in range(len(z)) for u in range(len(z)) if d[v, u] == r)
    ball = sum(
        (
            z[u] * weights[int(d[v, u])]
            for v in range(len(z))
            for u in range(len(z))
            if d[v, u] <= r
        ),
        Q(0),
    )
    left = max(Q(rim, growth.h(r)) if growth.h(r) else Q(rim), ball / C_3)
    return float(left), float(sum(z)), {"graph": name, "r": r, "rho_S": rho, "z": z}
