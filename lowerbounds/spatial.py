"""The spatial lower bound on a network: one step, a random number at each agent."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike
from scipy import sparse
from scipy.sparse.csgraph import dijkstra

from ..graphs import InputError, Network
from ..lpc import Problem, Quadratic
from ..lpc.arrays import Floats, Ints
from .grounded import Grounded
from .sources import Charges, charges

LARGEST = 200_000  # unknowns of one sparse factorisation


@dataclass(frozen=True, eq=False)
class Spatial:
    r"""Minimise ``(mu/2) sum_i (x_i + w_i)^2 + (l_S/4) sum_{(i,j)} (x_i - x_j)^2`` over x.

    The ``w_i`` are independent with mean zero, and agent i knows those within distance r. With
    ``M = I + (a_S/2) L``, L the graph's Laplacian and ``B = M^{-1}``, the optimum is ``x* = -B w``
    at the cost ``(mu/2) w'(I - B)w``. Whatever the policies, nonlinear or randomised, and the law
    of w, they cost in expectation at least ``(mu/2) sum_j Var(w_j) (B_jj - ((M_SS)^{-1})_jj)``
    more, S the ball of radius r around **j**; linear policies attain it.

    Parameters
    ----------
    network : Network
    a_S : float
        ``l_S/mu >= 0``: couplings as smooth as the class admits.
    r : int
        Communication radius, at least 0.

    Raises
    ------
    InputError
        If a parameter is out of range, or the network is too large to factorise.

    References
    ----------
    Paper, ``thm:spatial_lower_bound``: there with conditional expectations as policies. They are
    the nearest to ``x*`` agent by agent, but not the cheapest together. R. Radner, *Team decision
    problems*, Ann. Math. Statist. 33 (1962).
    """

    network: Network
    a_S: float
    r: int

    def __post_init__(self) -> None:
        if not (np.isfinite(self.a_S) and self.a_S >= 0):
            raise InputError(f"a_S = {self.a_S}: a finite number >= 0 is needed", "l_S")
        if isinstance(self.r, bool) or int(self.r) != self.r or self.r < 0:
            raise InputError(f"r = {self.r}: an integer >= 0 is needed", "r")
        if self.network.vertices > LARGEST:
            raise InputError(
                f"{self.network.source}: {self.network.vertices} agents; at most {LARGEST} here"
            )

    @cached_property
    def system(self) -> Grounded:
        """``M = I + (a_S/2) L``."""
        ends = edges(self.network)
        return Grounded(np.zeros(self.network.vertices), ends, np.full(len(ends), self.a_S / 2))

    def seen(self, agents: Ints) -> list[Ints]:
        """Return the balls of radius r around some agents."""
        return [np.flatnonzero(row <= self.r) for row in distances(self.network, agents, self.r)]

    def charges(
        self,
        agents: ArrayLike | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> Charges:
        """Return what each source costs.

        Parameters
        ----------
        agents : array_like of int, optional
            The sources. If omitted: all, or agent 0 for all where the graph is known to look the
            same from everywhere.
        progress : callable, optional
            Called as ``progress(done, total)``.
        """
        return charges(self.system, sources_of(self.network, agents), self.seen, progress)

    @cached_property
    def found(self) -> Charges:
        """What the sources cost that are worth it, the best among them; computed once."""
        return self.search()

    def search(self, progress: Callable[[int, int], None] | None = None) -> Charges:
        """Return the charges of all sources, on large networks of the most promising ones."""
        from .ranking import candidates

        return self.charges(candidates(self, progress))

    @property
    def cr_minus_one(self) -> float:
        """The lower bound on ``CR - 1`` with the best variances."""
        return float(self.found.ratios[self.found.best])

    @property
    def agent(self) -> int:
        """The source that the best variances have."""
        return int(self.found.agents[self.found.best])

    def optimum(self, w: ArrayLike) -> Floats:
        """Return ``x* = -(I + (a_S/2) L)^{-1} w``, shape (N,)."""
        return -self.system.solve(np.asarray(w, dtype=float))

    def problem(self, w: ArrayLike | None = None, mu: float = 1.0) -> Problem:
        """Return one realisation as a problem of one step, without temporal costs.

        Parameters
        ----------
        w : array_like, shape (N,), optional
            If omitted, 1 at the best source and 0 elsewhere. Of the two realisations of a random
            sign there, any algorithm pays the bound at one, and one whose actions are odd in w
            (LPC, all linear ones) at both.
        mu : float
            The unit of all costs, > 0.
        """
        N = self.network.vertices
        if w is None:
            w = np.zeros(N)
            w[self.agent] = 1.0
        return one_step(self.network, np.asarray(w, dtype=float), mu, mu * self.a_S)


def edges(network: Network) -> Ints:
    """Return the ends ``u < v`` of all edges in lexicographic order, shape (E, 2)."""
    rows = np.repeat(np.arange(network.vertices), network.degrees)
    forward = rows < network.indices
    return np.stack([rows[forward], network.indices[forward]], axis=1).astype(np.int64)


def distances(network: Network, agents: Ints, limit: float = np.inf) -> Floats:
    """Return distances from some agents to all, infinite beyond the limit, shape (c, N)."""
    ones = np.ones(len(network.indices))
    N = network.vertices
    graph = sparse.csr_matrix((ones, network.indices, network.indptr), shape=(N, N))
    found: Floats = dijkstra(graph, unweighted=True, indices=agents, limit=limit)
    return found


def sources_of(network: Network, agents: ArrayLike | None) -> Ints:
    """Return the agents to consider as sources."""
    if agents is None:
        return np.arange(1 if network.transitive else network.vertices)
    found = np.atleast_1d(np.asarray(agents))
    N = network.vertices
    if found.dtype.kind not in "iu" or found.ndim != 1 or not len(found):
        raise InputError("agents: numbers of agents are needed", "agents")
    if found.min() < 0 or found.max() >= N:
        raise InputError(f"agents: there are the agents 0..{N - 1}", "agents")
    return found.astype(np.int64)


def one_step(network: Network, w: Floats, mu: float, l_S: float) -> Problem:
    """Return ``(mu/2) |x + w|^2`` with difference couplings of smoothness l_S as a problem."""
    if w.shape != (network.vertices,):
        raise InputError(f"w: {network.vertices} numbers are needed, not {w.shape}", "w")
    pair = np.array([[1.0, -1.0], [-1.0, 1.0]])
    node = Quadratic([[mu]], -w[:, None])
    return Problem(network, 1, node, spatial=Quadratic(l_S / 2 * pair))
