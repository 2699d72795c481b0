"""The global problems of the perturbation analysis: a window of steps, all agents."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..graphs import InputError
from .arrays import Ints
from .problem import Problem
from .whole import whole
from .window import Window


@dataclass(frozen=True, eq=False)
class GlobalProblem(Window):
    """``psi~_t^p(y, z)``, from ``x_{t-1} = y`` to ``x_{t+p-1} = z``, or ``psi~_t(y)``, to the end.

    The free actions are those of all agents at the steps ``t..t+p-2``, or ``t..H`` without p, by
    step and agent. y has a row for each agent; so has z, or none without p. The paper's answer
    also lists ``x_{t+p-1}``, which is z.

    Parameters
    ----------
    problem : Problem
    t : int
        The first step, 1..H.
    p : int, optional
        ``>= 2``; until the end if omitted.

    Raises
    ------
    InputError
        If a number is out of range.

    References
    ----------
    Paper, Appendix A, equations (``equ:global-opt-problem``,
    ``equ:global-opt-problem-until-end``).
    """

    def __init__(self, problem: Problem, t: int, p: int | None = None) -> None:
        if not 1 <= t <= problem.H:
            raise InputError(f"t = {t}: there are the steps 1..{problem.H}", "t")
        if p is not None and p < 2:
            raise InputError(f"p = {p}: with less than 2 steps nothing is free", "p")
        last = problem.H if p is None else t + p - 2
        parts = {
            "problem": problem,
            "terms": whole(problem, t, min(last, problem.H)),
            "free": _steps(range(t, last + 1), problem.N),
            "bottom": _steps(range(t - 1, t), problem.N),
            "boundary": _steps(range(last + 1, last + 1 + (p is not None)), problem.N),
        }
        for name, value in parts.items():
            object.__setattr__(self, name, value)


def _steps(steps: range, N: int) -> Ints:
    """Return the (step, agent) of some steps and all agents."""
    t = np.repeat(np.array(steps, dtype=np.int64), N)
    return np.stack([t, np.tile(np.arange(N), len(steps))], axis=1)
