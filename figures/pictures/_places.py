"""Where agents stand in a picture: the same places every time, components side by side."""

from __future__ import annotations

import math
from collections.abc import Sequence

import networkx as nx
import numpy as np

from ...graphs import Network
from ...lpc.arrays import Floats, Ints

FEW = 200  # agents of a component that distances are fitted for
ANGLES = np.deg2rad(np.arange(0, 180, 3))
FLAT = 0.03  # height over width below which a component is drawn as a line
DIGITS = 4


def part(network: Network, agents: Sequence[int] | Ints) -> nx.Graph[int]:
    """Return the subgraph on some agents, by their numbers and in their order."""
    inside = set(map(int, agents))
    found: nx.Graph[int] = nx.Graph()
    found.add_nodes_from(map(int, agents))
    for u in found:
        found.add_edges_from((u, int(w)) for w in network.neighbours(u) if u < w and w in inside)
    return found


def places(graph: nx.Graph[int]) -> dict[int, tuple[float, float]]:
    """Return places in a strip of width 1: distances follow hops [Kamada, Kawai (1989)].

    Every component is turned so that it is wide and no two agents stand one above the other,
    if that can be; above `FEW` agents edges are springs [Fruchterman, Reingold (1991)].
    """
    shapes = [_shape(graph.subgraph(c).copy()) for c in nx.connected_components(graph)]
    shapes.sort(key=lambda shape: -len(shape))
    wide = max(max(_size(shape)[0] for shape in shapes), math.sqrt(4 * len(graph)))
    found: dict[int, tuple[float, float]] = {}
    x = y = high = 0.0
    for shape in shapes:  # in rows, as words stand in a text
        w, h = _size(shape)
        if x and x + w > wide:
            x, y, high = 0.0, y + high + 1.0, 0.0
        found |= {u: (x + a, y + b) for u, (a, b) in shape.items()}
        x, high = x + w + 1.0, max(high, h)
    width = max(x for x, _ in found.values()) or 1.0
    return {u: (round(x / width, DIGITS), round(y / width, DIGITS)) for u, (x, y) in found.items()}


def _shape(graph: nx.Graph[int]) -> dict[int, tuple[float, float]]:
    """Return places of a connected graph, its edges about 1 long, its corner at 0."""
    agents = sorted(graph)
    if len(agents) == 1:
        return {agents[0]: (0.0, 0.0)}
    ordered: nx.Graph[int] = nx.Graph()
    ordered.add_nodes_from(agents)
    ordered.add_edges_from(sorted(graph.edges))
    if len(agents) <= FEW:
        rough = nx.kamada_kawai_layout(ordered)
    else:
        rough = nx.spring_layout(ordered, seed=0, iterations=100)
    at = np.array([rough[u] for u in agents])
    ends = np.array([(agents.index(a), agents.index(b)) for a, b in ordered.edges])
    at /= np.linalg.norm(at[ends[:, 0]] - at[ends[:, 1]], axis=1).mean()
    at = _turned(at)
    return {u: (float(x), float(y)) for u, (x, y) in zip(agents, at, strict=True)}


def _turned(at: Floats) -> Floats:
    """Return the places turned: wide, with a gap between neighbours in x; the first on the left."""
    best: Floats = at
    most = -np.inf
    for angle in ANGLES:
        turned = at @ np.array([[np.cos(angle), np.sin(angle)], [-np.sin(angle), np.cos(angle)]])
        w, h = np.ptp(turned, axis=0)
        gap = np.diff(np.sort(turned[:, 0])).min() / max(w, 1e-9) * (len(at) - 1)  # at most 1
        score = round(w / math.hypot(w, h) + 0.5 * gap, 3)
        if score > most:
            best, most = turned, score
    if best[0, 0] > best[-1, 0]:
        best = -best
    best = best - best.min(axis=0)
    if best[:, 1].max() < FLAT * best[:, 0].max():
        best[:, 1] = 0.0
    return best


def _size(shape: dict[int, tuple[float, float]]) -> tuple[float, float]:
    return max(x for x, _ in shape.values()), max(y for _, y in shape.values())
