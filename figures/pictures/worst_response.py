"""How all free variables follow one boundary variable, at costs that make one follow it most."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...lpc.arrays import Floats
from ...lpc.instances import instance
from ...lpc.local import LocalProblem
from ...perturbation.neighbourhood import Neighbourhood
from ...perturbation.promised import Promised
from ...perturbation.search import search
from ...perturbation.sensitivity import sensitivity
from ...perturbation.target import Target, part_of
from ..looks import INK, PAPER, SHARP, STATED
from ..parts import constants, legend_below, network_name
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._layers import Layers, Part, thin_line
from ._text import Wish, heading, label, log_ticks, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

STAR = STATED.colour
STARTS = 2  # random ones, of the search
MARKS = "osD^vP"  # of the steps, in the right panel
RANGE = 1e-5  # of the largest response: smaller ones are as good as none


def compute(subject: Subject, progress: Progress) -> Table:
    """Return responses of the free actions of ``psi_(1,v)^(k,r)`` to one boundary variable.

    That is a lateral variable of the last free step, or the top one of v where nothing lies r
    hops away; the costs are those found at which the action of v at step 1 follows it most.
    ``promised`` is the bound of ``nearsight:joint-decay`` on any costs with these constants.
    """
    network, v, p = subject.network, subject.centre, subject.parameters
    around = Neighbourhood.of(network, v, subject.r)  # v is its agent 0
    k = subject.k
    window = LocalProblem(instance(around.network, k, p), 1, 0, k, subject.r)
    fixed = _perturbed(window)
    progress(f"search for the costs of largest response, step {fixed[0]}")
    found = search(
        window,
        Target((1, 0), fixed),
        p,
        starts=STARTS,
        seed=subject.seed,
        growth=subject.setting.growth,
    )
    response = _response(found.window, fixed)
    drawn = Part.around(network, v, subject.r, whole=0)
    rows = drawn.rows(network)
    promised = Promised(p, subject.setting.growth)
    part = part_of(window.terms, fixed[0])
    free = {(int(tau), int(i)) for tau, i in found.window.terms.free[:, 1:]}
    for tau in range(k + 1):
        for i, u in enumerate(around.members.tolist()):
            hops, gap = int(around.distance[i, fixed[1]]), abs(tau - fixed[0])
            row = {"kind": "node", "step": tau, "agent": u, "part": "outside"}
            if (tau, i) in free:
                bound = promised.local(part, np.array([gap]), np.array([hops]))["sharp"][0]
                row |= {"part": "free", "response": response[tau, i], "promised": bound}
            elif (tau, i) == fixed:
                row |= {"part": part}
            rows.append(row | {"hops": hops, "gap": gap})
        rows += [
            {"kind": "spatial", "step": tau, "agent": a, "other": b}
            for a, b in sorted(drawn.graph.edges)
        ]
    return Table.of(rows)


def _perturbed(window: LocalProblem) -> tuple[int, int]:
    """Return the boundary variable of a window around agent 0: lateral if there is one."""
    fixed = [(int(t), int(u)) for t, u in window.terms.fixed[:, 1:]]
    last = int(window.terms.free[:, 1].max())
    lateral = [pair for pair in fixed if pair[0] == last]
    return min(lateral) if lateral else (last + 1, 0)


def _response(window: Any, fixed: tuple[int, int]) -> dict[tuple[int, int], float]:
    """Return ``|d x_(tau,u) / d z|`` for every free action."""
    y, z = (np.zeros((len(pairs), window.problem.n)) for pairs in (window.bottom, window.boundary))
    moved = sensitivity(window, y, z)
    column = moved.fixed.tolist().index(list(fixed))
    return {
        (int(tau), int(u)): float(value)
        for (tau, u), value in zip(moved.free, moved.norms[:, column], strict=True)
    }


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw the responses on the network, a layer a step, and beside the promised decay."""
    from matplotlib.colors import LogNorm

    figure = size.figure("page", 0.5)
    left, right = figure.subplots(1, 2, width_ratios=(1.35, 1))
    free = table.where(kind="node", part="free")
    values = free.numbers("response")
    most = values.max()
    least = values[values >= RANGE * most].min()
    norm: Any = LogNorm(0.8 * least, 1.25 * most, clip=True)
    places = {row["agent"]: (row["x"], row["y"]) for row in table.where(kind="agent").records()}
    nodes = [row for row in table.where(kind="node").records() if row["agent"] in places]
    layers = Layers(tuple(dict.fromkeys(row["step"] for row in nodes)), places)
    names = [f"$t{tau - 1:+d}$" if tau != 1 else "$t$" for tau in layers.steps]
    layers.frame(left, names)
    lines = _lines(left, layers, table, nodes)
    radius = layers.radius(figure, size) * 1.2
    mesh = _marks(left, layers, nodes, radius, norm, subject.centre)
    bar = figure.colorbar(mesh, ax=left, location="bottom", fraction=0.05, aspect=45, pad=0)
    bar.set_label("moved by one unit of the starred variable (white: unmoved)")
    log_ticks(bar.ax.xaxis, norm.vmin, norm.vmax)
    _decay(right, free, norm.vmin)
    parts = [network_name(subject), f"agent {shown(subject.network.names[subject.centre])}"]
    parts += [constants(subject, "mu", "l_f", "l_T", "l_S"), constants(subject, "k", "r")]
    heading(figure, parts)
    legend_below(figure, [left, right])
    order = [Wish(*layers.at(1, u), shown(subject.network.names[u])) for u in places]
    points = layers.points([(row["step"], row["agent"]) for row in nodes])
    font = float(size.settings["font.size"]) - 2
    label(
        left,
        order if len(places) <= 30 else [],
        points,
        lines,
        1.3 * radius,
        fontsize=font,
        color=INK,
    )
    return figure


def _lines(axes: Axes, layers: Layers, table: Table, nodes: list[dict[str, Any]]) -> Floats:
    """Draw edges and steps that touch a free action; return them."""
    from matplotlib.collections import LineCollection

    free = {(row["step"], row["agent"]) for row in nodes if row["part"] == "free"}
    pairs = [((tau, u), (tau + 1, u)) for tau, u in free] + [
        ((tau - 1, u), (tau, u)) for tau, u in free
    ]
    pairs += [
        ((row["step"], row["agent"]), (row["step"], row["other"]))
        for row in table.where(kind="spatial").records()
    ]
    kept = sorted({pair for pair in pairs if free & set(pair)})
    lines = [[layers.at(*a), layers.at(*b)] for a, b in kept]
    axes.add_collection(
        LineCollection(lines, colors="0.7", linewidths=thin_line(), zorder=1), autolim=False
    )
    return np.array(lines, dtype=np.float64).reshape(-1, 2, 2)


def _marks(
    axes: Axes, layers: Layers, nodes: list[dict[str, Any]], radius: float, norm: Any, own: int
) -> Any:
    """Draw free actions in colour and size of their response; return what the colours are of."""

    def scatter(rows: list[dict[str, Any]], scale: Any, **looks: Any) -> Any:
        x, y = layers.points([(row["step"], row["agent"]) for row in rows]).T
        sizes = (2 * radius * np.asarray(scale)) ** 2
        return axes.scatter(x, y, s=sizes, linewidth=thin_line(), **{"zorder": 3, **looks})

    free = [row for row in nodes if row["part"] == "free"]
    still = [row for row in free if row["response"] < norm.vmin]
    mine = [row for row in free if (row["step"], row["agent"]) == (1, own)]
    moved = [row for row in free if row not in still and row not in mine]
    scatter([row for row in nodes if row["part"] == "outside"], 0.35, color="0.6", zorder=2)
    scatter([r for r in still if r not in mine], 0.7, facecolor=PAPER, edgecolor=INK)
    star = [row for row in nodes if row["part"] not in ("free", "outside")]
    text = "perturbed boundary variable"
    scatter(star, 1.6, marker="*", facecolor=STAR, edgecolor=INK, zorder=4, label=text)
    found = None
    for rows, mark, text in ((moved, "o", ""), (mine, "D", "the agent's own action")):
        values = np.array([max(row["response"], norm.vmin) for row in rows])
        scale = 0.7 + 0.6 * np.asarray(norm(values), dtype=np.float64)
        looks: dict[str, Any] = {
            "c": values,
            "norm": norm,
            "cmap": "cividis",
            "edgecolor": INK,
            "label": text,
        }
        found = scatter(rows, scale, marker=mark, **looks)
    return found


def _decay(axes: Axes, free: Table, least: float) -> None:
    """Draw responses over hops, a mark for each gap of time, and what is promised for each."""
    gaps = sorted(set(free.numbers("gap")))
    for j, gap in enumerate(gaps):
        rows = free.where(gap=int(gap))
        mark = MARKS[j % len(MARKS)]
        hops, response = rows.numbers("hops"), rows.numbers("response")
        shade = 0.55 * j / max(len(gaps) - 1, 1)
        each = np.array(sorted(set(zip(hops, rows.numbers("promised"), strict=True))))
        line = SHARP.plot(label="promised (sharp)", alpha=1 - shade)
        axes.plot(*each.T, **line | {"marker": mark, "markersize": 3})
        seen = np.where(response >= least, response, np.nan)
        looks: Any = {"marker": mark, "color": str(shade), "markerfacecolor": PAPER}
        axes.plot(
            hops,
            seen,
            label=f"moved, {gap:g} step{'s' * int(gap != 1)} apart",
            linestyle="",
            **looks,
        )
    axes.set_yscale("log")
    axes.set_xlabel("hops from the starred variable")
    axes.set_ylabel("moved by one unit of it")
    axes.set_xticks(sorted(set(free.numbers("hops"))))
    axes.margins(x=0.08)
    axes.grid(axis="y")


PICTURE = Picture(
    name="worst-response",
    title="How a local problem follows one boundary variable, at the worst costs found.",
    caption="The starred variable moves by one unit; colour and size of a mark say how far the "
    "free variables follow. The costs, quadratics with the constants on top, are those found at "
    "which the agent's own action moves most; beside them what joint decay promises for all costs.",
    compute=compute,
    draw=draw,
    subject=Subject("ring:9", l_T=1, l_S=1, k=4, r=3),
    takes=("graph", "mu", "l_f", "l_T", "l_S", "k", "r", "agent", "seed"),
)
