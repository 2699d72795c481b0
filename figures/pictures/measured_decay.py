"""Measured against promised decay, by distance in time and in space."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...perturbation import Spec, measure
from ...perturbation.profile import ROUNDING
from ..looks import INK, PAPER, TIERS
from ..parts import constants, legend_below, network_name
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._couplings import say
from ._grids import cells, limits, shade, whole_ticks
from ._text import heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LOOSE = 1e8  # promises looser than this times the tightest are one shade


def compute(subject: Subject, progress: Progress) -> Table:
    """Return one row for each boundary part and distance: the largest value, the promises."""
    spec = Spec(subject.network, subject.parameters, subject.k, subject.r, seed=subject.seed)
    found = measure(
        spec,
        subject.instances,
        progress=lambda done, total: progress(f"{done} of {total} instances"),
    )
    return Table.of(
        {
            "part": cell.part,
            "dt": cell.dt,
            "ds": cell.ds,
            "measured": cell.measured_max,
            **{tier: cell.bounds[tier] for tier in TIERS},
        }
        for cell in found.profiles
    )


def worst_parts(table: Table) -> Table:
    """Return one row a distance: the largest value and each tier's least promised/measured.

    Of the parts of the boundary that are as far away; a tier without a ratio has a gap.
    """
    found: dict[tuple[int, int], dict[str, Any]] = {}
    for row in table.records():
        at = found.setdefault((row["dt"], row["ds"]), {"dt": row["dt"], "ds": row["ds"]})
        at["measured"] = max(at.get("measured", 0.0), row["measured"])
        for tier in TIERS:
            if row["measured"] > 0:
                ratio = row[tier] / row["measured"]
                at[tier] = min(at.get(tier, np.inf), ratio)
    whole = {"dt": None, "ds": None, "measured": None, **dict.fromkeys(TIERS)}
    return Table.of({**whole, **row} for row in found.values())


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw the measured values, then promised over measured of each tier."""
    figure = size.figure("page", 0.34)
    panels = figure.subplots(1, 4, sharex=True, sharey=True)
    rows = worst_parts(table)
    real = np.concatenate([cells(rows, "ds", "dt", tier).ravel() for tier in TIERS])
    measured = cells(rows, "ds", "dt", "measured")
    for panel in panels:
        panel.set_xlabel("hops")
    panels[0].set_ylabel("steps")
    panels[0].set_title("measured")
    for panel, tier in zip(panels[1:], TIERS, strict=True):
        panel.set_title(tier)
    if not (measured > 0).any():
        for panel in panels:
            say(panel, "nothing is\ncoupled")
            panel.set(xticks=[], yticks=[])
        return figure
    shade(figure, panels[0], rows, ("ds", "dt", "measured"), "sensitivity")
    whole_ticks(panels[0], rows.numbers("ds"), rows.numbers("dt"))
    positive = real[np.isfinite(real) & (real > 0)]
    low, high = limits(positive)
    span = low, high
    if positive.min() < high / 2:
        span = float(positive.min()), min(high, _LOOSE * float(positive.min()))
    for j, (panel, tier) in enumerate(zip(panels[1:], TIERS, strict=True)):
        label = "promised / measured"
        shade(figure, panel, rows, ("ds", "dt", tier), label, span, bar=j == len(TIERS) - 1)
        _violations(panel, rows, tier)
    if any(axes.get_legend_handles_labels()[1] for axes in panels):
        legend_below(figure, list(panels))
    given = constants(subject, "mu", "l_f", "l_T", "l_S", "k", "r")
    heading(figure, [f"{network_name(subject)}: {given}", f"{subject.instances} instances"])
    return figure


def _violations(panel: Axes, rows: Table, tier: str) -> None:
    """Cross out where less is promised than was measured."""
    from matplotlib import patheffects, rcParams

    below = rows.numbers(tier) < 1 / (1 + ROUNDING)
    if below.any():
        casing = patheffects.withStroke(linewidth=2.2 * rcParams["lines.linewidth"], foreground=INK)
        panel.plot(
            rows.numbers("ds")[below],
            rows.numbers("dt")[below],
            linestyle="",
            marker="x",
            color=PAPER,
            path_effects=[casing],
            label="promise violated",
        )


PICTURE = Picture(
    name="measured-decay",
    title="Measured against promised decay of boundary errors, over time and space.",
    caption="Left: the largest derivative of a local solution in one boundary variable so many "
    "steps and hops away, over random instances with exactly these constants. Then what each tier "
    "promises over it, the least of the boundary parts as far away; crosses where the promise is "
    "violated, hatched where there is no boundary, or no influence.",
    compute=compute,
    draw=draw,
    subject=Subject("regular:3x40", l_f=4, l_T=0.5, l_S=0.02, k=6, r=3, instances=24),
    takes=("graph", "mu", "l_f", "l_T", "l_S", "k", "r", "instances", "seed"),
)
