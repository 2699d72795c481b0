"""Parts of the picture of a worst response: the marks in the layers, and the decay beside them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...lpc.arrays import Floats
from ..looks import INK, PAPER, SHARP, STATED
from ..parts import thin
from ..table import Table
from ._layers import Layers
from ._text import log_axis

if TYPE_CHECKING:
    from matplotlib.axes import Axes

STAR = STATED.colour
MARKS = "osD^vP"  # of the gaps in time


def draw_lines(axes: Axes, layers: Layers, table: Table, nodes: list[dict[str, Any]]) -> Floats:
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
        LineCollection(lines, colors="0.7", linewidths=thin(), zorder=1), autolim=False
    )
    return np.array(lines, dtype=np.float64).reshape(-1, 2, 2)


def draw_marks(
    axes: Axes, layers: Layers, nodes: list[dict[str, Any]], radius: float, norm: Any, own: int
) -> Any:
    """Draw free actions in colour and size of their response; return what the colours are of."""

    def scatter(rows: list[dict[str, Any]], scale: Any, **looks: Any) -> Any:
        x, y = layers.points([(row["step"], row["agent"]) for row in rows]).T
        sizes = (2 * radius * np.asarray(scale)) ** 2
        return axes.scatter(x, y, s=sizes, linewidth=thin(), **{"zorder": 3, **looks})

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


def draw_decay(axes: Axes, free: Table, least: float) -> None:
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
    log_axis(axes)
    axes.set_xlabel("hops from the starred variable")
    axes.set_ylabel("moved by one unit of it")
    axes.set_xticks(sorted(set(free.numbers("hops"))))
    axes.margins(x=0.08)
    axes.grid(axis="y")
