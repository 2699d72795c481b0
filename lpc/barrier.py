"""The logarithmic barrier: constraints as a part of the node costs."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from ..graphs import InputError
from .arrays import Floats, Ints
from .costs import Cost, Curvature
from .problem import Problem
from .sets import Everywhere, FeasibleSet

ROOM = 0.1  # of the slack of an interior point, which a starting point should have


@dataclass(frozen=True, eq=False)
class Barrier(Cost):
    """The node cost ``B(y) = f(y) - strength sum_i ln(-g_i(y))``; +inf outside ``g < 0``.

    B is strongly convex with the mu of f, and smooth only where one stays away from the boundary:
    its curvature has no upper bound.

    Parameters
    ----------
    node : Cost
        f.
    feasible : FeasibleSet
        The sets ``g_i <= 0``. They need an interior (Slater's condition): the paper assumes
        ``int D`` nonempty and then uses points with ``g_i < 0`` for all i. The first implies the
        second only if no g_i vanishes on a whole neighbourhood of such a point.
    strength : float
        ``> 0``; the paper calls it mu, as it calls the strong convexity.

    Raises
    ------
    InputError
        If the strength is not a positive number.

    References
    ----------
    Paper, Appendix "Adding Constraints to Perturbation Bounds" (``apx:adding-constraints``).
    """

    node: Cost
    feasible: FeasibleSet
    strength: float
    kind = "barrier"

    def __post_init__(self) -> None:
        if not 0 < self.strength < np.inf:
            raise InputError(f"strength = {self.strength}: a positive number is needed", "strength")

    @property
    def size(self) -> int:
        """The length of w."""
        return self.node.size

    @property
    def steady(self) -> bool:
        """False: what the Hessian is depends on the point."""
        return False

    def value(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return B, shape (m,); +inf outside the interior."""
        slack = -self.feasible.constraints(t, i, w)[0]
        inside = (slack > 0).all(axis=1)
        with np.errstate(divide="ignore"):
            logs = np.where(np.isfinite(slack), np.log(np.where(slack > 0, slack, 1.0)), 0.0)
        barrier = self.strength * logs.sum(axis=1)
        found: Floats = np.where(inside, self.node.value(t, i, w) - barrier, np.inf)
        return found

    def gradient(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return ``f' + strength sum_i g_i' / (-g_i)``, within the interior."""
        g, slope, _ = self.feasible.constraints(t, i, w)
        push: Floats = self.strength * np.einsum("mp,mpj->mj", 1 / g, slope)
        return self.node.gradient(t, i, w) - push

    def hessian(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return ``f'' + strength sum_i [g_i' g_i'^T / g_i^2 + g_i'' / (-g_i)]``."""
        g, slope, bend = self.feasible.constraints(t, i, w)
        steep = slope / g[:, :, None]
        push: Floats = np.einsum("mpj,mpk->mjk", steep, steep)
        push -= np.einsum("mp,mpjk->mjk", 1 / g, bend)
        return self.node.hessian(t, i, w) + self.strength * push

    def curvature(self) -> Curvature:
        """Return the lower bounds of f, and infinity above."""
        own = self.node.curvature()
        return Curvature(own.lower, np.full(own.upper.shape, np.inf), own.error, own.source)

    def check(self, H: int, count: int, size: int, name: str) -> None:
        """Raise `InputError` unless f and the sets fit."""
        self.node.check(H, count, size, name)
        self.feasible.check(H, count, size)


def with_barrier(problem: Problem, strength: float) -> Problem:
    """Return the problem with its sets replaced by the barrier.

    Its optimum costs at most ``p strength`` more than the constrained one, p the number of
    (finite) constraints; both have the same strong convexity, so that perturbation bounds that do
    not depend on the smoothness of node costs are the same for all strengths.
    """
    node = Barrier(problem.node, problem.feasible, strength)
    return replace(problem, node=node, feasible=Everywhere())


def inner_start(feasible: FeasibleSet, t: Ints, v: Ints, guess: Floats) -> Floats:
    """Return a point well within every set, near the guess.

    The guess stays where every constraint that is there has at least `ROOM` of the slack of
    `interior`. Else it is moved half way to that point, which leaves half of its slack because g
    is convex, or all the way if it is outside. A path that begins at the boundary gets nowhere.

    Raises
    ------
    InputError
        If a set has no interior.
    """
    deep = np.broadcast_to(feasible.interior(t, v), guess.shape)
    near, far = (feasible.constraints(t, v, x)[0] for x in (guess, deep))
    with np.errstate(invalid="ignore"):  # -inf: a constraint that is not there
        tight = np.any(near > ROOM * far, axis=1, keepdims=True)
    inside = np.all(near <= 0, axis=1, keepdims=True)
    return np.where(inside, np.where(tight, 0.5 * (guess + deep), guess), deep)
