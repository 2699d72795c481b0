"""The local problem of one agent, for any boundary values."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..graphs import InputError
from .arrays import Floats
from .information import InformationSet, information_set
from .minimisers import minimisers_at
from .problem import Problem
from .terms import Terms
from .window import Window


@dataclass(frozen=True, eq=False)
class LocalProblem(Window):
    """``psi_(t,v)^(k,r)(y, z)``: what agent v would have everybody near it do from step t on.

    The free actions are those of ``N_(t,v)^(k-1,r-1)``; y are the actions of ``{t-1} x N_v^r``
    and z those of ``partial N_(t,v)^(k,r)``, rows in the order of
    `information_set`. Every boundary pair has a row in z, also those that touch no free action,
    or lie beyond the horizon, and so have no effect.

    Parameters
    ----------
    problem : Problem
    t, v : int
        The step, 1..H, and the agent that decides.
    k, r : int
        Prediction horizon ``>= 1`` and communication radius ``>= 0``; with ``k = 1`` or ``r = 0``
        nothing is free.

    Raises
    ------
    InputError
        If a number is out of range.

    References
    ----------
    Paper, equation (2) (``equ:LPC-opt-problem``).
    """

    information: InformationSet

    def __init__(self, problem: Problem, t: int, v: int, k: int, r: int) -> None:
        if not 1 <= t <= problem.H:
            raise InputError(f"t = {t}: there are the steps 1..{problem.H}", "t")
        known = information_set(problem.network, t, v, k, r)
        inside = known.free[known.free[:, 0] <= problem.H]
        free = np.concatenate([np.zeros((len(inside), 1), dtype=np.int64), inside], axis=1)
        parts = {
            "problem": problem,
            "terms": Terms.of(problem, free),
            "free": known.free,
            "bottom": known.bottom,
            "boundary": known.boundary,
            "information": known,
        }
        for name, value in parts.items():
            object.__setattr__(self, name, value)

    def default_boundary(self, x_prev: Floats) -> tuple[Floats, Floats]:
        """Return the ``(y, z)`` that LPC uses: previous actions, and node minimisers.

        Beyond the horizon the minimiser is 0.

        Parameters
        ----------
        x_prev : ndarray, shape (N, n)
            The actions of all agents at step ``t - 1``.
        """
        z = np.zeros((len(self.boundary), self.problem.n))
        inside = self.boundary[:, 0] <= self.problem.H
        t, v = self.boundary[inside].T
        z[inside] = minimisers_at(self.problem, t, v)
        return np.asarray(x_prev, dtype=np.float64)[self.bottom[:, 1]], z

    def action(self, x: Floats) -> Floats:
        """Return the action of agent v at step t from an answer, shape (n,)."""
        if not len(self.free):
            raise InputError("nothing is free: LPC needs k >= 2 and r >= 1 to decide here")
        own: Floats = x[0]  # the pairs are ordered by step, then by distance from v
        return own
