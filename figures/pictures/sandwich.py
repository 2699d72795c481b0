"""Lower bound, worst cases of LPC, certificates: one picture over k and r."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...lowerbounds import sandwich
from ..looks import EXACT, LOOKS, LOWER, SEARCHED, SHARP, TIERS
from ..parts import constants, legend_below, network_name
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_CLIMBS = 1  # of the search over couplings, where the instance is small enough for it
_SMALL = 30  # unknowns


def compute(subject: Subject, progress: Progress) -> Table:
    """Return one row for each ``2 <= k <= subject.k``, ``1 <= r <= subject.r``."""
    small = subject.network.vertices * subject.horizon <= _SMALL
    found = sandwich(
        subject.network,
        subject.horizon,
        subject.parameters,
        range(2, subject.k + 1),
        range(1, subject.r + 1),
        starts=_CLIMBS if small else 0,
        seed=subject.seed,
        progress=progress,
    )
    return Table.of(vars(row) for row in found.rows)


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw one panel for each k, over r; between the floor and the certificate all is possible."""
    horizons = table.distinct("k")
    figure = size.figure("page", 0.42)
    panels = figure.subplots(1, len(horizons), sharex=True, sharey=True, squeeze=False)[0]
    for panel, k in zip(panels, horizons, strict=True):
        _panel(panel, table.where(k=k), table)
        panel.set_title(f"$k = {k}$")
        panel.set_xlabel("radius $r$ (hops)")
    panels[0].set_ylabel("competitive ratio $-$ 1")
    legend_below(figure, list(panels))
    figure.suptitle(
        f"{network_name(subject)}: {constants(subject, 'horizon', 'mu', 'l_f', 'l_T', 'l_S')}"
    )
    return figure


def _panel(panel: Axes, rows: Table, whole: Table) -> None:
    """Draw the lines of one k; a gap is no certificate."""
    r = rows.numbers("r")
    for tier in TIERS:
        values = rows.numbers(tier)
        none = " (none here)" if np.isnan(whole.numbers(tier)).all() else ""
        panel.plot(r, values, **LOOKS[tier].plot(label=f"{tier}{none}"))
    if not np.isnan(rows.numbers("searched")).all():
        panel.plot(r, rows.numbers("searched"), **SEARCHED.plot(label="searched couplings"))
    panel.plot(r, rows.numbers("worst"), **EXACT.plot(label="exact worst case, uniform"))
    panel.plot(r, rows.numbers("lower"), **LOWER.plot(label="floor of every algorithm"))
    panel.fill_between(
        r, rows.numbers("lower"), rows.numbers("sharp"), color=SHARP.colour, alpha=0.08, linewidth=0
    )
    panel.set_yscale("log")
    panel.set_xticks(r)
    panel.grid(axis="y")


PICTURE = Picture(
    name="sandwich",
    title="The sandwich: floor, exact worst case of LPC, certificates, over k and r.",
    caption="No algorithm that sees k steps and r hops gets below the floor on all costs with "
    "these constants; LPC is certified to stay below the sharp line on all of them, and its exact "
    "worst case over all targets is shown for uniform couplings, which may lie below the floor.",
    compute=compute,
    draw=draw,
    subject=Subject("ring:13", l_T=1, l_S=0.5, horizon=12, k=5, r=4),
    takes=("graph", "mu", "l_f", "l_T", "l_S", "horizon", "k", "r", "seed"),
)
