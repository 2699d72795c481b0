"""The certified competitive ratio over k and r, and the frontiers of some targets."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...bounds import Setting, bounds_for, plan
from ...lpc.arrays import Floats
from ..looks import FAINT, INK, LOOKS, PAPER, TIERS
from ..parts import constants, legend_below, network_name
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._couplings import count_axis, say
from ._grids import cells, edges, limits, shade, whole_ticks
from ._text import heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LEAST, _MOST = (8, 6), (80, 60)  # cells of the map in k and r
_POOR = 10.0  # above it all is one shade
_STYLES = ("-", (0, (4, 1.5)), (0, (1, 1)), (0, (5, 1, 1, 1)))


def compute(subject: Subject, progress: Progress) -> Table:
    """Return the pairs of every tier and target, then the sharp bound over a range around them.

    Of a row of kind ``frontier`` the pair wastes nothing, of kind ``pair`` it has least ``k + r``,
    of kind ``none`` the target is out of reach; a ``cell`` has the sharp bound on ``CR - 1``, a
    gap where there is none.
    """
    found: list[dict[str, Any]] = []
    for target in subject.target:
        planned = plan(subject.setting, target)
        for tier in TIERS:
            one = planned[tier]
            what = {"tier": tier, "target": target, "guarantee": one.guarantee}
            pairs = [("frontier", pair) for pair in one.frontier] + [("pair", one.pair)]
            for kind, pair in pairs:
                if pair is None:
                    found.append({"kind": "none", **what})
                else:
                    at = {"k": pair.k, "r": pair.r, "excess": pair.excess}
                    found.append({"kind": kind, **what, **at})
        progress(f"target {target:g}")
    sharp = [row for row in found if row["tier"] == "sharp" and row["kind"] == "pair"]
    k, r = (
        np.arange(least, min(most, max([1.3 * row[n] + 2 for row in sharp] + [size])) + 1)
        for n, least, size, most in zip(("k", "r"), (2, 1), _LEAST, _MOST, strict=True)
    )
    k, r = (values.astype(int) for values in np.meshgrid(k, r, indexing="ij"))
    (bound,) = (b for b in bounds_for("nearsight:sharp-cr") if b.variant == "vi")
    sized = Setting(subject.parameters, subject.setting.growth, k.ravel(), r.ravel())
    values = np.broadcast_to(bound.in_floats(sized)["cr_minus_one"], k.size)
    for i, value in enumerate(values):
        excess = float(value) if np.isfinite(value) else None
        cell = {"k": int(k.flat[i]), "r": int(r.flat[i]), "excess": excess}
        found.append({"kind": "cell", "tier": "sharp", **cell})
    return Table.of(found)


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw the map on the left, on the right the frontiers of every tier for one target."""
    figure = size.figure("page", 0.46)
    left, right = figure.subplots(1, 2, width_ratios=(1.15, 1))
    _map(figure, left, table.where(kind="cell"))
    k, r = edges(table.where(kind="cell"), "k", "r")
    for target, style in zip(subject.target, _STYLES * len(subject.target), strict=False):
        _outline(left, table.where(tier="sharp", target=target), target, style, (k[-1], r[-1]))
    target = subject.target[min(1, len(subject.target) - 1)]
    _tiers(right, table.where(target=target))
    right.set_title(f"CR $\\leq$ {target:.15g}, every tier")
    legend_below(figure, [left, right])
    given = constants(subject, "mu", "l_f", "l_T", "l_S")
    heading(figure, [f"{network_name(subject)}: {given}"])
    return figure


def _map(figure: Figure, panel: Axes, rows: Table) -> None:
    found = cells(rows, "k", "r", "excess")
    panel.set(xlabel="prediction horizon $k$", ylabel="radius $r$ (hops)")
    panel.set_title("sharp, any convex constraints")
    whole_ticks(panel, rows.numbers("k"), rows.numbers("r"))
    if not (found > 0).any():
        none = np.isnan(found).all()
        k, r = edges(rows, "k", "r")
        panel.set(xlim=(k[0], k[-1]), ylim=(r[0], r[-1]))
        say(panel, "no certificate here" if none else "CR = 1 everywhere:\nnothing is coupled")
        return
    low, high = limits(found)
    span = low, min(high, max(_POOR, 10 * low))
    shade(figure, panel, rows, ("k", "r", "excess"), "competitive ratio $-$ 1", span)
    if np.isnan(found).any():
        blank: Any = {"facecolor": PAPER, "edgecolor": FAINT, "hatch": "////", "linewidth": 0}
        panel.bar([np.nan], [np.nan], label="no certificate", **blank)


def _outline(panel: Axes, rows: Table, target: float, style: Any, end: tuple[float, float]) -> None:
    """Draw the border of the pairs that reach a target, and mark the one of least k + r."""
    from matplotlib import patheffects, rcParams

    chosen = rows.where(kind="pair").records()
    label = f"CR $\\leq$ {target:.15g}"
    if not chosen:
        panel.plot([], [], linestyle=style, color=INK, label=f"{label}: out of reach")
        return
    pairs = [(row["k"], row["r"]) for row in rows.where(kind="frontier").records()]
    x, y = [pairs[0][0] - 0.5], [end[1]]
    for (k, r), (after, _) in zip(pairs, [*pairs[1:], (end[0] + 0.5, 0)], strict=True):
        x += [k - 0.5, after - 0.5]
        y += [r - 0.5, r - 0.5]
    k, r = chosen[0]["k"], chosen[0]["r"]
    casing = patheffects.withStroke(linewidth=2.4 * rcParams["lines.linewidth"], foreground=PAPER)
    inside = k < end[0] and r < end[1]
    beyond = "" if inside else ", beyond this map"
    panel.plot(
        np.clip(x, None, end[0]),
        np.clip(y, None, end[1]),
        color=INK,
        linestyle=style,
        path_effects=[casing],
        label=f"{label}: $k = {k}, r = {r}${beyond}",
        clip_on=True,
    )
    if inside:
        panel.plot(k, r, linestyle="", marker="D", color=INK, markeredgecolor=PAPER)


def _tiers(panel: Axes, rows: Table) -> None:
    seen: list[Floats] = []
    far = 1e9  # a pair with more of both reaches the target, too
    for tier in TIERS:
        one = rows.where(tier=tier)
        line, pair = one.where(kind="frontier"), one.where(kind="pair")
        if not line.rows:
            panel.plot([], [], **LOOKS[tier].plot(label=f"{tier}: out of reach"))
            continue
        word = "" if line.values("guarantee")[0] else " (no guarantee)"
        k, r = line.numbers("k"), line.numbers("r")
        look = LOOKS[tier].plot(label=f"{tier}{word}", marker="")
        x, y = np.concatenate([k[:1], k, [far]]), np.concatenate([[far], r, r[-1:]])
        panel.plot(x, y, drawstyle="steps-post", **look)
        panel.plot(pair.numbers("k"), pair.numbers("r"), **LOOKS[tier].plot(label="_"))
        seen.append(np.stack([k, r]))
    panel.set(xlabel="prediction horizon $k$", ylabel="radius $r$ (hops)")
    if not seen:
        say(panel, "no tier reaches it")
        panel.set(xticks=[], yticks=[])
        return
    both = np.concatenate(seen, axis=1)
    for values, vertical in zip(both, (False, True), strict=True):
        count_axis(panel, np.array([1.0, max(4.0, 2.5 * values.max())]), vertical=vertical)
    panel.grid()


PICTURE = Picture(
    name="ratio-bound",
    title="The certified competitive ratio over k and r, with the frontiers of some targets.",
    caption="Left: the sharp bound on CR - 1 for any convex product constraints. Above and right "
    "of a line every pair on its border wastes nothing for this target; diamonds have least k + r. "
    "Right: the same border in every tier for one target, on another scale.",
    compute=compute,
    draw=draw,
    subject=Subject("ring:201", l_f=4, l_T=5, l_S=2.5, target=(1.1, 1.01, 1.001)),
    takes=("graph", "mu", "l_f", "l_T", "l_S", "target"),
)
