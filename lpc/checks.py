"""Is a problem what it is said to be? Its class compared, its claims tested."""

from __future__ import annotations

import numpy as np

from ..bounds import Parameters
from ..graphs import InputError
from .arrays import Floats
from .constants import Constants, Extreme, constants
from .costs import Cost, Probed, probe
from .problem import Problem

MEANING = {
    "mu": ("node", "strong convexity"),
    "l_f": ("node", "smoothness"),
    "l_T": ("temporal", "smoothness"),
    "l_S": ("spatial", "smoothness"),
}


def check_class(problem: Problem, parameters: Parameters) -> Constants:
    """Test whether a problem is in the class of typed-in constants.

    It is if ``mu`` is at most the derived one, and ``l_f, l_T, l_S`` are at least the derived
    ones, up to the errors with which those are known.

    Returns
    -------
    Constants
        The derived ones.

    Raises
    ------
    InputError
        If it is not, with the step and the member that leave the class.
    """
    found = constants(problem)
    for name, (kind, word) in MEANING.items():
        derived: Extreme = getattr(found, name)
        typed = np.asarray(getattr(parameters, name), dtype=np.float64)
        least = name == "mu"
        given = float(typed.max() if least else typed.min())
        if given <= derived.above if least else given >= derived.below:
            continue
        limit = f"{'<=' if least else '>='} {derived.value:.17g}"
        verb = {"exact": "is", "bound": "is only known to be", "claimed": "is said to be"}
        raise InputError(
            f"{name} = {given:.17g}: the {word} of the {kind} cost at {derived.place} "
            f"{verb[derived.source]} {derived.value:.17g}; {name} {limit} is needed",
            name,
        )
    return found


def check_claims(problem: Problem, samples: int = 512, seed: int = 0) -> dict[str, Probed]:
    """Try to refute what is said of the costs, at random points, their minima and near bounds.

    Tested are: curvature within its bounds; gradients and Hessians that are those of the values;
    and that no cost is negative (Assumption 2.1). Nothing is proven by it.

    Parameters
    ----------
    problem : Problem
    samples : int
        Random points of each kind of cost.
    seed : int
        Of those points.

    Returns
    -------
    dict
        What was seen, by ``"node"``, ``"temporal"`` and ``"spatial"`` (left out without edges).

    Raises
    ------
    InputError
        With the cost, the step, the agent or edge, and the point that refute a claim.
    """
    if samples < 1:
        raise InputError(f"samples = {samples}: at least 1 is needed", "samples")
    near = _feasible(problem, samples, seed)
    pairs = np.concatenate([near, near[::-1]], axis=1)
    found = {}
    for name, count, points in (
        ("node", problem.N, near),
        ("temporal", problem.N, pairs),
        ("spatial", len(problem.edges), pairs),
    ):
        if not count:
            continue
        cost: Cost = getattr(problem, name)
        member = "edge" if name == "spatial" else "agent"
        found[name] = probe(
            *(cost, problem.H, count, f"{name} cost"),
            samples=samples,
            seed=seed,
            near=points,
            member=member,
        )
    return found


def _feasible(problem: Problem, samples: int, seed: int) -> Floats:
    """Return points of the feasible sets, half of them at boundaries where those are near."""
    rng = np.random.default_rng([seed, 1])
    t, v = rng.integers(1, problem.H + 1, samples), rng.integers(0, problem.N, samples)
    y = rng.standard_normal((samples, problem.n)) * 10 ** rng.uniform(-1, 3, (samples, 1))
    feasible = problem.feasible
    if feasible.projectable:
        return np.array(feasible.project(t, v, y))
    try:
        inside = np.broadcast_to(feasible.interior(t, v), y.shape)
    except InputError:
        return y
    for _ in range(60):
        outside = ~(feasible.violation(t, v, y) <= 0)
        if not outside.any():
            break
        y = np.where(outside[:, None], 0.5 * (y + inside), y)
    return y
