"""The ring of blocks on which lower bounds live, and how ``(I + l L)^-1`` decays along it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from scipy import sparse

from ...bounds.decay import demko, gamma_S
from ...graphs import Network
from ...lowerbounds.ring import Ring
from ...lpc.arrays import Floats
from ...perturbation.sensitivity import solve_refined
from ..looks import EXACT, INK, LOWER, SHARP, STATED
from ..parts import constants, legend_below, network_name
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._layers import Part
from ._rings import draw_network, ring_of, ring_places
from ._text import Wish, heading, label, log_axis, shown

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

WHOLE, REACH = 200, 4  # agents drawn at once, or hops around one
NAMED = 40  # agents that get their names


def compute(subject: Subject, progress: Progress) -> Table:
    """Return the entries ``B_uv`` of ``B = (I + l L)^-1``, ``l = l_S/(2 mu)``, for one v.

    Rows are agents and edges that are drawn, and one for each distance: the largest and smallest
    entry, and between what they lie. ``upper`` is ``c(1+x) gamma_S^kappa`` [Demko, Moss, Smith],
    ``x = Delta a_S``; ``shortest`` the share of shortest walks in the smallest entry; ``printed``
    the first claim of the lemma (a lower bound) on a ring of blocks.
    """
    network, v, p = subject.network, subject.centre, subject.parameters
    ell, ring = p.a_S / 2, ring_of(network)
    drawn = Part.around(network, v, REACH, WHOLE)
    at = ring_places(ring, v) if ring and network.vertices <= WHOLE else drawn.places
    entries, (levels, walks) = _column(network, v, ell), _shortest(network, v, ell)
    rows: list[dict[str, Any]] = [
        row | {"x": at[row["agent"]][0], "y": at[row["agent"]][1], "entry": entries[row["agent"]]}
        for row in drawn.rows(network)
    ]
    rows += [{"kind": "edge", "agent": a, "other": b} for a, b in sorted(drawn.graph.edges)]
    x = network.max_degree * p.a_S
    for kappa in range(levels.max() + 1):
        mine = levels == kappa
        rows.append({
            "kind": "decay",
            "distance": kappa,
            "largest": entries[mine].max(),
            "smallest": entries[mine].min(),
            "upper": float(demko(1 + x)) * float(gamma_S(x)) ** kappa,
            "shortest": walks[mine].min(),
            "printed": _printed(ring, ell, kappa),
        })  # fmt: skip
    return Table.of(rows)


def _column(network: Network, v: int, ell: float) -> Floats:
    """Return column v of B, small entries to many digits."""
    n = network.vertices
    weights = np.full(len(network.indices), -ell)
    matrix = sparse.csr_array((weights, network.indices, network.indptr), shape=(n, n))
    matrix = matrix + sparse.dia_array(((1 + ell * network.degrees)[None], [0]), shape=(n, n))
    unit = np.zeros((n, 1))
    unit[v] = 1
    return solve_refined(sparse.csr_array(matrix), unit)[:, 0]


def _shortest(network: Network, v: int, ell: float) -> tuple[Floats, Floats]:
    """Return hops from v (-1: none lead there), and what shortest walks alone give of B_uv.

    A walk ``v = u_0, ..., u_m = u`` gives ``l^m / prod (1 + l deg u_i)``: all terms of the sum
    ``B = sum_m ((I + l D)^-1 l M)^m (I + l D)^-1`` are positive.
    """
    own = 1 / (1 + ell * network.degrees)
    hops, walks = np.full(network.vertices, -1), np.zeros(network.vertices)
    hops[v], walks[v], level = 0, own[v], [v]
    while level:
        near: dict[int, float] = {}
        for u in level:
            for w in map(int, network.neighbours(u)):
                if hops[w] < 0:
                    near[w] = near.get(w, 0.0) + walks[u] * ell * own[w]
        for w, weight in near.items():
            hops[w], walks[w] = hops[level[0]] + 1, weight
        level = list(near)
    return hops, walks


def _printed(ring: Ring | None, ell: float, kappa: int) -> float | None:
    """Return the printed lower bound, where its hypotheses hold."""
    if ring is None or kappa < 3:
        return None
    claim = ring.first_claim(ell, kappa)
    return float(claim.claimed) if claim.hypotheses else None


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw the network in the colours of its entries, and the entries over the distance."""
    from matplotlib.colors import LogNorm

    figure = size.figure("page", 0.47)
    left, right = figure.subplots(1, 2, width_ratios=(1, 1.15))
    agents = table.where(kind="agent").records()
    values = {row["agent"]: float(row["entry"]) for row in agents if row["entry"] > 0}
    decay = table.where(kind="decay")
    norm = LogNorm(min(values.values()), max(*values.values(), 1.000001 * min(values.values())))
    _decay(right, decay, norm)
    edges = [(row["agent"], row["other"]) for row in table.where(kind="edge").records()]
    at = {row["agent"]: (row["x"], row["y"]) for row in agents}
    font = float(size.settings["font.size"])
    radius = font * float(np.clip(3.2 / np.sqrt(len(at) + 1), 0.15, 0.5))
    lines = draw_network(
        left, at, edges, values, norm, {subject.centre: "*"}, radius=radius, edge=0.06 * font
    )
    parts = [network_name(subject), constants(subject, "mu", "l_S")]
    if len(at) < subject.network.vertices:
        parts.append(f"the {len(at)} nearest of {subject.network.vertices} agents drawn")
    heading(figure, parts)
    if len(values) < len(agents):
        blank: Any = {"linestyle": "", "marker": "o", "color": INK, "markerfacecolor": "none"}
        right.plot([], [], label="white: $B_{uv} = 0$", **blank)
    legend_below(figure, right)
    wishes = [Wish(*at[u], shown(subject.network.names[u])) for u in at if len(at) <= NAMED]
    label(left, wishes, np.array(list(at.values())), lines, radius, fontsize=font - 2, color=INK)
    return figure


def _decay(axes: Axes, rows: Table, norm: Any) -> None:
    """Draw all entries of each distance between the bounds."""
    from matplotlib import rcParams
    from matplotlib.ticker import MaxNLocator

    kappa = rows.numbers("distance")
    largest, smallest = (
        np.ma.masked_less_equal(rows.numbers(n), 0) for n in ("largest", "smallest")
    )
    upper, shortest = (np.ma.masked_less_equal(rows.numbers(n), 0) for n in ("upper", "shortest"))
    alone = len(kappa) == 1  # a line needs two distances
    bound = r"sharp upper bound $c\,\gamma_S^\kappa$"
    axes.plot(kappa, upper, **SHARP.plot(marked=alone, label=bound))
    area = (0.8 * float(rcParams["lines.markersize"])) ** 2
    axes.vlines(kappa, smallest, largest, color=EXACT.colour)
    for values, text in ((largest, "exact, colours as on the left"), (smallest, "")):
        axes.plot(
            kappa, values, **EXACT.plot(linestyle="", label=text, markerfacecolor="none", zorder=2)
        )
        shown_ = values.filled(np.nan)
        axes.scatter(kappa, shown_, c=shown_, norm=norm, marker="D", s=area, zorder=3, linewidth=0)
    axes.plot(kappa, shortest, **LOWER.plot(label="lower bound: shortest walks"))
    if not np.isnan(rows.numbers("printed")).all():
        axes.plot(kappa, rows.numbers("printed"), **STATED.plot(label="stated lower bound"))
    log_axis(axes)
    axes.set_xlabel(r"distance $\kappa = d(u, v)$ (hops)")
    axes.set_ylabel(r"entry $B_{uv}$ of $(I + \frac{\ell_S}{2\mu} L)^{-1}$")
    axes.xaxis.set_major_locator(MaxNLocator(integer=True))
    if alone:
        axes.set_xlim(-1, 1)
        axes.set_xticks(kappa)
    axes.grid(axis="y")


PICTURE = Picture(
    name="ring-of-blocks",
    title="The ring of blocks, and how the inverse of I + l L decays with the distance.",
    caption="Blocks of vertices on a ring, neighbouring blocks completely joined; colours and "
    "diamonds are the exact entries for the starred agent v. On every network they lie between "
    "the share of shortest walks and the sharp bound; on a ring of blocks with weak couplings "
    "the stated lower bound is larger than the exact entry.",
    compute=compute,
    draw=draw,
    subject=Subject("ring-of-blocks:16x2", l_S=0.2),
    takes=("graph", "l_S", "agent"),
    label="fig:G_exp_decay_lower",
)
