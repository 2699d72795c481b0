"""Lower bound, worst cases of LPC, certificates: one picture over k and r."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...lowerbounds import sandwich, search_couplings
from ..looks import EXACT, LOOKS, LOWER, SEARCHED, SHARP, TIERS
from ..parts import constants, legend_below, network_name
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._couplings import say
from ._grids import whole_ticks
from ._text import heading, log_axis

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SMALL = 50  # actions up to which couplings are searched
_PANELS = 5  # at most; of more horizons some are drawn, from the least to the largest
_STEPS = 25  # of the climb from uniform couplings, one for each k and r


def compute(subject: Subject, progress: Progress) -> Table:
    """Return one row for each ``2 <= k <= subject.k``, ``1 <= r <= subject.r``."""
    what = subject.network, subject.horizon, subject.parameters
    ks, rs = range(2, subject.k + 1), range(1, subject.r + 1)
    found = sandwich(*what, ks, rs, seed=subject.seed, progress=progress)
    rows = [vars(row) for row in found.rows]
    if subject.network.vertices * subject.horizon <= _SMALL:
        for row in rows:
            sight = row["k"], row["r"]
            climbed = search_couplings(
                *what,
                *sight,
                starts=1,
                rounds=1,
                steps=_STEPS,
                seed=subject.seed,
                progress=progress,
            )
            row["searched"] = climbed.cr_minus_one
    return Table.of(rows)


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw one panel for each k, over r; between the floor and the certificate all is possible."""
    every = table.distinct("k")
    spread = np.unique(np.linspace(0, len(every) - 1, _PANELS).round().astype(int))
    horizons = [every[i] for i in spread]
    figure = size.figure("page", 0.42)
    panels = figure.subplots(1, len(horizons), sharex=True, sharey=True, squeeze=False)[0]
    for panel, k in zip(panels, horizons, strict=True):
        _panel(panel, table.where(k=k), table)
        panel.set_title(f"$k = {k}$")
        panel.set_xlabel("radius $r$ (hops)")
    panels[0].set_ylabel("competitive ratio $-$ 1")
    if any((table.numbers(name) > 0).any() for name in ("worst", "lower", *TIERS)):
        log_axis(panels[0])
    else:
        panels[0].set_yticks([])
        for panel in panels:
            say(panel, "CR = 1:\nnothing is coupled")
    legend_below(figure, list(panels))
    given = constants(subject, "horizon", "mu", "l_f", "l_T", "l_S")
    some = [f"{len(horizons)} of {len(every)} horizons $k$ drawn"] * (len(horizons) < len(every))
    heading(figure, [f"{network_name(subject)}: {given}", *some])
    return figure


def _panel(panel: Axes, rows: Table, whole: Table) -> None:
    """Draw the lines of one k; a gap is no certificate."""
    r = rows.numbers("r")
    for tier in TIERS:
        values = rows.numbers(tier)
        none = " (none here)" if np.isnan(whole.numbers(tier)).all() else ""
        panel.plot(r, values, **LOOKS[tier].plot(label=f"{tier}{none}"))
    large = f" (up to {_SMALL} actions)" if np.isnan(whole.numbers("searched")).all() else ""
    panel.plot(r, rows.numbers("searched"), **SEARCHED.plot(label=f"searched couplings{large}"))
    panel.plot(r, rows.numbers("worst"), **EXACT.plot(label="exact worst case, uniform"))
    panel.plot(r, rows.numbers("lower"), **LOWER.plot(label="floor of every algorithm"))
    panel.fill_between(
        r, rows.numbers("lower"), rows.numbers("sharp"), color=SHARP.colour, alpha=0.08, linewidth=0
    )
    whole_ticks(panel, r)
    panel.grid(axis="y")


PICTURE = Picture(
    name="sandwich",
    title="The sandwich: floor, exact worst case of LPC, certificates, over k and r.",
    caption="No algorithm that sees k steps and r hops gets below the floor on all costs with "
    "these constants; LPC is certified to stay below the sharp line on all of them. Its exact "
    "worst case over all targets is shown for uniform couplings (which may lie below the floor) "
    "and, in networks of at most 50 actions over all steps, for couplings that a short climb found "
    "to be worse.",
    compute=compute,
    draw=draw,
    subject=Subject("ring:8", l_T=1, l_S=0.5, horizon=6, k=5, r=4),
    takes=("graph", "mu", "l_f", "l_T", "l_S", "horizon", "k", "r", "seed"),
)
