"""LPC's trajectory beside the clairvoyant optimum: who deviates, when, at what cost."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...bounds import Setting, bounds_for
from ...lpc.arrays import Floats
from ...lpc.instances import instance
from ...lpc.simulation import Simulation, simulate
from ..looks import INK, NEARSIGHTED, OPTIMUM, PLANNED
from ..parts import constants, legend_below, network_name, number, thin
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._couplings import say
from ._layers import Part
from ._rings import draw_network
from ._text import Wish, heading, label, log_axis, log_ticks, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SHORT = (2, 1)  # k and r of the shortsighted run beside
WHOLE, REACH = 200, 5  # agents drawn at once, or hops around one
STRETCH = 1.6  # of the height of the network
MARKS = "*D"  # of the agents whose actions are drawn
NAMED = 20  # agents that get their names
RANGE = 1e-6  # of the largest deviation: smaller ones are drawn as this
TINY = 1e-8, 1e-12  # deviations, and ratios minus 1, below which solvers say nothing
CERTIFICATE = "nearsight:sharp-cr"


def compute(subject: Subject, progress: Progress) -> Table:
    """Return both runs of LPC and the optimum on one random instance with box [-1, 1].

    Rows are agents with their largest deviation from the optimum over all steps (``short`` with
    k = 2 and r = 1, ``long`` with the subject's), edges that are drawn, steps with the largest
    deviation of all agents, the actions of the agents that deviate most in either run, and one row
    a run with its ratio and what is promised for it.
    """
    network, p = subject.network, subject.parameters
    problem = instance(network, subject.horizon, p, seed=subject.seed, box=(-1.0, 1.0))
    sights = {"short": SHORT, "long": (subject.k, subject.r)}
    runs: dict[str, Simulation] = {}
    for name, (k, r) in sights.items():
        progress(f"LPC with k = {k}, r = {r}")
        runs[name] = simulate(problem, k, r)
    best = runs["long"].optimum.x
    off = {name: np.linalg.norm(run.x - best, axis=2) for name, run in runs.items()}
    chosen = _chosen(off["short"].max(axis=0), off["long"].max(axis=0))
    drawn = Part.around(network, chosen[0], REACH, WHOLE)
    rows = [
        row | {name: off[name][:, row["agent"]].max() for name in runs}
        for row in drawn.rows(network)
    ]
    rows += [{"kind": "edge", "agent": a, "other": b} for a, b in sorted(drawn.graph.edges)]
    for s in range(subject.horizon):
        largest = {name: off[name][s].max() for name in runs}
        rows.append({"kind": "step", "step": s + 1} | largest)
    for u in chosen:
        for s in range(subject.horizon):
            actions = {name: run.x[s, u, 0] for name, run in runs.items()}
            actions["optimum"] = best[s, u, 0]
            rows.append({"kind": "action", "agent": u, "step": s + 1} | actions)
    for name, (k, r) in sights.items():
        ratio = {"ratio": runs[name].ratio_minus_one, "promised": _promised(subject, k, r)}
        rows.append({"kind": "run", "name": name, "k": k, "r": r, **ratio})
    return Table.of(rows)


def _chosen(short: Floats, long: Floats) -> list[int]:
    """Return the agent that deviates most at short sight, and another that does at long sight."""
    first = int(short.argmax())
    others = [u for u in np.argsort(-long, kind="stable").tolist() if u != first]
    return [first, *others[:1]]


def _promised(subject: Subject, k: int, r: int) -> float | None:
    """Return the certificate of CR - 1, None if there is none."""
    setting = Setting(subject.parameters, subject.setting.growth, k, r)
    found = bounds_for(CERTIFICATE)[0].evaluate(setting)
    return float(found.values["cr_minus_one"]) if found.guarantee else None


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw the network in the colours of its deviations, and beside it trajectories."""
    from matplotlib.colors import LogNorm

    figure = size.figure("page", 0.58)
    chosen = [int(str(u)) for u in table.where(kind="action").distinct("agent")]
    halves: Any = figure.subfigures(1, 2, width_ratios=(1, 1.2))
    left, right = halves
    network = left.subplots()
    panels: Any = right.subplots(len(chosen) + 1, 1, sharex=True)
    agents = table.where(kind="agent").records()
    at = {row["agent"]: (row["x"], row["y"]) for row in agents}
    most = max(TINY[0], *(row["long"] for row in agents))
    values = {row["agent"]: max(row["long"], RANGE * most, TINY[0]) for row in agents}
    norm: Any = LogNorm(0.8 * min(values.values()), 1.25 * most)
    font = float(size.settings["font.size"])
    radius = font * float(np.clip(3 / np.sqrt(len(at) + 1), 0.15, 0.5))
    edges = [(row["agent"], row["other"]) for row in table.where(kind="edge").records()]
    marks = dict(zip(chosen, MARKS, strict=False))
    lines = draw_network(network, at, edges, values, norm, marks, radius=radius, edge=0.06 * font)
    high = max(y for _, y in at.values())
    network.set_aspect(float(np.clip(1.1 / max(high, 0.1), 1, STRETCH)))
    shades = network.collections[-1]
    bar = left.colorbar(shades, ax=network, location="bottom", aspect=35, pad=0.02, panchor=False)
    bar.set_label(f"largest deviation, $k = {subject.k}$, $r = {subject.r}$")
    log_ticks(bar.ax.xaxis, norm.vmin, norm.vmax)
    _panels(list(panels), table, subject, chosen)
    parts = [network_name(subject), constants(subject, "horizon", "mu", "l_f", "l_T", "l_S")]
    if len(at) < subject.network.vertices:
        parts.append(f"{len(at)} of {subject.network.vertices} agents drawn")
    heading(figure, parts)
    legend_below(figure, panels[0])
    names = subject.network.names
    wishes = [Wish(*at[u], shown(names[u])) for u in at if len(at) <= NAMED]
    label(
        network,
        wishes,
        np.array(list(at.values())),
        lines,
        1.3 * radius,
        fontsize=font - 1,
        color=INK,
    )
    return figure


def _panels(panels: list[Axes], table: Table, subject: Subject, chosen: list[int]) -> None:
    """Draw the actions of some agents, and the largest deviation of all, over the steps."""
    from matplotlib.ticker import MaxNLocator

    looks = {"optimum": OPTIMUM, "short": NEARSIGHTED, "long": PLANNED}
    texts = {"optimum": OPTIMUM.label} | {
        row["name"]: _told(row) for row in table.where(kind="run").records()
    }
    for panel, u, mark in zip(panels, chosen, MARKS, strict=False):
        rows = table.where(kind="action", agent=u)
        for name, look in looks.items():
            line = look.plot(label=texts[name])
            if name == "optimum":  # thin, and above the others
                line |= {"linewidth": 1.4 * thin(), "zorder": 3}
            panel.plot(rows.numbers("step"), rows.numbers(name), **line)
        sign = {"*": "star", "D": "diamond"}[mark]
        panel.set_title(f"action of agent {shown(subject.network.names[u])} ({sign})")
    rows, hidden = table.where(kind="step"), False
    for name in ("short", "long"):
        values = np.ma.masked_less(rows.numbers(name), TINY[0])
        hidden |= bool(np.any(values.mask))
        panels[-1].plot(rows.numbers("step"), values, **looks[name].plot(label=texts[name]))
    if any((rows.numbers(name) >= TINY[0]).any() for name in ("short", "long")):
        log_axis(panels[-1])
    else:
        panels[-1].set_yticks([])
        say(panels[-1], "nowhere")
    text = f"largest deviation, where above ${number(TINY[0])}$"
    panels[-1].set_title(text if hidden else "largest deviation from the optimum")
    panels[-1].set_xlabel("step $t$")
    panels[-1].xaxis.set_major_locator(MaxNLocator(integer=True))
    for panel in panels:
        panel.grid(axis="y")


def _told(row: dict[str, Any]) -> str:
    """Return what the legend says of a run."""
    bound = row["promised"]
    promised = "nothing promised" if bound is None else f"promised {_number(bound)}"
    sight = f"$k = {row['k']}$, $r = {row['r']}$"
    return f"{sight}: ratio $-$ 1: {_number(row['ratio'])}, {promised}"


def _number(value: float) -> str:
    """Return a ratio minus 1 with two digits, as far as these mean something."""
    return f"{value:.2g}" if value >= TINY[1] else f"below {TINY[1]:g}"


PICTURE = Picture(
    name="ieee118-trajectory",
    title="LPC's trajectory beside the clairvoyant optimum, on the IEEE 118-bus network.",
    caption="Left: how far each agent is at most from the clairvoyant optimum of a random "
    "instance with box [-1, 1]. Right: the actions of the marked agents, those that deviate most, "
    "and the largest deviation of all agents; the legend compares the measured ratio of costs "
    "with what the sharp bound promises on every instance.",
    compute=compute,
    draw=draw,
    subject=Subject("ieee118", l_f=4, l_T=1, l_S=0.1, horizon=24, k=4, r=3),
    takes=("graph", "mu", "l_f", "l_T", "l_S", "horizon", "k", "r", "seed"),
)
