"""Is the controller local? Change what an agent may not know, and compare its action bit by bit."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import cast

import numpy as np

from .arrays import Floats, Ints, at, spread
from .controller import Controller
from .costs import Cost, Curvature, Quadratic
from .information import information_set
from .problem import Problem
from .sets import Box, Everywhere, FeasibleSet

Mask = np.ndarray[tuple[int, ...], np.dtype[np.bool_]]


@dataclass(frozen=True, eq=False)
class Audit:
    """An action before and after everything its agent may not know was changed.

    Parameters
    ----------
    t, v : int
        Whose action it is.
    action, altered : ndarray, shape (n,)
        The action before and after.
    others : int
        How many other agents act differently: the change is no empty one.
    """

    t: int
    v: int
    action: Floats
    altered: Floats
    others: int

    @property
    def local(self) -> bool:
        """Whether the two actions are equal, bit for bit."""
        return self.action.tobytes() == self.altered.tobytes()


def audit(controller: Controller, t: int, v: int, seed: int = 0) -> Audit:
    """Change costs, sets and earlier actions outside ``N_(t,v)^(k,r)`` at random; play step t.

    Known to agent v, and left as they are: ``f_tau^u, c_tau^u, D_tau^u`` for ``t <= tau < t + k``
    and u in ``N_v^r``, ``s_tau^e`` for edges within ``N_v^r``, and the actions of ``N_v^r`` at
    step ``t - 1``.

    Parameters
    ----------
    controller : Controller
    t, v : int
        The step and the agent.
    seed : int
        Of the changes.

    Returns
    -------
    Audit

    References
    ----------
    Paper, Section 2.1 (``sec:look-ahead-and-communication``).
    """
    problem, rng = controller.problem, np.random.default_rng(seed)
    ball = information_set(problem.network, t, v, controller.k, controller.r).outer
    near = np.isin(np.arange(problem.N), ball)
    steps = np.arange(1, problem.H + 1)
    window = (steps >= t) & (steps < t + controller.k)
    hidden = ~(window[:, None] & near)
    edges = ~(window[:, None] & near[problem.edges].all(axis=1))
    before = rng.normal(size=(problem.N, problem.n))
    moved = np.where(near[:, None], before, rng.normal(size=before.shape))
    parts = [
        _altered(cost, mask, np.random.default_rng(rng.integers(1 << 32)))
        for cost, mask in (
            (problem.node, hidden),
            (problem.temporal, hidden),
            (problem.spatial, edges),
        )
    ]
    sets = _moved(problem.feasible, hidden, problem.n, rng)
    played = []
    for which, actions in ((0, before), (1, moved)):
        node, temporal, spatial = (part[which] for part in parts)
        changed: Problem = replace(
            problem, node=node, temporal=temporal, spatial=spatial, feasible=sets[which]
        )
        played.append(replace(controller, problem=changed).step(t, actions))
    others = int((played[0] != played[1]).any(axis=1).sum())
    return Audit(t, v, played[0][v], played[1][v], others)


def _altered(cost: Cost, hidden: Mask, rng: np.random.Generator) -> tuple[Cost, Cost]:
    """Return a cost of the same kind before and after the change of its hidden members."""
    if isinstance(cost, Quadratic):
        H, count = hidden.shape
        factor = rng.normal(size=(H, count, cost.size, cost.size))
        where = hidden[:, :, None]
        matrix = np.where(where[..., None], factor @ factor.swapaxes(2, 3), 0.0) + spread(
            cost.matrix, H, count
        )
        centre = np.where(where, rng.normal(size=(H, count, cost.size)), 0.0)
        centre = np.where(where, centre, spread(cost.centre, H, count))
        return cost, Quadratic(matrix, centre, cost.offset)
    return _Tilted(cost, np.zeros(hidden.shape)), _Tilted(cost, np.where(hidden, 1.0, 0.0))


@dataclass(frozen=True, eq=False)
class _Tilted(Cost):
    """A cost plus ``extra |w - 1|^2 / 2``."""

    cost: Cost
    extra: Floats
    kind = "tilted for an audit"

    @property
    def size(self) -> int:
        return self.cost.size

    @property
    def steady(self) -> bool:
        return False

    def _more(self, t: Ints, i: Ints) -> Floats:
        return at(self.extra, t, i)

    def value(self, t: Ints, i: Ints, w: Floats) -> Floats:
        more = 0.5 * self._more(t, i) * ((w - 1) ** 2).sum(axis=1)
        return np.asarray(self.cost.value(t, i, w) + more)

    def gradient(self, t: Ints, i: Ints, w: Floats) -> Floats:
        return self.cost.gradient(t, i, w) + self._more(t, i)[:, None] * (w - 1)

    def hessian(self, t: Ints, i: Ints, w: Floats) -> Floats:
        more = self._more(t, i)[:, None, None] * np.eye(w.shape[1])
        found: Floats = self.cost.hessian(t, i, w) + more
        return found

    def curvature(self) -> Curvature:
        base = self.cost.curvature()
        return replace(base, lower=base.lower + self.extra, upper=base.upper + self.extra)

    def check(self, H: int, count: int, size: int, name: str) -> None:
        self.cost.check(H, count, size, name)


def _moved(
    sets: FeasibleSet, hidden: Mask, n: int, rng: np.random.Generator
) -> tuple[FeasibleSet, FeasibleSet]:
    """Return sets of the same kind before and after hidden ones are shifted."""
    if isinstance(sets, Everywhere):
        return sets, sets
    shift = np.where(hidden[:, :, None], rng.normal(size=(*hidden.shape, n)), 0.0)
    if isinstance(sets, Box):
        lower, upper = (
            np.where(
                hidden[:, :, None],
                spread(bound, *cast("tuple[int, int]", hidden.shape)) + shift,
                spread(bound, *cast("tuple[int, int]", hidden.shape)),
            )
            for bound in (sets.lower, sets.upper)
        )
        return sets, Box(lower, upper)
    return _Shifted(sets, np.zeros(shift.shape)), _Shifted(sets, shift)


@dataclass(frozen=True, eq=False)
class _Shifted(FeasibleSet):
    """``D + shift``."""

    sets: FeasibleSet
    shift: Floats
    kind = "shifted for an audit"

    @property
    def projectable(self) -> bool:  # type: ignore[override]
        return self.sets.projectable

    def violation(self, t: Ints, v: Ints, y: Floats) -> Floats:
        return self.sets.violation(t, v, y - at(self.shift, t, v))

    def project(self, t: Ints, v: Ints, y: Floats) -> Floats:
        s = at(self.shift, t, v)
        found: Floats = self.sets.project(t, v, y - s) + s
        return found

    def constraints(self, t: Ints, v: Ints, y: Floats) -> tuple[Floats, Floats, Floats]:
        return self.sets.constraints(t, v, y - at(self.shift, t, v))

    def interior(self, t: Ints, v: Ints) -> Floats:
        found: Floats = self.sets.interior(t, v) + at(self.shift, t, v)
        return found

    def check(self, H: int, N: int, n: int) -> None:
        self.sets.check(H, N, n)
