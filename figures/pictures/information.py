"""What one agent knows at one step: costs within k steps and r hops, actions just taken."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...graphs import Network
from ...lpc.arrays import Floats
from ...lpc.information import information_set
from ..looks import BOTTOM, FAINT, INK, OWN, PAPER, SPATIAL, TEMPORAL
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

NETWORK = Network.from_edges(
    5,
    [(0, 1), (1, 2), (2, 3), (1, 3), (3, 4)],
    names=["u1", "u2", "v", "u3", "u4"],
    source="paper's network",
)
MIDDLE = 2  # of the paper's network: v
SUBJECT = Subject(NETWORK, horizon=12, k=2, r=1, t=3)
KNOWN, UNKNOWN, BEYOND = "known", "unknown", "beyond"


def compute(subject: Subject, progress: Progress) -> Table:
    """Return rows for agents, and for the node, temporal and spatial costs of t-1, ..., t+k.

    ``state`` is ``known`` to the agent, ``unknown``, or ``beyond`` the horizon, where there are no
    costs; ``action`` is 1 for the past actions that it knows. The temporal cost of a step joins
    it to the step before.
    """
    check_step(subject)
    network, v, t, k = subject.network, agent_of(subject, SUBJECT, MIDDLE), subject.t, subject.k
    drawn = Part.around(network, v, subject.r + 1)
    known = information_set(network, t, v, k, subject.r)
    near = set(map(int, known.outer))
    rows = drawn.rows(network)
    for tau in range(t - 1, t + k + 1):

        def state(*ends: int, tau: int = tau) -> str:
            if tau > subject.horizon:
                return BEYOND
            return KNOWN if t <= tau < t + k and near.issuperset(ends) else UNKNOWN

        for u in drawn.graph:
            past = int(tau == t - 1 and u in near)
            rows.append(
                {"kind": "node", "step": tau, "agent": u, "state": state(u), "action": past}
            )
            if tau > t - 1:
                rows.append({"kind": "temporal", "step": tau, "agent": u, "state": state(u)})
        for u, w in sorted(drawn.graph.edges):
            pair = {"agent": u, "other": w, "state": state(u, w)}
            rows.append({"kind": "spatial", "step": tau, **pair})
    return Table.of(rows)


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw the network once a step, time upwards."""
    stage = Stage.of(table, subject, size)
    own = agent_of(subject, SUBJECT, MIDDLE)
    lines = np.concatenate([stage.today, _lines(stage.axes, stage.layers, table)])
    _marks(stage.axes, stage.layers, stage.nodes, stage.radius, (subject.t, own))
    heading(stage.figure, head_parts(subject, own, len(stage.layers.places)))
    legend_below(stage.figure, stage.axes)
    stage.name(_wishes(stage.layers, table, subject), lines, size)
    return stage.figure


def _lines(axes: Axes, layers: Layers, table: Table) -> Floats:
    """Draw temporal and spatial costs, the known ones heavy; return all lines."""
    from matplotlib.collections import LineCollection

    found = []
    for kind, colour, symbol in (("temporal", TEMPORAL, "c"), ("spatial", SPATIAL, "s")):
        for state, style, width, alpha in (
            (KNOWN, "-", 2.2, 1.0),
            (UNKNOWN, (0, (2.5, 2.5)), 0.8, 0.5),
        ):
            rows = table.where(kind=kind, state=state).records()
            lines = [
                (
                    layers.at(row["step"], row["agent"]),
                    layers.at(row["step"] - 1, row["agent"])
                    if kind == "temporal"
                    else layers.at(row["step"], row["other"]),
                )
                for row in rows
            ]
            scale = width * thin()
            drawn: Any = LineCollection(
                lines,
                colors=colour,
                linewidths=scale,
                linestyles=[style],
                alpha=alpha,
                zorder=alpha,
            )
            axes.add_collection(drawn, autolim=False)
            text = f"{kind} cost ${symbol}$, {state}"
            axes.plot([], [], color=colour, linewidth=scale, linestyle=style, label=text)
            found += lines
    return np.array(found, dtype=np.float64).reshape(-1, 2, 2)


def _marks(
    axes: Axes, layers: Layers, nodes: list[dict[str, Any]], radius: float, own: tuple[int, int]
) -> None:
    """Draw nodes: full where the node cost is known, hollow where not."""

    def scatter(rows: list[dict[str, Any]], text: str, scale: float = 1.0, **looks: Any) -> None:
        x, y = layers.points([(row["step"], row["agent"]) for row in rows]).T
        area = (2 * radius * scale) ** 2
        axes.scatter(x, y, s=area, label=text, zorder=3, clip_on=False, **looks)

    def of(state: str) -> list[dict[str, Any]]:
        rest = [row for row in nodes if row["state"] == state and not row["action"]]
        return [row for row in rest if (row["step"], row["agent"]) != own]

    line = 1.2 * thin()
    mine = [row for row in nodes if (row["step"], row["agent"]) == own]
    taken = [row for row in nodes if row["action"]]
    scatter(
        mine,
        "action to be chosen, $f$ known",
        1.35,
        color=OWN,
        edgecolor=INK,
        marker="D",
        linewidth=line,
    )
    scatter(of(KNOWN), "node cost $f$, known", color=INK, linewidth=line)
    scatter(
        of(UNKNOWN),
        "node cost $f$, unknown",
        0.85,
        facecolor=PAPER,
        edgecolor=FAINT,
        linewidth=line,
    )
    scatter(
        taken, "action taken, known", 1.15, color=BOTTOM, edgecolor=INK, marker="v", linewidth=line
    )
    if of(BEYOND):
        scatter(
            of(BEYOND), "beyond the horizon: no costs", 0.7, color=FAINT, marker="x", linewidth=line
        )


def _wishes(layers: Layers, table: Table, subject: Subject) -> list[Wish]:
    """Return the texts wanted: agent v, symbols of one cost of each kind, names of agents."""
    t, v, names = subject.t, agent_of(subject, SUBJECT, MIDDLE), subject.network.names
    own, before = layers.at(t, v), layers.at(t - 1, v)
    found = [Wish(*own, shown(names[v])), Wish(*own, "$f_t^v$")]
    found.append(Wish(own[0], own[1] * 0.7 + before[1] * 0.3, "$c_t^v$"))
    edges = table.where(kind="spatial", step=t, state=KNOWN).records()
    ends = [row["agent"] + row["other"] - v for row in edges if v in (row["agent"], row["other"])]
    if ends:
        x, y = max((layers.at(t, u) for u in ends), key=lambda p: abs(p[0] - own[0]))
        found.append(Wish((own[0] + x) / 2, (own[1] + y) / 2, "$s_t^e$"))
    agents = table.where(kind="agent").records()
    agents.sort(key=lambda row: (row["distance"] is None, row["distance"], row["agent"]))
    for tau in layers.named(t):
        here = [(layers.at(tau, row["agent"]), shown(names[row["agent"]])) for row in agents]
        found += [Wish(*point, text) for point, text in here if (tau, point) != (t, own)]
    return found


PICTURE = Picture(
    name="information",
    title="What one agent knows: costs k steps ahead and r hops around, and the last actions.",
    caption="The network is repeated for every step, time upwards. Before it acts at step t, agent "
    "v knows the costs of the steps t to t + k - 1 of all agents within r hops, those of the edges "
    "among them (solid), and what they did at step t - 1; all else it does not know (dashed).",
    compute=compute,
    draw=draw,
    subject=SUBJECT,
    takes=("graph", "horizon", "k", "r", "t", "agent"),
    label="fig:information",
)
