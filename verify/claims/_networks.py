"""Small random quadratic networks, with the exact worst case over all their data."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ...bounds.parameters import Parameters
from ...graphs import network_growth, parse_graph
from ...graphs.growth import Growth

if TYPE_CHECKING:
    from ...lpc.problem import Problem

GRAPHS = (
    "path:2",
    "path:3",
    "path:5",
    "ring:4",
    "ring:6",
    "ring:8",
    "star:4",
    "complete:4",
    "grid:2x3",
    "ring-of-blocks:4x2",
)
STYLES = ("attraction", "attraction", "repulsion", "tilted", "blocks")


@dataclass(frozen=True, eq=False)
class Sample:
    """A quadratic network within the assumptions, with exact constants; costs in units of mu.

    Parameters
    ----------
    problem : Problem
        Unconstrained; its targets play no part.
    parameters : Parameters
    growth : Growth
    k, r : int
    about : dict
        What makes it again.
    """

    problem: Problem
    parameters: Parameters
    growth: Growth
    k: int
    r: int
    about: dict[str, Any]

    def worst(self) -> float:
        """Return the largest ``cost(LPC)/cost(OPT) - 1`` over targets and x_0."""
        from ...lowerbounds.worst_case import worst_case

        return worst_case(self.problem, self.k, self.r).cr_minus_one

    def setting(self) -> Any:
        """Return the setting that theorems are asked about."""
        from ...bounds.setting import Setting

        return Setting(self.parameters, self.growth, self.k, self.r, unconstrained=True)


def sample(
    rng: np.random.Generator,
    a: tuple[float, float] = (-2.0, 1.0),
    x: tuple[float, float] = (-2.0, 1.0),
    graphs: tuple[str, ...] = GRAPHS,
    k: tuple[int, int] = (2, 4),
    r: tuple[int, int] = (1, 3),
    H: int = 5,
) -> Sample:
    """Draw one: powers of ten for ``l_T/mu`` and ``Delta l_S/mu``, one of them 0 now and then."""
    from ...lpc.instances import instance

    name = str(rng.choice(graphs))
    network = parse_graph(name)
    a_T, strength = 10 ** rng.uniform(*a), 10 ** rng.uniform(*x)
    none = rng.random()
    a_T = 0.0 if none < 0.08 else a_T
    strength = 0.0 if none > 0.92 else strength
    l_f = float(rng.choice([1.0, 1.0, 3.0, 10.0]))
    parameters = Parameters(1.0, l_f, a_T, strength / network.max_degree)
    style, varying = str(rng.choice(STYLES)), bool(rng.random() < 0.5)
    steps, seed = int(rng.integers(2, H + 1)), int(rng.integers(1000))
    problem = instance(network, steps, parameters, style=style, varying=varying, seed=seed)
    kk, rr = int(rng.integers(k[0], k[1] + 1)), int(rng.integers(r[0], r[1] + 1))
    about = {"graph": name, "H": steps, "mu": 1, "l_f": l_f, "l_T": a_T, "l_S": parameters.l_S}
    about |= {"style": style, "varying": varying, "seed": seed, "k": kk, "r": rr}
    return Sample(problem, parameters, network_growth(network), kk, rr, about)


def certificate(given: Sample, variant: str, measured: float | None = None) -> float:
    """Return the bound of ``nearsight:sharp-cr`` on ``CR - 1``, infinite where it does not close.

    In plain floats, which is fast; as exactly as the theorem computes it if it does not exceed the
    measured ratio by more than a millionth.
    """
    from ...bounds.certificate import best_shares, closing, cost_gap, excess_ratio, step_error
    from ...bounds.formula import plain_floats

    s = given.setting()
    c, eta = s.couplings, s.growth.eta(s.r)
    shares = best_shares(variant, c, eta, s.k, s.r)
    with plain_floats():
        error = step_error(c, eta, s.k, s.r, shares)
        gap = cost_gap(variant, c, s.k, error)
        open_ = not max(map(float, closing(c, gap, error))) > 0
        found = np.inf if open_ else float(excess_ratio(c, gap, error))
    if measured is not None and not measured < found * (1 - 1e-6):
        return promised("nearsight:sharp-cr", "sharp", given, variant)
    return found


def promised(label: str, tier: str, given: Sample, variant: str = "") -> float:
    """Return what a theorem promises for ``CR - 1``, infinite where it promises nothing."""
    from ...bounds import bounds_for

    (bound,) = (b for b in bounds_for(label) if (b.tier, b.variant) == (tier, variant))
    value = bound.evaluate(given.setting()).values["cr_minus_one"]
    return np.inf if value is None or np.isnan(value) else float(value)
