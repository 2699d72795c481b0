"""Set-points of a power network: plan how far every bus has to look, then look that far.

Every bus follows a daily target. Ramping from hour to hour costs, so do differences across a
line, and a bus has a capacity. All costs are quadratic; their constants are read off the problem.
"""

from dataclasses import asdict
from pathlib import Path

import numpy as np

import nearsight as ns
from nearsight.lpc.constants import constants

DATA = Path(__file__).parent / "data" / "ieee118.graphml"
HOURS = 24
TARGET = 1.01  # at most 1 % above the cost of knowing the whole day


def day(network: ns.Network) -> tuple[ns.Problem, ns.Box]:
    """Return one day of the network, and its capacities; actions are the set-points."""
    rng = np.random.default_rng(118)
    buses = network.vertices
    size = rng.uniform(0.5, 2.0, buses)
    phase = rng.uniform(0.0, 2 * np.pi, buses)
    hour = 2 * np.pi * np.arange(HOURS)[:, None] / HOURS
    target = size * (1 + 0.6 * np.sin(hour + phase) + 0.3 * rng.normal(size=(HOURS, buses)))
    weight = rng.uniform(1.0, 4.0, buses)
    capacities = ns.Box(0.0, 1.2 * size[:, None])
    difference = np.array([[1.0, -1.0], [-1.0, 1.0]])  # w'Pw = (w_1 - w_2)^2
    problem = ns.Problem(
        network,
        HOURS,
        node=ns.Quadratic(weight[:, None, None], target[:, :, None]),  # m (x - target)^2 / 2
        temporal=ns.Quadratic(0.5 * difference),  # ramping: (x_t - x_{t-1})^2 / 4
        spatial=ns.Quadratic(0.05 * difference),  # lines: (x_u - x_v)^2 / 40
        feasible=capacities,
        x_0=target[0][:, None],
    )
    return problem, capacities


def main() -> None:
    """Plan, run and compare."""
    network = ns.parse_graph(str(DATA))
    problem, capacities = day(network)
    found = constants(problem).parameters()
    print(f"{network.vertices} buses, {network.edges} lines, {HOURS} hours")
    print(", ".join(f"{name} = {value:.4g}" for name, value in asdict(found).items()))

    best = ns.plan(**asdict(found), graph=network, target=TARGET)["sharp"].pair
    if best is None:
        raise SystemExit(f"no k and r are known to reach {TARGET}")
    print(f"plan for a ratio of {TARGET}: k = {best.k} hours ahead, r = {best.r} lines around")

    run = ns.simulate(problem, k=best.k, r=best.r)
    print(f"promised ratio - 1: at most {best.excess:.3g}")
    print(f"measured ratio - 1: {run.ratio_minus_one:.3g}")
    full = np.mean(run.x == capacities.upper)
    print(f"set-points at their capacity: {100 * full:.1f} %")


if __name__ == "__main__":
    main()
