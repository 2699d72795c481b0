"""Which block of a sensitivity is meant, and what the theorems promise for it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from ..bounds import Parameters, Setting, bounds_for
from ..graphs import Growth, InputError, Network
from ..lpc.arrays import Ints
from ..lpc.global_problem import GlobalProblem
from ..lpc.local import LocalProblem
from ..lpc.problem import Problem
from ..lpc.terms import Terms
from ..lpc.window import Window
from .promised import TIERS, Promised


@dataclass(frozen=True)
class Target:
    """The sensitivity of a free action, or slice, to a fixed one.

    Parameters
    ----------
    free, fixed : tuple of (int, int or None)
        (step, agent); without an agent the whole time slice, as far as it is free, or touches a
        free action.
    """

    free: tuple[int, int | None]
    fixed: tuple[int, int | None]

    def rows(self, terms: Terms) -> Ints:
        """Return the rows of ``terms.free``; raise `InputError` if there are none."""
        return _rows(terms.free, self.free, "free", "is not free within the horizon")

    def columns(self, terms: Terms) -> Ints:
        """Return the rows of ``terms.fixed``; raise `InputError` if there are none."""
        return _rows(terms.fixed, self.fixed, "fixed", "is not fixed next to a free action")

    @property
    def single(self) -> bool:
        """Whether it is one action to one action."""
        return self.free[1] is not None and self.fixed[1] is not None


def part_of(terms: Terms, step: int) -> str:
    """Return which part of the boundary a fixed action of some step belongs to."""
    steps = terms.free[:, 1]
    return "bottom" if step < steps.min() else "top" if step > steps.max() else "lateral"


def separation(window: Window, target: Target) -> tuple[str, int, int | None]:
    """Return the part of the boundary, ``|t0 - tau|`` and ``d(v0, u)``.

    The last is None for slices, and where there is no path.
    """
    part = part_of(window.terms, target.fixed[0])
    gap = abs(target.free[0] - target.fixed[0])
    return part, gap, _hops(window.problem.network, target) if target.single else None


def promises(
    window: Window, target: Target, parameters: Parameters, growth: Growth
) -> dict[str, float]:
    """Return what each tier of the theorems promises for a block, at the constants of the class.

    For a `GlobalProblem` that is ``C_G rho_G^d`` of ``thm:global-exp-decay``, which speaks of
    slices and so of their parts. For one action to one action of another window it is the local
    bound, see `Promised`; no theorem speaks of other blocks there, and nothing is returned.
    """
    part, gap, hops = separation(window, target)
    if isinstance(window, GlobalProblem):
        setting = Setting(parameters, growth)
        found: dict[str, float] = {}
        for bound in bounds_for("thm:global-exp-decay"):
            values = bound.in_floats(setting)
            found[bound.tier] = float(values["C_G"] * values["rho_G"] ** gap)
        return {tier: found[tier] for tier in TIERS}
    if hops is None:
        return {}
    each = Promised(parameters, growth).bounds(part, np.array([gap]), np.array([hops]))
    return {tier: float(values[0]) for tier, values in each.items()}


def ratio(value: float, bound: float) -> float:
    """Return ``value / bound``: 0 for 0/0, infinite where only the bound is 0."""
    if value == 0:
        return 0.0
    return float(value / bound) if bound > 0 else float("inf")


def place(window: Window) -> dict[str, Any]:
    """Return the numbers that name a window: t, v, k, r of a local, t, p of a global problem."""
    if isinstance(window, LocalProblem):
        at = window.information
        return {"kind": "local", "t": at.t, "v": int(at.v), "k": at.k, "r": at.r}
    if isinstance(window, GlobalProblem):
        t = int(window.bottom[0, 0]) + 1
        last = int(window.boundary[0, 0]) if len(window.boundary) else None
        return {"kind": "global", "t": t, "p": None if last is None else last - t + 1}
    raise InputError(f"window: a {type(window).__name__}; a local or a global problem is needed")


def window_at(problem: Problem, where: dict[str, Any]) -> Window:
    """Return the window of a problem that `place` has named."""
    if where["kind"] == "local":
        return LocalProblem(problem, *(where[name] for name in ("t", "v", "k", "r")))
    return GlobalProblem(problem, where["t"], where["p"])


def _rows(actions: Ints, wanted: tuple[int, int | None], name: str, not_there: str) -> Ints:
    step, agent = wanted
    mine = actions[:, 1] == step
    if agent is not None:
        mine &= actions[:, 2] == agent
    if not mine.any():
        raise InputError(f"{name} = {wanted}: (step, agent) that {not_there}", name)
    return np.flatnonzero(mine)


def _hops(network: Network, target: Target) -> int | None:
    """Return the distance of the two agents, None if there is no path."""
    ones, size = np.ones(len(network.indices)), (network.vertices, network.vertices)
    graph = sparse.csr_array((ones, network.indices, network.indptr), shape=size)
    found = dijkstra(graph, unweighted=True, indices=target.free[1])[target.fixed[1]]
    return int(found) if np.isfinite(found) else None
