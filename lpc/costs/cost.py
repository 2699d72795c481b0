"""What a cost is: a convex function for every step and every agent or edge."""

from __future__ import annotations

from abc import abstractmethod
from dataclasses import dataclass
from typing import Literal

import numpy as np

from ..arrays import Floats, Ints
from ..kind import Kind

Source = Literal["exact", "bound", "claimed"]


@dataclass(frozen=True)
class Curvature:
    """Bounds on the eigenvalues of Hessians: ``lower I <= Hessian <= upper I`` everywhere.

    Parameters
    ----------
    lower, upper : ndarray, shape (T, I)
        Strong convexity and smoothness of every member; ``T`` and ``I`` may be 1.
    error : array_like, shape (T, I) or one that broadcasts to it
        How far rounding may have moved a bound of a member, at most. A member's bounds must not
        depend on the other members: a controller that uses them has to be local.
    source : {"exact", "bound", "claimed"}
        Whether they are the infimum and the supremum, computed from the function; proven, but
        perhaps not the best; or what the author of the function says.
    """

    lower: Floats
    upper: Floats
    error: Floats
    source: Source

    def __post_init__(self) -> None:
        object.__setattr__(self, "error", np.broadcast_to(self.error, self.lower.shape))


class Cost(Kind):
    """A family of convex functions in C^2, one for every step ``t = 1..H`` and member i.

    The members are agents (node and temporal costs) or edges (spatial costs). A node cost has one
    argument, the action; a temporal cost has two, ``(x_t, x_{t-1})``; so has a spatial cost,
    ``(x_u, x_v)`` for the edge ``(u, v)``, ``u < v``. They are given as one vector w of
    ``blocks * n`` numbers.

    Every method evaluates m points at once: ``t`` and ``i`` have shape (m,), ``w`` has shape
    (m, blocks n). What it returns for a point must depend on nothing but ``t, i, w`` of that point.
    """

    @property
    @abstractmethod
    def size(self) -> int:
        """The length of w."""

    @property
    @abstractmethod
    def steady(self) -> bool:
        """Whether the Hessians are known not to change with the step."""

    @abstractmethod
    def value(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the costs, shape (m,)."""

    @abstractmethod
    def gradient(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the gradients, shape (m, size)."""

    @abstractmethod
    def hessian(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the Hessians, shape (m, size, size)."""

    @abstractmethod
    def curvature(self) -> Curvature:
        """Return bounds on the eigenvalues of every Hessian."""

    @abstractmethod
    def check(self, H: int, count: int, size: int, name: str) -> None:
        """Raise `InputError` unless this is a convex cost of H steps and `count` members.

        Parameters
        ----------
        H, count, size : int
            Steps, members (agents or edges), and the length that w has to have.
        name : str
            What the cost is ("node cost"), for messages.
        """
