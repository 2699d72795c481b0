"""Costs of one's own on a random graph, and how the ratio falls with k and r.

Node and temporal costs are quadratics with full blocks, given as arrays; the spatial cost is a
SymPy formula that is not quadratic, with what its author knows of its curvature.
"""

import numpy as np
import sympy

import nearsight as ns
from nearsight.lpc.costs import Symbolic

STEPS, N_ENTRIES = 10, 2
HORIZONS, RADII = (1, 2, 3, 4), (1, 2, 3)  # k = 1: every agent for itself


def node_costs(rng: np.random.Generator, agents: int) -> ns.Quadratic:
    """Return (x - target)' P (x - target) / 2, a positive definite P for every agent."""
    root = rng.normal(size=(agents, N_ENTRIES, N_ENTRIES))
    blocks = np.eye(N_ENTRIES) + 0.5 * root @ root.swapaxes(-1, -2)
    return ns.Quadratic(blocks, rng.normal(size=(STEPS, agents, N_ENTRIES)))


def temporal_costs(rng: np.random.Generator, agents: int) -> ns.Quadratic:
    """Return w'Pw/2 of w = (x_t, x_{t-1}), P a positive semidefinite block of 4 by 4."""
    root = rng.normal(size=(agents, 2 * N_ENTRIES, N_ENTRIES))
    return ns.Quadratic(0.3 * root @ root.swapaxes(-1, -2))


def spatial_costs(rng: np.random.Generator, edges: int) -> Symbolic:
    """Return weight (sqrt(1 + |x - y|^2) - 1): neighbours agree, but outliers are forgiven."""
    x_1, x_2, y_1, y_2, weight = sympy.symbols("x_1 x_2 y_1 y_2 weight")
    formula = weight * (sympy.sqrt(1 + (x_1 - y_1) ** 2 + (x_2 - y_2) ** 2) - 1)
    weights = rng.uniform(0.2, 1.0, edges)
    # the Hessian of sqrt(1 + |z|^2) is at most I, and (x, y) -> x - y doubles that
    return Symbolic(formula, [x_1, x_2, y_1, y_2], {"weight": weights}, upper=2 * weights)


def main() -> None:
    """Print the ratio at every k and r."""
    network = ns.parse_graph("geometric:25x0.25", seed=5)
    rng = np.random.default_rng(5)
    problem = ns.Problem(
        network,
        STEPS,
        node_costs(rng, network.vertices),
        temporal_costs(rng, network.vertices),
        spatial_costs(rng, network.edges),
    )
    print(f"{network.vertices} agents, {network.edges} edges, {STEPS} steps; ratio - 1")
    print("       " + "".join(f"{f'r = {r}':>10}" for r in RADII))
    for k in HORIZONS:
        found = [ns.simulate(problem, k=k, r=r, tolerance=1e-7).ratio_minus_one for r in RADII]
        print(f"k = {k}  " + "".join(f"{value:10.2e}" for value in found))


if __name__ == "__main__":
    main()
