"""The network once for every step, one layer above the other: what pictures in space-time share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import networkx as nx
import numpy as np

from ...graphs import InputError, Network
from ...lpc.arrays import Floats
from ..looks import FAINT, INK
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._places import part, places
from ._text import Wish, label, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WHOLE = 40  # agents up to which a network is drawn as a whole
MOST = 150  # agents drawn at all
NARROW = 9  # agents that fit into a column
NAMED = 20  # agents whose names are written at every step, not only at t
TILT, SHEAR = 0.62, 0.12  # of a layer: height over the distance of layers, and shift over width


@dataclass(frozen=True)
class Part:
    """The agents that are drawn around one of them, with their places.

    Parameters
    ----------
    graph : networkx.Graph
        On the numbers of the agents.
    distance : dict
        Hops from the agent in the middle, for those within reach of it.
    places : dict
        In a strip of width 1.
    """

    graph: nx.Graph[int]
    distance: dict[int, int]
    places: dict[int, tuple[float, float]]

    @classmethod
    def around(cls, network: Network, v: int, radius: int, whole: int = WHOLE) -> Part:
        """Return all of a small network, of a larger one the agents within some hops of v."""
        small = network.vertices <= whole
        distance = {v: 0}
        queue = [v]
        for u in queue:
            if small or distance[u] < radius:
                new = [int(w) for w in network.neighbours(u) if int(w) not in distance]
                distance |= dict.fromkeys(new, distance[u] + 1)
                queue += new
        near = sorted(distance, key=lambda u: (distance[u], u))[: max(MOST, whole)]
        graph = part(network, range(network.vertices) if small else sorted(near))
        kept = {u: d for u, d in distance.items() if u in graph}
        return cls(graph, kept, places(graph))

    def rows(self, network: Network) -> list[dict[str, Any]]:
        """Return one row of a table for each agent."""
        return [
            {
                "kind": "agent",
                "agent": u,
                "name": network.names[u],
                "distance": self.distance.get(u),
                "x": self.places[u][0],
                "y": self.places[u][1],
            }
            for u in self.graph
        ]


def span_of(agents: int) -> Literal["column", "page"]:
    """Return how wide a picture of so many agents has to be."""
    return "column" if agents <= NARROW else "page"


def agent_of(subject: Subject, picture: Subject, middle: int) -> int:
    """Return the agent that is drawn: `middle` in a picture's own network, unless one is named."""
    own = subject.graph == picture.graph and not subject.agent
    return middle if own else subject.centre


def check_step(subject: Subject) -> None:
    """Raise `InputError` if the step lies beyond the horizon."""
    if subject.t > subject.horizon:
        raise InputError(f"t = {subject.t}: there are the steps 1..{subject.horizon}", "t")


def step_name(tau: int, t: int, horizon: int) -> str:
    """Return ``t + 1`` in mathematics, and that a step lies beyond the horizon."""
    name = "t" if tau == t else f"t{tau - t:+d}"
    return f"${name} > H$" if tau > horizon else f"${name}$"


def head_parts(subject: Subject, agent: int, drawn: int) -> list[str]:
    """Return what stands above a picture of what one agent sees."""
    from ..parts import network_name

    network = subject.network
    name = shown(network.names[agent])
    parts = [
        network_name(subject),
        f"agent {name} at $t = {subject.t}$",
        f"$k = {subject.k}$",
        f"$r = {subject.r}$",
    ]
    if drawn < network.vertices:
        parts.append(f"the {drawn} nearest of {network.vertices} agents")
    return parts


class Stage(NamedTuple):
    """An empty picture in space-time: where its marks will stand, and how large they are."""

    figure: Figure
    axes: Axes
    layers: Layers
    nodes: list[dict[str, Any]]
    radius: float
    today: Floats

    @classmethod
    def of(cls, table: Table, subject: Subject, size: Size) -> Stage:
        """Return the stage for the agents and nodes of a table, one layer a step, time upwards."""
        at = {row["agent"]: (row["x"], row["y"]) for row in table.where(kind="agent").records()}
        nodes = table.where(kind="node").records()
        layers = Layers(tuple(dict.fromkeys(row["step"] for row in nodes)), at)
        high = 0.27 if span_of(len(at)) == "column" else 0.14
        high *= len(layers.steps) * (0.65 + layers.tall / 2)
        figure = size.figure(span_of(len(at)), 0.12 + high)
        axes = figure.subplots()
        names = [step_name(tau, subject.t, subject.horizon) for tau in layers.steps]
        layers.frame(axes, names)
        today = layers.today(axes, subject.t)
        return cls(figure, axes, layers, nodes, layers.radius(figure, size), today)

    def name(self, wishes: Sequence[Wish], lines: Floats, size: Size) -> None:
        """Write names where there is room beside marks and lines."""
        marks = self.layers.points([(row["step"], row["agent"]) for row in self.nodes])
        looks = {"fontsize": float(size.settings["font.size"]) - 1, "color": INK}
        label(self.axes, wishes, marks, lines, self.radius, **looks)


@dataclass(frozen=True)
class Layers:
    """Points of the plane for (step, agent).

    Parameters
    ----------
    steps : tuple of int
        From the lowest layer to the highest.
    places : dict
        Of the agents, in a strip of width 1.
    """

    steps: tuple[int, ...]
    places: dict[int, tuple[float, float]]

    @cached_property
    def tall(self) -> float:
        """Height of a layer where layers are 1 apart; 0 for a path."""
        high = max(y for _, y in self.places.values())
        return min(TILT, 1.2 * high) if high else 0.0

    def at(self, step: int, agent: int) -> tuple[float, float]:
        """Return where one action is drawn."""
        high = max(y for _, y in self.places.values())
        x, y = self.places[agent]
        up = y / high if high else 0.0
        return x + SHEAR * up * (high > 0), step - self.steps[0] + self.tall * (up - 0.5)

    def points(self, pairs: Sequence[tuple[int, int]]) -> Floats:
        """Return the points of (step, agent), shape (m, 2)."""
        return np.array([self.at(*pair) for pair in pairs], dtype=np.float64).reshape(-1, 2)

    def radius(self, figure: Figure, size: Size) -> float:
        """Return the radius in points with which the marks of a layer stay apart."""
        here = self.points([(self.steps[0], u) for u in self.places])
        scale = np.array([0.8 * figure.bbox.width, 0.75 * figure.bbox.height / len(self.steps)])
        base = 0.36 * float(size.settings["font.size"])
        if len(here) < 2:
            return base
        inches = (here * scale) / figure.dpi * 72
        apart = np.linalg.norm(inches[:, None] - inches[None], axis=2)
        apart[np.diag_indices(len(here))] = np.inf
        return float(np.clip(0.42 * np.quantile(apart.min(axis=1), 0.2), 0.35 * base, base))

    def frame(self, axes: Axes, names: Sequence[str]) -> None:
        """Give the axes their limits, the names of the steps, and a plane for each layer."""
        low, high = self.tall / 2 + 0.22, len(self.steps) - 1 + self.tall / 2 + 0.22
        axes.set_ylim(-low, high)
        slope = SHEAR if self.tall else 0.0
        axes.set_xlim(-0.06, 1.06 + slope)
        axes.set_yticks(range(len(self.steps)), list(names))
        axes.set_xticks([])
        axes.tick_params(length=0)
        axes.spines[:].set_visible(False)
        if self.tall:
            a, b, half = -0.035, 1.035, self.tall / 2 + 0.07
            for i in range(len(self.steps)):
                xs = [a, b, b + slope + 0.01, a + slope + 0.01]
                axes.fill(xs, [i - half, i - half, i + half, i + half], color="0.965", zorder=0)

    def named(self, t: int) -> list[int]:
        """Return the steps at which names are wanted, the most wanted first."""
        rest = [tau for tau in self.steps if tau != t and len(self.places) <= NAMED]
        return [t, *rest]

    def today(self, axes: Axes, t: int) -> Floats:
        """Draw the line between what has happened and what is to come; return its ends."""
        y = t - self.steps[0] - 0.5
        low, high = axes.get_xlim()
        axes.plot([low, high], [y, y], color=FAINT, linestyle=(0, (1, 2)), zorder=0.5)
        signs = (("future $\\uparrow$", "bottom", 2), ("history $\\downarrow$", "top", -2))
        for text, edge, shift in signs:
            axes.annotate(
                text,
                (1, y),
                (3, shift),
                xycoords=axes.get_yaxis_transform(),
                textcoords="offset points",
                va=edge,
                color=INK,
                annotation_clip=False,
            )
        return np.array([[[low, y], [high, y]]])
