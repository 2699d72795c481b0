"""The part of a network that one local problem can see, as a network of its own."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.sparse.csgraph import shortest_path

from ..graphs import Network
from ..lpc.arrays import Ints
from ..lpc.information import information_set


@dataclass(frozen=True, eq=False)
class Neighbourhood:
    """``N_v^r`` with the edges within it; agent v comes first.

    The local problems of v depend on nothing else, so that they can be drawn and solved on this
    network, however large the whole one is.

    Parameters
    ----------
    network : Network
        The subgraph; its vertices are numbered by (distance from v, number).
    members : ndarray, shape (m,)
        Their numbers in the whole network.
    distance : ndarray, shape (m, m)
        Distances in the *whole* network, which may be shorter than within the subgraph.
    """

    network: Network
    members: Ints
    distance: Ints

    @classmethod
    def of(cls, network: Network, v: int, r: int) -> Neighbourhood:
        """Return the neighbourhood of agent v with radius r."""
        members = information_set(network, 1, v, 1, r).outer
        # a shortest path between two members leaves N_v^{2r} nowhere
        wide = information_set(network, 1, v, 1, 2 * r).outer
        edges = _edges(network, wide)
        m = len(members)
        own = edges[(edges < m).all(axis=1)]
        names = [network.names[u] for u in members]
        size = (len(wide), len(wide))
        graph = sparse.csr_array((np.ones(len(edges)), (edges[:, 0], edges[:, 1])), shape=size)
        distance = shortest_path(graph, directed=False, unweighted=True, indices=np.arange(m))[
            :, :m
        ]
        source = f"{network.source}, {r} hops around {network.names[v]}"
        return cls(
            Network.from_edges(m, own, names=names, source=source),
            members,
            distance.astype(np.int64),
        )


def _edges(network: Network, members: Ints) -> Ints:
    """Return the edges within some members, by their positions, each once, shape (E, 2)."""
    place = np.full(network.vertices, -1, dtype=np.int64)
    place[members] = np.arange(len(members))
    rows = np.repeat(np.arange(len(members)), network.degrees[members])
    others = np.concatenate([network.neighbours(int(u)) for u in members])
    ends = np.stack([rows, place[others]], axis=1)
    return ends[(ends[:, 0] < ends[:, 1])]
