"""LPC from the first step to the last, beside the clairvoyant optimum."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from os import PathLike
from pathlib import Path

import numpy as np

from ..graphs import InputError
from .arrays import Floats
from .certify import EPS
from .checkpoint import Checkpoint
from .controller import Controller
from .excess import Measured, measured_cost, measured_excess
from .offline import Optimum, optimum
from .problem import Problem

Progress = Callable[[str, int, int], None]
TINY = 1e-290  # costs below it may have lost products that are not representable


@dataclass(frozen=True, eq=False)
class Simulation:
    """What LPC played, what it cost, and how far from the optimum that is.

    Parameters
    ----------
    problem : Problem
    k, r : int
        Prediction horizon and communication radius.
    x : ndarray, shape (H, N, n)
        The actions of steps 1..H.
    optimum : Optimum
        The clairvoyant optimum with its certificate.
    costs : dict
        ``"node"``, ``"temporal"``, ``"spatial"``, each of shape (H,).
    excess : float
        ``cost(x) - optimum.cost``, accurate also where the two are nearly equal.
    action_error : float
        The largest error of an action that the local solvers admit, up to rounding.
    method : str
        How the local problems were solved.
    seconds : dict
        Wall-clock time of ``"lpc"`` and ``"optimum"``; steps read from a checkpoint take none.
    excess_error : float
        What rounding may have done to `excess`.
    """

    problem: Problem
    k: int
    r: int
    x: Floats
    optimum: Optimum
    costs: dict[str, Floats]
    excess: float
    action_error: float
    method: str
    seconds: dict[str, float] = field(default_factory=dict)
    excess_error: float = 0.0

    @property
    def cost(self) -> float:
        """The total cost of the actions."""
        return float(sum(part.sum() for part in self.costs.values()))

    @cached_property
    def _best(self) -> Measured:
        """The cost of the optimum found, more accurately than `optimum` has it."""
        return measured_cost(self.problem, self.optimum.x)

    @cached_property
    def _nothing(self) -> bool:
        """Whether nothing is paid: no product of small numbers has vanished, either."""
        if self.cost or self.optimum.cost or self.optimum.gap:
            return False
        return self._best.nothing and measured_cost(self.problem, self.x).nothing

    @property
    def _least(self) -> float:
        """A lower bound on the cost of the true optimum; 0 where products may have vanished."""
        best = self._best
        return max(best.value - best.error - self.optimum.gap, 0.0) if best.value >= TINY else 0.0

    @property
    def determined(self) -> bool:
        """Whether there is a ratio to speak of: the optimum is certainly 0, or certainly not."""
        return self._least > 0 or self._nothing

    @property
    def ratio(self) -> float:
        """``cost(LPC) / cost(OPT)``: 1 if both are 0, NaN if it is not `determined`."""
        return 1.0 + self.ratio_minus_one

    @property
    def ratio_minus_one(self) -> float:
        """``cost(LPC) / cost(OPT) - 1``, without cancellation."""
        if not self.determined:
            return float("nan")
        return 0.0 if self._nothing else max(self.excess, 0.0) / self._best.value

    @property
    def interval(self) -> tuple[float, float]:
        """Where ``cost(LPC)/cost(OPT) - 1`` of these actions lies.

        The optimum found is at most ``gap`` above the true one, which is at least 0. Rounding is
        in it, too: proven for quadratic costs, estimated for others, see `Measured`.
        """
        if self._nothing:
            return 0.0, 0.0
        best, doubt = self._best, self.excess_error
        if best.value < TINY:
            return 0.0, float("inf")
        lower = max(self.excess - doubt, 0.0) / (best.value + best.error)
        if not self._least > 0:
            return lower, float("inf")
        upper = (max(self.excess + doubt, 0.0) + self.optimum.gap) / self._least
        return lower * (1 - 4 * EPS), upper * (1 + 4 * EPS)

    @property
    def violation(self) -> float:
        """The largest distance of an action from its feasible set; 0 if there is none."""
        agents, worst = np.arange(self.problem.N), 0.0
        for s, actions in enumerate(self.x):
            t = np.full(self.problem.N, s + 1)
            found = self.problem.feasible.violation(t, agents, actions)
            worst = max(worst, float(found.max(initial=0.0)))
        return worst


def simulate(
    problem: Problem,
    k: int,
    r: int,
    *,
    method: str = "auto",
    workers: int = 1,
    tolerance: float = 1e-9,
    checkpoint: str | PathLike[str] | None = None,
    progress: Progress | None = None,
) -> Simulation:
    """Run LPC on a problem and compare it with the clairvoyant optimum.

    Parameters
    ----------
    problem : Problem
    k : int
        Prediction horizon, at least 1.
    r : int
        Communication radius, at least 0.
    method, workers, tolerance
        See `Controller`.
    checkpoint : path, optional
        A file that takes every completed step; if it is there already, the simulation goes on
        after the last step in it, with the same result as without interruption.
    progress : callable, optional
        Called as ``progress(what, done, total)``.

    Raises
    ------
    InputError
        If an argument cannot be used, or the checkpoint is of another simulation.

    Examples
    --------
    >>> import nearsight as ns
    >>> from nearsight.lpc import instance, simulate
    >>> network = ns.parse_graph("ring:13")
    >>> ring = instance(network, 12, ns.Parameters(1, 1, 1, 0.5), seed=1)
    >>> simulate(ring, k=3, r=2).ratio < 1.001
    True
    """
    controller = Controller(problem, k, r, method, workers, tolerance)
    start = time.perf_counter()
    x, error = _play(controller, checkpoint, progress)
    middle = time.perf_counter()
    best = optimum(problem, progress=_offline(progress))
    more = measured_excess(problem, x, best.x)
    return Simulation(
        problem,
        k,
        r,
        x,
        best,
        problem.costs(x),
        more.value,
        error,
        controller.method,
        {"lpc": middle - start, "optimum": time.perf_counter() - middle},
        more.error,
    )


def _play(
    controller: Controller, checkpoint: str | PathLike[str] | None, progress: Progress | None
) -> tuple[Floats, float]:
    """Return the actions, and the largest of the errors that the solvers admit."""
    problem = controller.problem
    x = np.empty((problem.H, problem.N, problem.n))
    kept = None if checkpoint is None else Checkpoint(Path(checkpoint), controller)
    first, worst = 0, 0.0
    if kept is not None:
        first = len(kept.done)
        x[:first] = kept.done
        worst = float(kept.errors.max(initial=0.0))
    try:
        for s in range(first, problem.H):
            x[s] = controller.step(s + 1, x[s - 1] if s else problem.x_0)
            if not np.isfinite(x[s]).all():
                raise InputError(
                    f"step {s + 1}: an action is not finite; the costs overflow near the targets"
                )
            error = float(np.max(controller.error, initial=0.0))
            worst = max(worst, error)
            if kept is not None:
                kept.add(x[s], error)
            if progress is not None:
                progress("step", s + 1, problem.H)
    finally:
        if kept is not None:
            kept.close()
    return x, worst


def _offline(progress: Progress | None) -> Callable[[int, float], None] | None:
    if progress is None:
        return None
    return lambda iteration, _: progress("optimum, iteration", iteration, 0)
