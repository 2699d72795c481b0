"""LPC's local problem: what an agent decides on, and what it holds fixed around that."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...lpc.arrays import Floats
from ...lpc.information import information_set
from ..looks import BOTTOM, FAINT, INK, LATERAL, OWN, PAPER, TOP
from ..parts import legend_below, thin
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._layers import Layers, Part, Stage, agent_of, check_step, head_parts
from ._text import Wish, heading, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SUBJECT = Subject("path:5", horizon=12, k=3, r=2, t=3)
MIDDLE = 2
# What a part of the problem is called, and how its actions are drawn: mark, colour, scale.
PARTS = {
    "own": ("action to be chosen", "D", OWN, 1.35),
    "free": ("other free variable", "o", PAPER, 1.0),
    "top": ("top: guess at $t+k-1$", "^", TOP, 1.2),
    "lateral": ("lateral: guess at $r$ hops", "s", LATERAL, 1.0),
    "bottom": ("bottom: action taken", "v", BOTTOM, 1.2),
    "outside": ("not in the problem", "o", FAINT, 0.35),
}


def compute(subject: Subject, progress: Progress) -> Table:
    """Return rows for agents, for (step, agent) and for the couplings between them.

    ``part`` is a key of `PARTS`. ``matters`` is 1 where the problem depends on it: on free
    variables within the horizon, on what is coupled to one of them, and on those couplings.
    """
    check_step(subject)
    network, v, t, k, H = (
        subject.network,
        agent_of(subject, SUBJECT, MIDDLE),
        subject.t,
        subject.k,
        subject.horizon,
    )
    drawn = Part.around(network, v, subject.r + 1)
    sets = information_set(network, t, v, k, subject.r)
    free = {(int(tau), int(u)) for tau, u in sets.free}
    part = {(int(tau), int(u)): "bottom" for tau, u in sets.bottom}
    part |= {
        (int(tau), int(u)): "top" if tau == t + k - 1 else "lateral" for tau, u in sets.boundary
    }
    part |= dict.fromkeys(free, "free") | {(t, v): "own"}
    acting = {pair for pair in free if pair[0] <= H}
    steps = range(t - 1, t + k)
    pairs = [((tau - 1, u), (tau, u), "temporal") for tau in steps[1:] for u in drawn.graph]
    edges = sorted(drawn.graph.edges)
    pairs += [((tau, u), (tau, w), "spatial") for tau in steps for u, w in edges]
    # no coupling reaches beyond the horizon: there free actions are 0 whatever is around
    within = [pair for pair in pairs if max(pair[0][0], pair[1][0]) <= H]
    touching = {pair for pair in within if acting & set(pair[:2])}
    matter = acting | {end for a, b, _ in touching for end in (a, b)}
    rows = drawn.rows(network)
    for node in ((tau, u) for tau in steps for u in drawn.graph):
        rows.append({
            "kind": "node",
            "step": node[0],
            "agent": node[1],
            "part": part.get(node, "outside"),
            "matters": int(node in matter),
        })  # fmt: skip
    for pair in within:
        a, b, kind = pair
        ends = {"step": b[0], "agent": a[1], "other": b[1] if kind == "spatial" else None}
        rows.append({"kind": kind, **ends, "matters": int(pair in touching)})
    return Table.of(rows)


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw the network once a step, time upwards: the top of the boundary is on top."""
    stage = Stage.of(table, subject, size)
    layers = stage.layers
    lines = np.concatenate([stage.today, _lines(stage.axes, layers, table)])
    _marks(stage.axes, layers, stage.nodes, stage.radius)
    own = agent_of(subject, SUBJECT, MIDDLE)
    heading(stage.figure, head_parts(subject, own, len(layers.places)))
    legend_below(stage.figure, stage.axes)
    agents = table.where(kind="agent").records()
    agents.sort(key=lambda row: (row["distance"] is None, row["distance"], row["agent"]))
    names = {row["agent"]: shown(subject.network.names[row["agent"]]) for row in agents}
    wishes = [
        Wish(*layers.at(tau, u), text)
        for tau in layers.named(subject.t)
        for u, text in names.items()
    ]
    stage.name(wishes, lines, size)
    return stage.figure


def _lines(axes: Axes, layers: Layers, table: Table) -> Floats:
    """Draw couplings, those of the problem heavy; return all lines."""
    from matplotlib.collections import LineCollection

    found: list[Any] = []
    for matters, text, width, colour in ((1, "cost of the problem", 2, "0.35"), (0, "", 1, "0.75")):
        rows = table.where(matters=matters).records()
        lines = [
            (
                layers.at(row["step"] - (row["kind"] == "temporal"), row["agent"]),
                layers.at(row["step"], row["agent" if row["kind"] == "temporal" else "other"]),
            )
            for row in rows
            if row["kind"] in ("temporal", "spatial")
        ]
        style: Any = "-" if matters else (0, (2.5, 2.5))
        looks = {"linewidth": width * thin(), "linestyle": style, "zorder": 1 + 0.1 * matters}
        axes.add_collection(LineCollection(lines, colors=colour, **looks), autolim=False)
        if text:
            axes.plot([], [], color=colour, label=text, **looks)
        found += lines
    return np.array(found, dtype=np.float64).reshape(-1, 2, 2)


def _marks(axes: Axes, layers: Layers, nodes: list[dict[str, Any]], radius: float) -> None:
    """Draw every part with its own mark, small where the problem does not depend on it."""
    idle = False
    for part, (text, mark, colour, scale) in PARTS.items():
        for matters in (1, 0):
            rows = [r for r in nodes if (r["part"], r["matters"]) == (part, matters)]
            faint = not matters and part != "outside"
            idle |= faint and bool(rows)
            if not rows:
                continue
            x, y = layers.points([(row["step"], row["agent"]) for row in rows]).T
            axes.scatter(
                x,
                y,
                s=(2 * radius * scale * (0.55 if faint else 1)) ** 2,
                marker=mark,
                facecolor=colour,
                edgecolor=FAINT if faint or part == "outside" else INK,
                linewidth=1.2 * thin(),
                label="" if faint else text,
                zorder=3,
                clip_on=False,
            )
    if idle:
        area = (2 * radius * 0.55) ** 2
        looks: Any = {"facecolor": "0.6", "edgecolor": FAINT, "marker": "s", "s": area}
        axes.scatter([], [], label="small: of no effect", **looks)


PICTURE = Picture(
    name="decision-boundary",
    title="LPC's local problem: free variables, and the boundary held fixed around them.",
    caption="Time runs upwards. At step t the agent solves for all white variables at once and "
    "plays the orange one. Fixed are the actions taken at step t - 1 (bottom), and guesses r hops "
    "away (lateral) and at step t + k - 1 (top); small marks touch no free variable.",
    compute=compute,
    draw=draw,
    subject=SUBJECT,
    takes=("graph", "horizon", "k", "r", "t", "agent"),
    label="fig:decision_boundary",
)
