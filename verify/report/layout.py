"""Where the claims stand in the picture of which proof uses which claim.

Claims stand in columns, each to the right of all claims that its proof uses [Sugiyama, Tagawa, Toda
(1981)]; an edge over several columns passes through a gap in each of them.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import networkx as nx

from ..claim import Claim

_SWEEPS = 24
_LINE = re.compile(r"(:e\d.*|#.*)$")  # what a label has more than that of its theorem or section


def boxes_of(claims: Sequence[Claim]) -> dict[str, list[Claim]]:
    """Return the claims by the label of their theorem or section."""
    boxes: dict[str, list[Claim]] = {}
    for claim in claims:
        boxes.setdefault(_LINE.sub("", claim.label), []).append(claim)
    return boxes


def uses_between(boxes: Mapping[str, Sequence[Claim]]) -> nx.DiGraph[str]:
    """Return the uses from one box to another, see `layout`."""
    place = {claim.key: name for name, claims in boxes.items() for claim in claims}
    graph: nx.DiGraph[str] = nx.DiGraph()
    graph.add_nodes_from(boxes)
    for name, claims in boxes.items():
        others = {place.get(key, name) for claim in claims for key in claim.uses}
        graph.add_edges_from((name, other) for other in sorted(others - {name}))
    return graph


@dataclass(frozen=True)
class Layout:
    """Places in columns and rows.

    Parameters
    ----------
    places : dict
        Key -> (column, row); rows are floats, at least 1 apart within a column.
    edges : tuple of tuple
        The places an edge passes, from the claim that is used to the one that uses it, with the
        two keys: ``(used, user, ((column, row), ...))``.
    alone : tuple of str
        Claims without an edge, which have no place.
    """

    places: dict[str, tuple[int, float]]
    edges: tuple[tuple[str, str, tuple[tuple[int, float], ...]], ...]
    alone: tuple[str, ...]

    @property
    def columns(self) -> int:
        """How many columns there are."""
        return 1 + max((column for column, _ in self.places.values()), default=-1)

    @property
    def rows(self) -> float:
        """The last row."""
        return max((row for _, _, path in self.edges for _, row in path), default=-1.0)


def layout(uses: nx.DiGraph[str]) -> Layout:
    """Return the places of all claims.

    Parameters
    ----------
    uses : networkx.DiGraph
        With an edge from a claim to each claim that its proof uses. Claims that use each other in
        a circle share a column.
    """
    alone = tuple(key for key in uses if uses.degree(key) == 0)
    columns = _columns(uses)
    layers: list[list[Any]] = [[] for _ in range(1 + max(columns.values(), default=-1))]
    for key in uses:
        if key not in alone:
            layers[columns[key]].append(key)
    paths = {}
    for user, used in uses.edges:
        between = range(columns[used] + 1, columns[user])
        bends = [(used, user, column) for column in between]
        for column, bend in zip(between, bends, strict=True):
            layers[column].append(bend)
        paths[used, user] = [used, *bends, user]
    rows = _rows(layers, [step for path in paths.values() for step in pairwise(path)])
    place = {node: (i, rows[node]) for i, layer in enumerate(layers) for node in layer}
    edges = tuple((*ends, tuple(place[node] for node in path)) for ends, path in paths.items())
    return Layout({key: place[key] for key in uses if key in place}, edges, alone)


def _columns(uses: nx.DiGraph[str]) -> dict[str, int]:
    """Return the length of the longest chain below each claim, or a later column.

    A claim that is used at least as often as it uses others moves next to the first that uses it.
    """
    circles = nx.condensation(uses)
    order = list(nx.topological_sort(circles))  # users first
    column: dict[int, int] = {}
    for node in reversed(order):
        column[node] = 1 + max((column[below] for below in circles.successors(node)), default=-1)
    for node in order:
        if circles.in_degree(node) >= max(circles.out_degree(node), 1):
            column[node] = min(column[above] for above in circles.predecessors(node)) - 1
    return {key: column[circles.graph["mapping"][key]] for key in uses}


def _rows(layers: list[list[Any]], steps: list[tuple[Any, Any]]) -> dict[Any, float]:
    """Return rows that keep edges short: sweeps towards the mean row of the neighbours."""
    near: dict[Any, list[Any]] = {node: [] for layer in layers for node in layer}
    for a, b in steps:
        near[a].append(b)
        near[b].append(a)
    rows = {node: float(i) for layer in layers for i, node in enumerate(layer)}
    for _ in range(_SWEEPS):
        for layer in (*layers, *reversed(layers)):
            wish = {n: sum(rows[m] for m in near[n]) / max(len(near[n]), 1) for n in layer}
            layer.sort(key=lambda node: wish[node])
            rows.update(zip(layer, _apart([wish[node] for node in layer]), strict=True))
    first = min(rows.values(), default=0.0)
    return {node: row - first for node, row in rows.items()}


def _apart(wishes: list[float]) -> list[float]:
    """Return the ascending rows nearest to ascending wishes, in squares, that are 1 apart."""
    blocks: list[tuple[float, int]] = []  # mean of wishes minus positions, and size
    for i, wish in enumerate(wishes):
        mean, size = wish - i, 1
        while blocks and blocks[-1][0] >= mean:  # pool adjacent violators
            before, many = blocks.pop()
            mean, size = (before * many + mean * size) / (many + size), many + size
        blocks.append((mean, size))
    shifts = [mean for mean, size in blocks for _ in range(size)]
    return [shift + i for i, shift in enumerate(shifts)]
