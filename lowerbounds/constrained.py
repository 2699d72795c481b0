"""Bad instances that are not quadratic, or have constraints: a local search, nothing more."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from ..graphs import InputError
from ..lpc.arrays import Floats, integer, spread
from ..lpc.costs import Cost, LogCosh, Quadratic
from ..lpc.problem import Problem
from ..lpc.sets import Box
from ..lpc.simulation import Simulation, simulate

Progress = Callable[[str], None]
KINDS = ("box", "smooth")
WIDE = 2.0  # of the largest target: boxes begin so far away


@dataclass(frozen=True, eq=False)
class Constrained:
    """The worst instance of a heuristic search, and what LPC does there.

    Parameters
    ----------
    problem : Problem
        With the constants mu, l_f, l_T, l_S of the problem that the search began with, or milder.
    ratio_minus_one : float
        ``cost(LPC)/cost(OPT) - 1`` there: no smaller than this, whatever the solvers did.
    upper : float
        And no larger than this.
    start : float
        The ratio minus 1 where the search began.
    history : tuple of float
        The best ratio after every evaluation.
    """

    problem: Problem
    ratio_minus_one: float
    upper: float
    start: float
    history: tuple[float, ...]


def search_constrained(
    problem: Problem,
    k: int,
    r: int,
    *,
    kind: str = "box",
    evaluations: int = 150,
    seed: int = 0,
    progress: Progress | None = None,
) -> Constrained:
    """Climb the ratio of LPC over data and boxes, or data and bends, around a quadratic problem.

    Every evaluation plays LPC and solves for the optimum, so that a ratio found is a fact; but the
    search is random hill climbing (an evolution strategy of one), which gets stuck like all of
    them. It gives a lower bracket of the worst case over constrained or smooth costs: how far from
    it, nobody knows.

    Parameters
    ----------
    problem : Problem
        Quadratic and unconstrained, best the worst instance of `worst_case`.
    k, r : int
        Prediction horizon and communication radius.
    kind : {"box", "smooth"}
        ``"box"``: every action between two numbers, searched along with the targets.
        ``"smooth"``: every pair cost ``w'Pw/2`` becomes ``sum_j e_j log cosh(p_j . w - b_j)``
        with the eigenvalues and eigenvectors of P, which is as smooth; the bends b are searched
        along with the targets.
    evaluations : int
        How many instances are played, at least 1.
    seed : int
        Of the search.
    progress : callable, optional
        Called with a short text now and then.

    Raises
    ------
    InputError
        If the problem is not quadratic or has constraints, or an argument is out of range.
    """
    if kind not in KINDS:
        raise InputError(f"kind = {kind!r}: one of {', '.join(KINDS)}", "kind")
    integer(evaluations, "evaluations", 1)
    build, point = (_boxes if kind == "box" else _bends)(problem)
    rng = np.random.default_rng(seed)
    best = simulate(build(point), k, r)
    start = _ratio(best)
    history = [start]
    sigma = 0.3
    for i in range(1, evaluations):
        moved = rng.random(point.size) < rng.choice([1.0, 0.3, 0.1])
        there = point + sigma * moved * rng.normal(size=point.size)
        run = simulate(build(there), k, r)
        if _ratio(run) > _ratio(best):
            best, point, sigma = run, there, min(1.0, 1.5 * sigma)
        else:
            sigma = max(0.01, 0.95 * sigma)
        history.append(_ratio(best))
        if progress is not None:
            progress(f"{kind}, instance {i + 1}/{evaluations}: ratio - 1 = {history[-1]:.6g}")
    return Constrained(best.problem, _ratio(best), best.interval[1], start, tuple(history))


def _ratio(run: Simulation) -> float:
    return run.ratio_minus_one if run.determined else 0.0


Build = Callable[[Floats], Problem]


def _quadratic(problem: Problem) -> tuple[Quadratic, Quadratic, Quadratic]:
    node, temporal, spatial = problem.node, problem.temporal, problem.spatial
    if not (
        isinstance(node, Quadratic)
        and isinstance(temporal, Quadratic)
        and isinstance(spatial, Quadratic)
        and problem.feasible.everywhere
    ):
        raise InputError("a search begins with quadratic costs without constraints")
    return node, temporal, spatial


def _targets(problem: Problem, node: Quadratic) -> tuple[Floats, float]:
    """Return all targets, shape (H, N, n), and their unit."""
    theta = np.array(spread(node.centre, problem.H, problem.N))
    return theta, float(np.abs(theta).max()) or 1.0


def _boxes(problem: Problem) -> tuple[Build, Floats]:
    """Return point -> problem for targets, and the logarithms of the two reaches of boxes."""
    node, _, _ = _quadratic(problem)
    theta, unit = _targets(problem, node)
    size, shape = theta.size, theta.shape

    def build(point: Floats) -> Problem:
        targets = theta + unit * point[:size].reshape(shape)
        low, high = (WIDE * unit * np.exp(p).reshape(shape) for p in np.split(point[size:], 2))
        return replace(problem, node=Quadratic(node.matrix, targets), feasible=Box(-low, high))

    return build, np.zeros(3 * size)


def _bends(problem: Problem) -> tuple[Build, Floats]:
    """Return point -> problem for targets, and the bends of all pair costs."""
    node, temporal, spatial = _quadratic(problem)
    theta, unit = _targets(problem, node)
    size, H, n = theta.size, problem.H, problem.n
    counts = (problem.N, max(len(problem.edges), 1))
    shapes = [(H, count, 2 * n) for count in counts]
    forms = [_form(cost) for cost in (temporal, spatial)]
    cut = size + int(np.prod(shapes[0]))

    def build(point: Floats) -> Problem:
        targets = theta / unit + point[:size].reshape(theta.shape)
        bends = point[size:cut].reshape(shapes[0]), point[cut:].reshape(shapes[1])
        pairs: list[Cost] = [
            LogCosh(directions, b, weights)
            for (directions, weights), b in zip(forms, bends, strict=True)
        ]
        return replace(
            problem,
            node=Quadratic(node.matrix, targets),
            temporal=pairs[0],
            spatial=pairs[1],
            x_0=problem.x_0 / unit,
        )

    return build, np.zeros(cut + int(np.prod(shapes[1])))


def _form(cost: Quadratic) -> tuple[Floats, Floats]:
    """Return the eigenvectors as rows, and the eigenvalues, of all matrices."""
    values, vectors = np.linalg.eigh(cost.matrix)
    return vectors.swapaxes(-1, -2), np.maximum(values, 0.0)
