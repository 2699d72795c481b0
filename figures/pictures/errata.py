"""Every refuted claim: the printed bound over what is true at its counterexample."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...verify import Evidence, catalogue
from ...verify.recorded import recorded
from ...verify.run import run
from ..looks import FAINT, INK, VERDICTS
from ..parts import legend_below, style, thin
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._verdicts import verdicts

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_WHOLE = ("theorem", "lemma", "corollary")
_GROUPS = {
    "theorems, lemmas, corollaries": VERDICTS["refuted"],
    "steps, remarks, definitions": "#F4BF9A",
}
_LONGEST = 42  # letters of a name
_FAR = 3.0  # decades that are drawn; what is further left has an arrow


def compute(subject: Subject, progress: Progress) -> Table:
    """Return one row for each claim that is refuted now, as ``left <= right`` at its instance.

    Judged again are the claims recorded as refuted, and those on which nothing is recorded.
    """
    known = recorded()
    claims = [c for c in catalogue() if known.get(c.key, "refuted") == "refuted"]
    report = run(claims=claims, progress=lambda done, total: progress(f"{done} of {total} claims"))
    found: list[dict[str, Any]] = []
    for claim in report.claims:
        if claim.key in report.errors or report[claim.key].verdict != "refuted":
            continue
        row = {"claim": claim.key, "group": _group(claim.kind), "title": claim.title}
        found.append({**row, **_sides(report[claim.key].evidence)})
    return Table.of(found)


def _group(kind: str) -> str:
    whole, part = _GROUPS
    return whole if kind in _WHOLE else part


def _sides(evidence: Evidence) -> dict[str, float | None]:
    """Return both sides and their ratio; a gap where the sides have none below 1."""
    left, right = evidence.measured, evidence.bound
    ratio = None
    if left is not None and right is not None and left > 0 and right < left:
        ratio = max(right, 0.0) / left
    return {"left": left, "right": right, "ratio": ratio}


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw one bar a claim in two columns: by group, the worst of each first."""
    rows = [row for group in _GROUPS for row in _sorted(table.where(group=group))]
    half = (len(rows) + 1) // 2
    figure = size.figure("page", 0.16 + 0.0195 * half)
    panels = figure.subplots(1, 2, sharex=True)
    positive = [row["ratio"] for row in rows if row["ratio"] > 0]
    low = 10.0 ** max(-_FAR, float(np.floor(np.log10(min(positive, default=0.1)))))
    room = figure.bbox.height / figure.dpi * 72 / (half + 8)  # points a row
    for panel, column in zip(panels, (rows[:half], rows[half:]), strict=True):
        _bars(panel, column, low, min(0.86 * room, style("font.size") - 1.5))
        panel.set_ylim(half - 0.3, -0.7)
        panel.set_xlabel("right side / left side")
    for group, colour in _GROUPS.items():
        panels[0].bar([np.nan], [np.nan], color=colour, label=group)
    legend_below(figure, list(panels))
    silent = len(table.rows) - len(rows)
    more = f" ({silent} more without sides to compare)" if silent else ""
    figure.suptitle(f"{len(rows)} refuted claims, printed as left $\\leq$ right{more}")
    return figure


def _sorted(rows: Table) -> list[dict[str, Any]]:
    known = [row for row in rows.records() if row["ratio"] is not None]
    return sorted(known, key=lambda row: (row["ratio"], row["claim"]))


def _bars(panel: Axes, rows: list[dict[str, Any]], low: float, points: float) -> None:
    """Draw the bars from 1 to the left; an arrow where they go on."""
    from matplotlib.ticker import LogLocator, NullLocator

    panel.set_xscale("log")
    panel.set_xlim(low / 2, 1)
    panel.xaxis.set_major_locator(LogLocator(numticks=4))
    panel.xaxis.set_minor_locator(NullLocator())
    panel.grid(axis="x")
    places = np.arange(len(rows))
    for place, row in zip(places, rows, strict=True):
        ratio = max(row["ratio"], low / 2)
        panel.barh(place, 1 - ratio, left=ratio, height=0.62, color=_GROUPS[row["group"]])
        if row["ratio"] < low / 2:
            panel.plot(low / 1.6, place, linestyle="", marker="<", color=INK, markersize=points / 2)
        panel.annotate(
            _ratio(row["ratio"]),
            (1, place),
            xytext=(0.4 * points, 0),
            textcoords="offset points",
            va="center",
            fontsize=points,
        )
    panel.set_yticks(places, [_short(row["claim"]) for row in rows], fontsize=points)
    panel.tick_params(axis="y", length=0)
    panel.axvline(1, color=INK, linewidth=2 * thin(), clip_on=False)
    panel.spines["left"].set_color(FAINT)


def _ratio(value: float) -> str:
    """Return three digits, of what is missing where it is near 1."""
    return f"{value:.3g}" if value < 0.9995 else f"1 $-$ {1 - value:.2g}"


def _short(key: str) -> str:
    if len(key) <= _LONGEST:
        return key
    half = (_LONGEST - 1) // 2
    return f"{key[:half]}\N{HORIZONTAL ELLIPSIS}{key[-half:]}"


PICTURE = Picture(
    name="errata",
    title="Every refuted claim: how far off the print is at its counterexample.",
    caption="Each refuted claim says that left <= right; at the exact instance that refutes it, "
    "right is this share of left: the further a bar reaches, the more the print is off. The print "
    "is right in an upper bound, left in a lower one. Arrows: further still, or a right side of 0 "
    "or less.",
    compute=compute,
    draw=draw,
    subject=Subject(),
    takes=(),
    also=verdicts,
)
