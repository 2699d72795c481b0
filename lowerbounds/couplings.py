"""All scalar quadratic problems with given constants, as points of a box."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ..bounds import Parameters
from ..graphs import InputError, Network
from ..lpc.arrays import Floats, integer
from ..lpc.costs import Quadratic
from ..lpc.problem import Problem
from .spatial import edges

INSIDE = 1.0 - 1e-14  # of a smoothness: rounding of eigenvalues stays below the constant


@dataclass(frozen=True, eq=False)
class Couplings:
    """Node costs ``m (y - theta)^2 / 2`` and pair costs ``w' P w / 2`` of scalars, ``n = 1``.

    Every step and every agent or edge has its own ``mu <= m <= l_f`` and ``0 <= P <= l I``::

        P = l (s u u' + s' u_ u_'),    u = (cos phi, -sin phi),    u_ = (sin phi, cos phi)

    with an angle phi and shares s, s' in [0, 1] - every such P has this form. A point lists the
    shares of the node costs, ``(m - mu)/(l_f - mu)``, shape (H N,), then for all temporal, then
    for all spatial costs, phi, s and s', shape (3, H (N + E)).

    Parameters
    ----------
    network : Network
    H : int
        Steps.
    parameters : Parameters
        mu, l_f, l_T, l_S: one float each.
    """

    network: Network
    H: int
    parameters: Parameters

    def __post_init__(self) -> None:
        integer(self.H, "H", 1)
        p = self.parameters
        if any(np.ndim(value) for value in (p.mu, p.l_f, p.l_T, p.l_S)):
            raise InputError("parameters: one float each is needed for mu, l_f, l_T, l_S")

    @cached_property
    def edges(self) -> NDArray[np.int64]:
        """The ends of every edge, shape (E, 2), in the order of `Problem.edges`."""
        return edges(self.network)

    @property
    def nodes(self) -> int:
        """The number of node costs, ``H N``."""
        return self.H * self.network.vertices

    @property
    def pairs(self) -> int:
        """The number of pair costs, ``H (N + E)``."""
        return self.nodes + self.H * len(self.edges)

    @cached_property
    def ends(self) -> NDArray[np.int64]:
        """The two variables of every pair cost, shape (pairs, 2); negative at step 0."""
        now = np.arange(self.nodes)
        steps = np.arange(self.H)[:, None, None] * self.network.vertices
        across = (steps + self.edges).reshape(-1, 2)
        return np.concatenate([np.stack([now, now - self.network.vertices], axis=1), across])

    @cached_property
    def strength(self) -> Floats:
        """The constant l of every pair cost, shape (pairs,)."""
        p = self.parameters
        found = np.full(self.pairs, float(p.l_S))
        found[: self.nodes] = float(p.l_T)
        return INSIDE * found

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """The least and the greatest point; angles are free."""
        low, high = np.zeros(self.size), np.ones(self.size)
        low[self._angles], high[self._angles] = -np.inf, np.inf
        if not self.spread > 0:
            high[: self.nodes] = 0.0
        return low, high

    @property
    def size(self) -> int:
        """The numbers of a point."""
        return self.nodes + 3 * self.pairs

    @property
    def spread(self) -> float:
        """``l_f - mu``."""
        return INSIDE * (float(self.parameters.l_f) - float(self.parameters.mu))

    @property
    def _angles(self) -> slice:
        return slice(self.nodes, self.nodes + self.pairs)

    def point(self, phi_T: float, phi_S: float) -> Floats:
        """Return full couplings at two angles, ``m = mu``; ``pi/4`` twice: differences."""
        found = np.zeros((3, self.pairs))
        found[0, : self.nodes], found[0, self.nodes :], found[1] = phi_T, phi_S, 1.0
        return np.concatenate([np.zeros(self.nodes), found.ravel()])

    def random(self, rng: np.random.Generator) -> Floats:
        """Return a point with full couplings at random angles, ``m = mu``."""
        found = self.point(0.0, 0.0)
        found[self._angles] = rng.uniform(0.0, np.pi, self.pairs)
        return found

    def matrices(self, point: Floats) -> tuple[Floats, Floats]:
        """Return m of all node costs, shape (H N,), and P of all pair costs, (pairs, 2, 2)."""
        m = float(self.parameters.mu) + self.spread * point[: self.nodes]
        u, v, s, t = self._parts(point)
        P = np.einsum("p,pi,pj->pij", s, u, u) + np.einsum("p,pi,pj->pij", t, v, v)
        return m, self.strength[:, None, None] * P

    def chain(self, point: Floats, by_m: Floats, by_P: Floats) -> Floats:
        """Return the derivative by the point from those by m, (H N,), and by P, (pairs, 2, 2)."""
        u, v, s, t = self._parts(point)
        by_P = self.strength[:, None, None] * 0.5 * (by_P + by_P.swapaxes(1, 2))
        across = np.einsum("pi,pij,pj->p", u, by_P, v)
        by_phi = -2.0 * (s - t) * across  # du/dphi = -v, dv/dphi = u
        by_s = np.einsum("pi,pij,pj->p", u, by_P, u)
        by_t = np.einsum("pi,pij,pj->p", v, by_P, v)
        return np.concatenate([self.spread * by_m, by_phi, by_s, by_t])

    def problem(self, point: Floats) -> Problem:
        """Return the problem of a point, its targets and ``x_0`` all 0."""
        m, P = self.matrices(point)
        N = self.network.vertices
        temporal = P[: self.nodes].reshape(self.H, N, 2, 2)
        spatial = P[self.nodes :].reshape(self.H, len(self.edges), 2, 2)
        return Problem(
            self.network,
            self.H,
            Quadratic(m.reshape(self.H, N, 1, 1)),
            Quadratic(temporal),
            Quadratic(spatial) if len(self.edges) else None,  # type: ignore[arg-type]
        )

    def _parts(self, point: Floats) -> tuple[Floats, Floats, Floats, Floats]:
        """Return u and u_, shape (pairs, 2), and the two shares, shape (pairs,)."""
        phi, s, t = point[self.nodes :].reshape(3, self.pairs)
        cos, sin = np.cos(phi), np.sin(phi)
        return np.stack([cos, -sin], axis=1), np.stack([sin, cos], axis=1), s, t
