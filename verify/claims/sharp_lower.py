"""The project's lower bounds: in time, on any network, and on the ring of blocks."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..claim import Claim
from ..engines.search import Search, Trial
from ..engines.symbolic import Identity

TIME, TEAM, RING = (
    "nearsight:temporal-lower-bound",
    "nearsight:team-lower-bound",
    "nearsight:ring-of-blocks",
)


def _near(rng: np.random.Generator, best: Any) -> Any:
    """Return a policy's numbers at, near or far from the best ones."""
    return best * (1 + rng.choice([0.0, 1e-4, 0.3, 2.0]) * rng.normal(size=len(best)))


def _chain(rng: np.random.Generator) -> Trial:
    """The closed form of one target's price beside what a policy pays for it, dense."""
    from ...lowerbounds.temporal import Temporal

    a, k, H = float(10 ** rng.uniform(-1.5, 1.5)), int(rng.integers(1, 5)), int(rng.integers(5, 14))
    tau = int(rng.integers(k + 1, H + 1))
    M = np.diag(np.full(H, 1 + a)) - a / 2 * (np.eye(H, k=1) + np.eye(H, k=-1))
    M[-1, -1] -= a / 2
    unit = np.zeros(H)
    unit[tau - 1] = 1.0
    policy, seen = np.zeros(H), slice(tau - k, H)  # steps tau-k+1 .. H know the target
    policy[seen] = _near(rng, np.linalg.solve(M[seen, seen], unit[seen]))
    off = policy - np.linalg.solve(M, unit)
    about = {"a": a, "k": k, "H": H, "tau": tau}
    return float(Temporal(a, k, H).excess[tau - 1]), float(off @ M @ off), about


def _limits() -> tuple[Any, Any]:
    """The two bounds for H to infinity, from the prices of one target, in ``g, W = g^{2k}``."""
    import sympy

    g, W, u = sympy.symbols("g W u", positive=True)
    s = (1 + g) / (1 - g)
    last = W * (1 + g) ** 2 / (s * (1 + g * W)) / g
    run = W / s / (2 * g / (1 + g))
    return last + u * run, W / g * (1 + g) ** 2 / ((1 + g * W) * s) + u * W / g / (s + 1)


def _team(rng: np.random.Generator) -> Trial:
    """The team bound beside the expected excess of a linear policy, one random source."""
    from ...graphs import parse_graph
    from ...lowerbounds.spatial import Spatial
    from ._networks import GRAPHS

    name, r = str(rng.choice(GRAPHS)), int(rng.integers(0, 3))
    network, a_S = parse_graph(name), float(10 ** rng.uniform(-1.5, 1.5))
    spatial = Spatial(network, a_S, r)
    j = int(rng.integers(network.vertices))
    seen = spatial.seen(np.array([j]))[0]
    M = spatial.system.matrix.toarray()
    unit = np.zeros(len(M))
    unit[j] = 1.0
    policy = np.zeros(len(M))
    policy[seen] = -_near(rng, np.linalg.solve(M[np.ix_(seen, seen)], unit[seen]))
    off = policy + np.linalg.solve(M, unit)
    price = float(spatial.charges([j]).team[0])
    return price, float(off @ M @ off), {"graph": name, "a_S": a_S, "r": r, "agent": j}


def _finite_ring(rng: np.random.Generator) -> Trial:
    """The closed form beside the team bound of a long finite ring."""
    from ...bounds.lower import spatial_excess
    from ...graphs import parse_graph
    from ...lowerbounds.spatial import Spatial

    d, r = int(rng.integers(1, 4)), int(rng.integers(1, 4))
    a_S = float(10 ** rng.uniform(-1.5, 0.3)) / d
    ring = parse_graph(f"ring-of-blocks:40x{d}")
    exact = Spatial(ring, a_S, r).cr_minus_one
    return float(spatial_excess(a_S, d, r)), exact * (1 + 1e-8), {"d": d, "r": r, "a_S": a_S}


def _entries() -> tuple[Any, Any]:
    """Rows of ``(I + l L) B = I``: other blocks, j itself, and the rest of its block.

    ``D = d l = q/(1-q)^2``; unlike factors keep the three equations apart.
    """
    import sympy

    q, d, u, v, power = sympy.symbols("q d u v power", positive=True)
    D, s = q / (1 - q) ** 2, (1 + q) / (1 - q)
    near = q / (d * s)
    within = 1 / (d * s) - 1 / (d * (1 + 2 * D))
    itself = within + 1 / (1 + 2 * D)
    far = power / (d * s)  # power = q^kappa, kappa >= 2; kappa = 1 meets the mean over block 0
    left = (1 + 2 * D) * (far + u * within + v * itself)
    mean = 1 / (d * s)  # of the entries within block 0: q^0/(d s)
    right = D * (far * q + far / q) + u * 2 * D * near + v * (1 + 2 * D * near)
    return left + (within * (d - 1) + itself) / d, right + mean


def _dirichlet() -> tuple[Any, Any]:
    """``q^k - c (q^k + q^{-k})`` solves the recurrence, vanishes at R = r + 1; value at 0."""
    import sympy

    q, power, Q, u, v = sympy.symbols("q power Q u v", positive=True)  # q^k, q^R
    D = q / (1 - q) ** 2
    c = Q / (Q + 1 / Q)

    def value(z: Any) -> Any:
        return z - c * (z + 1 / z)

    left = (1 + 2 * D) * value(power) + u * value(Q) + v * (1 - value(sympy.Integer(1)))
    right = D * (value(power * q) + value(power / q)) + v * 2 * Q**2 / (1 + Q**2)
    return left, right


CLAIMS: tuple[Claim, ...] = (
    Claim(
        TIME,
        "lower bound in k",
        "CR - 1 >= gamma_T^{2k-1} (1+gamma_T)^2/((1+gamma_T^{2k+1}) sqrt(1+2a)), and >= "
        "gamma_T^{2k}/(sqrt(1+2a) - 1) for targets that are all random",
        "one agent, (mu/2)(x-theta_t)^2 + (l_T/4)(x_t-x_{t-1})^2, H to infinity, every policy",
        (
            Search(
                _chain,
                "the closed form of what a target costs that is seen k steps ahead, beside "
                "policies at and near the best one, horizons up to 13",
                quick=200,
                full=5000,
                nudge=0.999,
            ),
        ),
        uses=(f"{TIME}[limit]",),
    ),
    Claim(
        TIME,
        "the two limits",
        "price over cost of one target as H goes to infinity: the last one, and one in the middle",
        "price gamma^{2k}(1+gamma)^2/(s (1+gamma^{2k+1})) over gamma; gamma^{2k}/s over 2 "
        "gamma/(1+gamma)",
        (Identity(_limits, "s = (1+g)/(1-g), W = g^{2k}, an unlike factor u"),),
        part="limit",
        kind="step",
    ),
    Claim(
        TEAM,
        "the best decentralised policies of one step",
        "E[excess] >= (mu/2) sum_j Var(w_j) (B_jj - [((I + l L)_{S_j S_j})^{-1}]_jj), S_j the ball "
        "of radius r around j",
        "w independent with mean zero, agent i sees w within distance r; any network",
        (
            Search(
                _team,
                "linear policies at and near the best one, one source of variance",
                quick=200,
                full=5000,
                nudge=0.999,
            ),
        ),
    ),
    Claim(
        RING,
        "lower bound in r",
        "CR - 1 >= (2 q^{2(r+1)}/(d sqrt(1+x)(1+q^{2(r+1)})))/(1 - B_jj), r >= 2; q = g(x), "
        "x = 2 d "
        "l_S/mu; for r = 1 an algebraic number",
        "infinite ring of blocks of d vertices, every policy",
        (
            Search(
                _finite_ring,
                "the closed form beside the team bound of 40 blocks",
                quick=30,
                full=500,
                nudge=0.999,
            ),
        ),
        uses=(TEAM, f"{RING}[entries]", f"{RING}[chain]"),
    ),
    Claim(
        RING,
        "entries of (I + l L)^{-1}",
        "B_ij = q^kappa/(d s) at kappa >= 1 blocks, 1/(d s) - 1/(d(1+2dl)) within a block, "
        "and 1/(1 + "
        "2dl) more on the diagonal",
        "infinitely many blocks, q = g(4dl), s = sqrt(1+4dl)",
        (
            Identity(
                _entries,
                "dl = q/(1-q)^2, s = (1+q)/(1-q): the three kinds of rows of (I + l L) B = "
                "I, whose "
                "bounded solution is unique",
            ),
        ),
        part="entries",
        kind="step",
    ),
    Claim(
        RING,
        "a chain of blocks cut off at r + 1",
        "B_jj - [((I + l L)_{SS})^{-1}]_jj = 2 q^{2(r+1)}/(d s (1 + q^{2(r+1)})), r >= 2",
        "S the 2r+1 blocks around j",
        (
            Identity(
                _dirichlet,
                "q^k - c (q^k + q^{-k}) with c = q^R/(q^R + q^{-R}), R = r+1, solves the "
                "recurrence "
                "and vanishes at R",
            ),
        ),
        part="chain",
        kind="step",
        uses=(f"{RING}[entries]",),
    ),
)
