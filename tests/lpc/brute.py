"""Problems of `nearsight.lpc` made from the instances of the brute-force oracle."""

import numpy as np

from nearsight.lpc import Box, Problem, Quadratic

from ..bounds import oracles as oracle


def grams(factors):
    return np.einsum("...ji,...jk->...ik", factors, factors)


def problem_of(instance, network, omega, box=None):
    """The problem and data (x_0, targets) of one omega; no shifts."""
    H, N, n = instance.H, network.vertices, instance.n
    x_0, theta = omega[: N * n].reshape(N, n), omega[N * n :].reshape(H, N, n)
    swap = np.r_[n : 2 * n, :n]  # the oracle lists (x_{t-1}, x_t)
    temporal = grams(instance.temporal)[..., swap, :][..., swap]
    costs = (Quadratic(grams(instance.node), theta), Quadratic(temporal))
    spatial = Quadratic(grams(instance.spatial)) if len(instance.graph.edges) else None
    sets = {} if box is None else {"feasible": Box(-box, box)}
    return Problem(network, H, *costs, spatial, x_0=x_0, **sets)


def played(controller):
    """All steps, shape (H, N, n)."""
    problem = controller.problem
    x, before = [], problem.x_0
    for t in range(1, problem.H + 1):
        before = controller.step(t, before)
        x.append(before)
    return np.array(x)


__all__ = ["grams", "oracle", "played", "problem_of"]
