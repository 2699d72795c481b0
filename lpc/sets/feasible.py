"""What a feasible set is: a closed convex set for every step and agent."""

from __future__ import annotations

from abc import abstractmethod

from ...graphs import InputError
from ..arrays import Floats, Ints
from ..kind import Kind


class FeasibleSet(Kind):
    """Closed convex sets ``D_t^v = {y : g_i(y) <= 0}`` of R^n, one for every step and agent.

    Every method takes m points at once: ``t`` and ``v`` of shape (m,), ``y`` of shape (m, n).
    """

    projectable: bool  # whether `project` is there
    everywhere: bool = False  # whether the sets are known to be all of R^n

    @abstractmethod
    def violation(self, t: Ints, v: Ints, y: Floats) -> Floats:
        """Return how far outside the points are, shape (m,); 0 or less within the set."""

    def project(self, t: Ints, v: Ints, y: Floats) -> Floats:
        """Return the nearest points of the sets, shape (m, n).

        Raises
        ------
        InputError
            If `projectable` is false.
        """
        raise InputError(f"{self.kind}: there is no projection onto such a set")

    @abstractmethod
    def constraints(self, t: Ints, v: Ints, y: Floats) -> tuple[Floats, Floats, Floats]:
        """Return ``g`` (m, p), its gradients (m, p, n) and Hessians (m, p, n, n).

        A constraint that is not there at a point (an infinite bound) is -inf with derivatives 0.
        """

    @abstractmethod
    def interior(self, t: Ints, v: Ints) -> Floats:
        """Return a point strictly within every set, shape (m, n).

        Raises
        ------
        InputError
            If a set has none, with its step and agent.
        """

    @abstractmethod
    def check(self, H: int, N: int, n: int) -> None:
        """Raise `InputError` unless these are sets of H steps, N agents, in R^n, none empty."""
