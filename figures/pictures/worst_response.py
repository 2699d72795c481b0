"""How all free variables follow one boundary variable, at costs that make one follow it most."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...bounds import Parameters
from ...graphs import InputError
from ...lpc.instances import instance
from ...lpc.local import LocalProblem
from ...perturbation.neighbourhood import Neighbourhood
from ...perturbation.promised import Promised
from ...perturbation.search import search
from ...perturbation.sensitivity import sensitivity
from ...perturbation.target import Target, part_of
from ..looks import INK
from ..parts import constants, legend_below, network_name
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._layers import Layers, Part
from ._responses import draw_decay, draw_lines, draw_marks
from ._text import Wish, heading, label, log_ticks, shown

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STARTS = 2  # random ones, of the search
RANGE = 1e-5  # of the largest response: smaller ones are as good as none


def compute(subject: Subject, progress: Progress) -> Table:
    """Return responses of the free actions of ``psi_(1,v)^(k,r)`` to one boundary variable.

    That is a lateral variable of the last free step (of step 1 if l_T = 0), or the top one of v
    where nothing lies r hops away or l_S = 0; the costs are those found at which the action of v
    at step 1 follows it most.
    ``promised`` is the bound of ``nearsight:joint-decay`` on any costs with these constants.
    """
    network, v, p = subject.network, subject.centre, subject.parameters
    around = Neighbourhood.of(network, v, subject.r)  # v is its agent 0
    k = subject.k
    window = LocalProblem(instance(around.network, k, p), 1, 0, k, subject.r)
    fixed = _perturbed(window, p)
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


def _perturbed(window: LocalProblem, p: Parameters) -> tuple[int, int]:
    """Return the boundary variable of a window around agent 0, one that its action can follow.

    Raises
    ------
    InputError
        If couplings are 0 such that there is none.
    """
    steps = window.terms.free[:, 1]
    first, last = int(steps.min()), int(steps.max())
    step = last if p.l_T > 0 else first
    fixed = [(int(t), int(u)) for t, u in window.terms.fixed[:, 1:]]
    lateral = [pair for pair in fixed if pair[0] == step and p.l_S > 0]
    if not lateral and not p.l_T > 0:
        raise InputError("l_T = 0: > 0 is needed, the action follows no boundary variable", "l_T")
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
    lines = draw_lines(left, layers, table, nodes)
    radius = layers.radius(figure, size) * 1.2
    mesh = draw_marks(left, layers, nodes, radius, norm, subject.centre)
    bar = figure.colorbar(mesh, ax=left, location="bottom", fraction=0.05, aspect=45, pad=0)
    bar.set_label("moved by one unit of the star (white: unmoved)")
    log_ticks(bar.ax.xaxis, norm.vmin, norm.vmax)
    draw_decay(right, free, norm.vmin)
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
