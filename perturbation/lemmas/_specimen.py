"""Random local problems of a class with given constants, for the lemmas to be measured on."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...bounds import Parameters
from ...graphs import Network, NetworkGrowth, parse_graph
from ...lpc import instance
from ...lpc.instances import styles
from ...lpc.local import LocalProblem
from ._hierarchy import Hierarchy

GRAPHS = (
    "path:1",  # no neighbours, no boundary
    "path:2",
    "path:7",
    "ring:5",
    "ring:8",
    "star:6",
    "complete:4",
    "tree:2x2",
    "tree:3x2",
    "grid:3x3",
    "hypercube:3",
    "ring-of-blocks:4x2",
    "erdos-renyi:8x0.2",  # often with isolated vertices
    "erdos-renyi:9x0.35",
)


@dataclass(frozen=True)
class Shape:
    """All of a random local problem but the strengths of its costs.

    Parameters
    ----------
    graph : str
        As `parse_graph` reads it.
    v, k, r : int
        The agent that decides, and how far it looks; its step is 1, the horizon k.
    style : str
        One of `styles`.
    n : int
        Entries of one action.
    seed : int
        Of the graph, the costs and the point.
    varying : bool
        Whether costs differ from step to step.
    """

    graph: str
    v: int = 0
    k: int = 4
    r: int = 2
    style: str = "attraction"
    n: int = 1
    seed: int = 0
    varying: bool = False

    @cached_property
    def network(self) -> Network:
        """The graph."""
        return parse_graph(self.graph, self.seed)

    @cached_property
    def growth(self) -> NetworkGrowth:
        """Its exact h."""
        return NetworkGrowth(self.network)

    @classmethod
    def drawn(cls, seed: int, *, k: int = 6, r: int = 3) -> Shape:
        """Return a random shape with at most the given k and r."""
        rng = np.random.default_rng([seed, 0])
        graph = str(rng.choice(GRAPHS))
        vertices = parse_graph(graph, seed).vertices
        return cls(
            graph,
            int(rng.integers(vertices)),
            int(rng.integers(2, k + 1)),
            int(rng.integers(1, r + 1)),
            str(rng.choice(list(styles()))),
            int(rng.integers(1, 3)),
            seed,
            bool(rng.random() < 0.7),
        )


@dataclass(frozen=True, eq=False)
class Specimen:
    """A random local problem whose costs have given constants.

    Parameters
    ----------
    shape : Shape
    parameters : Parameters
        mu, l_f, l_T, l_S as floats.
    """

    shape: Shape
    parameters: Parameters

    @property
    def x(self) -> float:
        """``Delta l_S/mu``."""
        return float(self.shape.network.max_degree * self.parameters.a_S)

    @cached_property
    def local(self) -> LocalProblem:
        """The local problem."""
        s = self.shape
        problem = instance(
            s.network,
            s.k,
            self.parameters,
            style=s.style,
            n=s.n,
            seed=s.seed,
            varying=s.varying,
        )
        return LocalProblem(problem, 1, s.v, s.k, s.r)

    @cached_property
    def hierarchy(self) -> Hierarchy:
        """M, D, A, J, R, K at a random point."""
        rng = np.random.default_rng([self.shape.seed, 2])
        terms, n = self.local.terms, self.shape.n
        x, fixed = (rng.standard_normal((len(z), n)) for z in (terms.free, terms.fixed))
        return Hierarchy(self.local, x, fixed)

    @property
    def text(self) -> str:
        """The instance in words."""
        s, p = self.shape, self.parameters
        varying = ", varying" if s.varying else ""
        return (
            f"{s.graph}, v = {s.v}, k = {s.k}, r = {s.r}, n = {s.n}, {s.style}{varying}; "
            f"mu = {p.mu:.6g}, l_f = {p.l_f:.6g}, l_T = {p.l_T:.6g}, l_S = {p.l_S:.6g}"
        )


def drawn(seed: int, *, k: int = 6, r: int = 3) -> Specimen:
    """Return a random local problem; couplings from weak to strong, now and then none."""
    rng = np.random.default_rng([seed, 1])
    mu, a_T, a_S = 10.0 ** rng.uniform([-1, -2, -2], [1, 2, 2])
    absent = rng.random(2) < 0.1
    l_f = mu * (1.0 if rng.random() < 0.4 else rng.uniform(1, 4))
    l_T, l_S = np.where(absent, 0.0, mu * np.array([a_T, a_S]))
    constants = Parameters(float(mu), float(l_f), float(l_T), float(l_S))
    return Specimen(Shape.drawn(seed, k=k, r=r), constants)
