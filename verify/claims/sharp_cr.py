"""``nearsight:sharp-cr``: the project's competitive ratio, (E3)-(E5)."""

from __future__ import annotations

from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.search import Search, Trial

LABEL = "nearsight:sharp-cr"
SMALL = ("path:3", "ring:6", "ring:8", "star:4", "complete:4", "ring-of-blocks:4x2")


def _certificate(variant: str) -> Search:
    """Return the search for a network that beats a certificate of one kind."""

    def trial(rng: Any) -> Trial:
        from ._networks import certificate, sample

        for _ in range(20):  # a certificate that does not close says nothing
            given = sample(rng, a=(-2.2, -0.3), x=(-2.0, -0.3), graphs=SMALL)
            if certificate(given, variant) < float("inf"):
                worst = given.worst()
                return worst, certificate(given, variant, worst), given.about
        return 0.0, 1.0, {}

    return Search(
        trial,
        "exact worst case over all data of random quadratic networks, uniform and not",
        quick=24,
        full=2000,
        nudge=0.8,
        rounding=1e-7,
    )


def _constrained(rng: Any) -> Trial:
    """LPC on the worst unconstrained data, with a box that binds."""
    from dataclasses import replace

    import numpy as np

    from ...lowerbounds.worst_case import worst_case
    from ...lpc.offline import optimum
    from ...lpc.sets import Box
    from ...lpc.simulation import simulate
    from ._networks import certificate, sample

    given = sample(rng, a=(-2, -0.3), x=(-2, -0.3), graphs=SMALL[:4], k=(2, 3), r=(1, 2), H=4)
    bound = certificate(given, "vi")
    problem = worst_case(given.problem, given.k, given.r).problem
    best = optimum(problem)
    if best.cost < 1e-9 or not np.isfinite(bound):
        return 0.0, 1.0, given.about
    limit = float(rng.uniform(0.5, 1.0)) * float(np.abs(best.x).max())
    inside = replace(problem, feasible=Box(-limit, limit))
    ratio = simulate(inside, given.k, given.r).interval[0]
    return ratio, bound, {**given.about, "box": limit}


def _optimum(rng: Any) -> Trial:
    """``1 + 1/(2a+x)`` beside ``2 OPT/(mu |D|^2)`` at its least over all data.

    ``2 OPT = y'K Q^{-1} K y + y'K y`` and ``|D|^2 = |Q^{-1} K y|^2``, in ``z = root' y``.
    """
    import numpy as np
    from scipy.linalg import eigh

    from ...lowerbounds.energy import Energy
    from ._networks import sample

    given = sample(rng, a=(-2, 1), x=(-2, 1), H=6)
    energy = Energy.of(given.problem)
    inverse = energy.inverse.toarray()
    values, vectors = np.linalg.eigh(energy.couplings.toarray())
    keep = values > 1e-9 * values[-1]
    if not keep.any():
        return 0.0, 1.0, given.about
    root = vectors[:, keep] * np.sqrt(values[keep])  # couplings = root root'
    cost = root.T @ inverse @ root + np.eye(keep.sum())
    size = root.T @ inverse @ inverse @ root
    least = float(1 / eigh(size, cost, eigvals_only=True)[-1])
    p = given.parameters
    return 1 + 1 / (2 * p.l_T + given.growth.max_degree * p.l_S), least, given.about


USES = (
    "nearsight:slice-decay",
    "nearsight:weighted-energy[E2]",
    f"{LABEL}[E4]",
    f"{LABEL}[closing]",
)

CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "sharp competitive ratio, any constraints",
        "CR <= 1 + 2 P(y)/(1 + 1/(2a+x)), P the gap dG E - E^2/2 of vi at the closing y",
        "Assumption 2.1, nonnegative costs, closed convex product sets; any l_f",
        (
            _certificate("vi"),
            Search(
                _constrained,
                "LPC on the worst data of unconstrained networks, with a box that binds",
                quick=6,
                full=600,
                nudge=0.12,
                rounding=1e-6,
                seed=4,
            ),
        ),
        part="vi",
        uses=USES,
    ),
    Claim(
        LABEL,
        "sharp competitive ratio, unconstrained",
        "CR <= 1 + 2 P(y)/(1 + 1/(2a+x)), P the gap G E_top - E_top^2/2 + G E_lat + (Lam/2) "
        "E_lat^2",
        "Assumption 2.1, nonnegative costs, feasible sets all of R^n",
        (_certificate("mix"),),
        part="mix",
        uses=USES,
    ),
    Claim(
        LABEL,
        "sharp competitive ratio, by smoothness",
        "CR <= 1 + 2 P(y)/(1 + 1/(2a+x)), P the gap (Lam/2) E^2",
        "Assumption 2.1, nonnegative costs, feasible sets all of R^n",
        (_certificate("smooth"),),
        part="smooth",
        uses=USES,
    ),
    Claim(
        LABEL,
        "the optimum costs",
        "OPT >= (mu/2)(1 + 1/(2a+x)) sum |x* - theta|^2",
        "Assumption 2.1, nonnegative costs; constraints included",
        (
            Decision(
                ("f", "pairs", "slope", "D", "L"),
                lambda f, pairs, slope, D, L: (
                    [D > 0, L > 0, 2 * f >= D * D, slope >= D, 2 * L * pairs >= slope * slope],
                    (L + 1) * D * D,
                    2 * L * (f + pairs),
                ),
                "mu = 1, L = 2a + x: the node costs f are at least |D|^2/2, the interactions are "
                "L-smooth and nonnegative, so at least |gradient|^2/(2L); the gradient at x* is at "
                "least |D| by the optimality of x* and strong convexity; multiplied by 2L",
                false=(
                    lambda f, pairs, slope, D, L: (
                        [D > 0, L > 0, 2 * f >= D * D, 2 * L * pairs >= slope * slope],
                        (L + 1) * D * D,
                        2 * L * (f + pairs),
                    ),
                ),
            ),
            Search(
                _optimum,
                "least quotient over all data of random quadratic networks",
                quick=40,
                full=3000,
                nudge=0.8,
            ),
        ),
        part="E4",
        kind="lemma",
    ),
    Claim(
        LABEL,
        "closing",
        "y^2/2 <= P_0 + P_1 y + P_2 y^2 gives y <= (P_1 + sqrt(P_1^2 + 4 (1/2 - P_2) "
        "P_0))/(2 (1/2 - "
        "P_2))",
        "P_2 < 1/2, P_0, P_1 >= 0",
        (
            Decision(
                ("y", "P_0", "P_1", "rest"),
                lambda y, P_0, P_1, rest, root: (
                    [y >= 0, P_0 >= 0, P_1 >= 0, rest > 0, rest * y * y <= P_0 + P_1 * y],
                    2 * rest * y,
                    P_1 + root,
                ),
                "rest = 1/2 - P_2, root = sqrt(P_1^2 + 4 rest P_0)",
                roots={"root": lambda y, P_0, P_1, rest: P_1 * P_1 + 4 * rest * P_0},
                false=(
                    lambda y, P_0, P_1, rest, root: (
                        [y >= 0, P_0 >= 0, P_1 >= 0, rest > 0, rest * y * y <= P_0 + P_1 * y],
                        2 * rest * y,
                        root,
                    ),
                ),
            ),
        ),
        part="closing",
        kind="step",
    ),
)
