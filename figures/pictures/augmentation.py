"""Resource augmentation: how much more LPC has to see than the best algorithm."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ...bounds import Setting, bounds_for
from ...bounds.lower import final_excess
from ...bounds.planner import plan_excess
from ...graphs import InputError
from ...lowerbounds import Spatial, asymmetric_excess, worst_case
from ...lpc.instances import instance
from ..looks import EXACT, INK, LOOKS, SHARP, TIERS
from ..parts import constants, legend_below, network_name, style, thin
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._couplings import count_axis, say
from ._text import heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_NAMES = {"time": ("k", "steps"), "space": ("r", "hops")}
_MOST = 1000  # actions up to which worst cases are computed
_LABEL = "coro:resource-augmentation"


def compute(subject: Subject, progress: Progress) -> Table:
    """Return what is needed for each ``k* <= subject.k``, ``r* <= subject.r``, and the limits.

    One resource at a time, the other without limit: LPC sees all steps, or the whole network.
    """
    open_setting = replace(subject.setting, unconstrained=True)
    rows = []
    for direction in _NAMES:
        worst = _worst(subject, direction, progress)
        for star, lower in _floors(subject, direction):
            needed = next((seen for seen, value in worst.items() if value <= lower), None)
            certified = _certified(open_setting, direction, lower)
            kind = {"kind": "finite", "direction": direction, "star": star, "lower": lower}
            rows.append({**kind, "measured": needed, "certified": certified})
        rows += list(_limits(open_setting, direction))
    return Table.of(rows)


def _floors(subject: Subject, direction: str) -> Iterator[tuple[int, float]]:
    """Yield ``k*`` or ``r*`` and what no algorithm with it beats, as long as that is above 0."""
    p, network = subject.parameters, subject.network
    a_T, a_S = float(p.a_T), float(p.a_S)
    for star in range(1, (subject.k if direction == "time" else subject.r) + 1):
        if direction == "time":
            lower = float(max(asymmetric_excess(a_T, star), final_excess(a_T, star)))
        else:
            charges = Spatial(network, a_S, star).search()
            lower = float(charges.ratios[charges.best])
        if not lower > 0:
            return
        yield star, lower


def _worst(subject: Subject, direction: str, progress: Progress) -> dict[int, float]:
    """Return the exact worst case of LPC by what it sees in one direction, uniform couplings."""
    network, H = subject.network, subject.horizon
    if network.vertices * H > _MOST:
        raise InputError(
            f"horizon = {H}: at most {_MOST} actions over all steps, "
            f"{network.vertices} agents take {network.vertices * H}",
            "horizon",
        )
    problem = instance(network, H, subject.parameters)
    found = {}
    for seen in range(2, H + 2) if direction == "time" else range(1, network.vertices + 1):
        k, r = (seen, network.vertices) if direction == "time" else (H + 1, seen)
        progress(f"worst case of LPC, k = {k}, r = {r}")
        found[seen] = worst_case(problem, k, r).cr_minus_one
        if found[seen] == 0:  # it sees everything
            break
    return found


def _certified(setting: Setting, direction: str, lower: float) -> int | None:
    """Return the least k, or r, with which LPC is certified to do as well."""
    pairs = plan_excess(setting, lower, "sharp").frontier
    return min((p.k if direction == "time" else p.r for p in pairs), default=None)


def _limits(setting: Setting, direction: str) -> Iterator[dict[str, Any]]:
    """Yield the factors as k* and r* grow, of each tier; stated also those of its rates here."""
    letter, _ = _NAMES[direction]
    for bound in bounds_for(_LABEL):
        values = bound.evaluate(setting).values
        row = {"kind": "limit", "direction": direction, "tier": bound.tier}
        yield {**row, "factor": values.get(f"{letter}_ratio")}
        if bound.tier == "stated":
            yield {**row, "tier": "rates", "factor": values.get(f"{letter}_ratio_of_rates")}


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw one panel for time, one for space."""
    figure = size.figure("page", 0.42)
    panels = figure.subplots(1, 2)
    for panel, direction in zip(panels, _NAMES, strict=True):
        _panel(panel, direction, table.where(direction=direction))
    legend_below(figure, list(panels))
    what = constants(subject, "horizon", "mu", "l_f", "l_T", "l_S")
    heading(figure, [f"{network_name(subject)}: {what}"])
    return figure


def _panel(panel: Axes, direction: str, rows: Table) -> None:
    """Draw the factors needed, and their limits as lines."""
    letter, unit = _NAMES[direction]
    finite, limits = rows.where(kind="finite"), rows.where(kind="limit")
    panel.set_title(direction)
    panel.set_xlabel(f"the best algorithm sees ${letter}^*$ ({unit})")
    panel.set_ylabel(f"LPC needs ${letter}/{letter}^*$")
    if not finite.rows:
        panel.set(xticks=[], yticks=[])
        say(panel, "nothing is coupled in this direction")
        return
    star = finite.numbers("star")
    measured, certified = (finite.numbers(name) / star for name in ("measured", "certified"))
    wide = SHARP.plot(
        label="certified, any costs (sharp)", markersize=2 * style("lines.markersize")
    )
    panel.plot(star, certified, **wide)  # seen also where the next line covers it
    panel.plot(star, measured, **EXACT.plot(label="exact worst case, uniform couplings"))
    factors = {row["tier"]: row["factor"] for row in limits.records() if row["factor"] is not None}
    for tier in TIERS:
        if tier == "stated" and "stated" in factors:
            panel.axhline(factors["stated"], color=INK, linewidth=thin(), label="limit, printed")
        name = "rates" if tier == "stated" else tier
        label = "limit, printed rates here" if tier == "stated" else f"limit, {tier}"
        if name in factors:
            look = LOOKS[tier].plot(label=label, marked=False)
            panel.axhline(factors[name], **{**look, "markerfacecolor": "none"})
    shown = np.concatenate([measured, certified, list(factors.values())])
    count_axis(panel, shown[np.isfinite(shown)])
    panel.set_xticks(star[:: -(-len(star) // 10)])
    panel.set_xlim(0.5, max(star) + 0.5)
    panel.grid(axis="y")


PICTURE = Picture(
    name="augmentation",
    title="Resource augmentation: how much more LPC has to see than the best algorithm.",
    caption="The least k over k*, and r over r*, with which LPC does at least as well as any "
    "algorithm that sees k* steps, or r* hops, could over all costs; the other resource is without "
    "limit. Certified for all costs, and measured as its exact worst case for uniform couplings. "
    "Lines: the factors as k* and r* grow.",
    compute=compute,
    draw=draw,
    subject=Subject("ring:15", l_T=1, l_S=0.5, horizon=11, k=8, r=6),
    takes=("graph", "mu", "l_f", "l_T", "l_S", "horizon", "k", "r"),
)
