"""From NetworkX graphs and back; what is not a simple undirected graph is named or cleaned."""

from __future__ import annotations

from collections import Counter
from typing import TYPE_CHECKING, Any

import numpy as np

from .errors import InputError
from .network import Network

if TYPE_CHECKING:
    import networkx as nx


def from_networkx(
    graph: nx.Graph[Any], *, clean: bool = False, source: str = "networkx graph"
) -> Network:
    """Convert a NetworkX graph; attributes of vertices and edges are ignored.

    Parameters
    ----------
    graph : networkx.Graph
        Any of the four NetworkX classes. A multigraph without parallel edges is a simple graph.
    clean : bool
        Drop directions, parallel edges and self-loops instead of rejecting them.
    source : str
        Where the graph comes from, for messages and reports.

    Returns
    -------
    Network
        Vertex ``i`` is the ``i``-th node of `graph`, named ``str(node)``.

    Raises
    ------
    InputError
        If the graph is directed, has parallel edges or self-loops (one offender and the number
        of them are named), has no vertex, or if two nodes have the same name.
    """
    nodes = list(graph.nodes())
    if not nodes:
        raise InputError(f"{source}: the graph has no vertices; at least one is needed")
    names = tuple(map(str, nodes))
    if len(set(names)) < len(names):
        twice = next(name for name, count in Counter(names).items() if count > 1)
        raise InputError(f"{source}: two vertices are both named {twice!r}")
    number = {node: i for i, node in enumerate(nodes)}
    arcs = [(number[a], number[b]) for a, b in graph.edges()]
    ends = np.sort(np.array(arcs, dtype=np.int64).reshape(-1, 2), axis=1)
    if clean:
        ends = np.unique(ends[ends[:, 0] != ends[:, 1]], axis=0)
    else:
        _reject(arcs, ends.tolist(), names, graph.is_directed(), source)
    return Network.from_edges(len(nodes), ends, names=names, source=source)


def to_networkx(network: Network) -> nx.Graph[str]:
    """Return a NetworkX graph whose nodes are the names of `network`, in its order."""
    import networkx as nx

    graph: nx.Graph[str] = nx.Graph()
    graph.add_nodes_from(network.names)
    rows = np.repeat(np.arange(network.vertices), network.degrees)
    once = rows < network.indices
    names = network.names
    heads, tails = rows[once].tolist(), network.indices[once].tolist()
    graph.add_edges_from((names[a], names[b]) for a, b in zip(heads, tails, strict=True))
    return graph


def _reject(
    arcs: list[tuple[int, int]],
    ends: list[list[int]],
    names: tuple[str, ...],
    directed: bool,
    source: str,
) -> None:
    """Raise `InputError` naming the first thing that a simple undirected graph does not have."""
    hint = "a simple undirected graph is accepted, or pass --clean (clean=True)"
    if directed:
        example = f", the first {names[arcs[0][0]]} -> {names[arcs[0][1]]}" if arcs else ""
        raise InputError(f"{source}: directed ({len(arcs)} arcs{example}); {hint}")
    loops = [a for a, b in ends if a == b]
    if loops:
        first = names[loops[0]]
        raise InputError(f"{source}: {len(loops)} self-loop(s), the first at {first}; {hint}")
    seen: set[tuple[int, int]] = set()
    parallel = []
    for a, b in ends:
        if (a, b) in seen:
            parallel.append((a, b))
        seen.add((a, b))
    if parallel:
        a, b = parallel[0]
        raise InputError(
            f"{source}: {len(parallel)} parallel edge(s), "
            f"the first between {names[a]} and {names[b]}; {hint}"
        )
