"""What a search has found: a problem that anybody can solve again."""

from __future__ import annotations

import os
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np

from ..bounds import Parameters
from ..graphs import InputError
from ..lpc.arrays import Floats
from ..lpc.files import load_problem, save_problem
from ..lpc.problem import Problem
from ..lpc.window import Window
from .sensitivity import sensitivity
from .target import Target, place, ratio, window_at


@dataclass(frozen=True, eq=False)
class Found:
    """The largest sensitivity that a search has seen, and a problem that has it.

    Parameters
    ----------
    value : float
        The spectral norm of the block.
    window : Window
        Of `problem`.
    target : Target
        Which block.
    parameters : Parameters
        The constants of the class; those of the problem are within them.
    bounds : dict
        What each tier promises for the block, see `promises`.
    theta : ndarray
        The parameters of its `Couplings`.
    evaluations : int
        How many problems were looked at.
    """

    value: float
    window: Window
    target: Target
    parameters: Parameters
    bounds: Mapping[str, float]
    theta: Floats
    evaluations: int

    @property
    def problem(self) -> Problem:
        """A problem of quadratic costs, targets 0, no constraints."""
        return self.window.problem

    @property
    def ratios(self) -> dict[str, float]:
        """``value / bound`` of each tier, infinite where only the bound is 0."""
        return {tier: ratio(self.value, bound) for tier, bound in self.bounds.items()}

    def measured(self) -> float:
        """Return the value by `sensitivity`, which knows nothing of the search."""
        return measured(self.window, self.target)

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the problem to a file, with all that `replay` needs beside it.

        The metadata are ``window`` (``kind``, and ``t, v, k, r`` or ``t, p``), ``free`` and
        ``fixed`` (step, agent or null), ``value``, ``constants`` and ``bounds``.
        """
        p = self.parameters
        names = ("mu", "l_f", "l_T", "l_S")
        notes = {
            "window": place(self.window),
            "free": _plain(self.target.free),
            "fixed": _plain(self.target.fixed),
            "value": self.value,
            "constants": {name: float(getattr(p, name)) for name in names},
            "bounds": dict(self.bounds),
        }
        save_problem(self.problem, path, notes)


class Replayed(NamedTuple):
    """The value that a file tells, the value measured now, and where."""

    told: float
    measured: float
    window: Window
    target: Target
    bounds: dict[str, float]


def replay(path: str | os.PathLike[str]) -> Replayed:
    """Measure again what `Found.save` has written.

    Raises
    ------
    InputError
        If the file is no problem, or was not written by `Found.save`.
    """
    problem, notes = load_problem(path)
    try:
        free, fixed = (_pair(notes[name]) for name in ("free", "fixed"))
        target = Target(free, fixed)
        window = window_at(problem, notes["window"])
        told, bounds = float(notes["value"]), dict(notes["bounds"])
    except (KeyError, TypeError, ValueError) as error:
        raise InputError(f"{path}: not a problem that a search has found") from error
    return Replayed(told, measured(window, target), window, target, bounds)


def measured(window: Window, target: Target) -> float:
    """Return the spectral norm of a block of the sensitivity at zero boundary values."""
    rows, columns = target.rows(window.terms), target.columns(window.terms)
    y, z = (np.zeros((len(pairs), window.problem.n)) for pairs in (window.bottom, window.boundary))
    block = sensitivity(window, y, z).derivative[rows][:, :, columns]
    n = window.problem.n
    return float(np.linalg.norm(block.reshape(len(rows) * n, len(columns) * n), 2))


def _plain(pair: tuple[int, int | None]) -> list[int | None]:
    return [None if value is None else int(value) for value in pair]


def _pair(value: Any) -> tuple[int, int | None]:
    step, agent = value
    return int(step), None if agent is None else int(agent)
