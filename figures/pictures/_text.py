"""Texts that find their own place: headings that wrap, names that stand where there is room."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from ...lpc.arrays import Floats
from ..parts import plain

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

_INDEXED = re.compile(r"([A-Za-z])([0-9]{0,4})")
CROSSED = 3  # lines that a text may cover
# Sides on which a text may stand, the most readable first.
_SIDES = ((1, -1), (1, 1), (-1, -1), (-1, 1), (0, -1), (0, 1), (1, 0), (-1, 0))


class Wish(NamedTuple):
    """A text and the point (data coordinates) that it should stand next to."""

    x: float
    y: float
    text: str


def shown(name: str, longest: int = 12) -> str:
    """Return the name of an agent for print: ``u1`` as mathematics, long names cut."""
    match = _INDEXED.fullmatch(name)
    if match:
        return f"${match[1]}_{{{match[2]}}}$" if match[2] else f"${match[1]}$"
    return plain(name, longest)


def heading(figure: Figure, parts: Sequence[str]) -> None:
    """Write the parts above a figure, in as many lines as they need, broken after commas."""
    canvas: Any = figure.canvas
    title = figure.suptitle("")
    lines = [""]
    for text in ", ".join(parts).split(", "):
        longer = f"{lines[-1]}, {text}" if lines[-1] else text
        title.set_text(longer)
        fits = title.get_window_extent(canvas.get_renderer()).width < 0.97 * figure.bbox.width
        lines[-1:] = [longer] if fits or not lines[-1] else [lines[-1] + ",", text]
    title.set_text("\n".join(lines))


def log_ticks(axis: Axis, low: float, high: float) -> None:
    """Mark powers of ten, and 2 and 5 times them, or 3 times, where these are few."""
    from matplotlib.ticker import FixedLocator, LogFormatterSciNotation, NullFormatter

    decades = range(int(np.floor(np.log10(low))), int(np.ceil(np.log10(high))) + 1)
    alone = sum(low <= 10.0**e <= high for e in decades) < 2
    long = np.log10(high / low)
    steps = (1, 2, 5) if long < (1.0 if alone else 1.5) else (1, 3) if alone else (1,)
    apart = max(1, len(decades) // 6)
    ticks = [m * 10.0**e for e in decades if e % apart == 0 for m in steps]
    axis.set_major_locator(FixedLocator([tick for tick in ticks if low <= tick <= high]))
    every = (np.inf, np.inf)  # decades up to which 2 and 5 have labels
    axis.set_major_formatter(LogFormatterSciNotation(minor_thresholds=every))
    axis.set_minor_formatter(NullFormatter())


def log_axis(axes: Axes) -> None:
    """Make the vertical axis logarithmic: labels at powers of ten, more where there is one only.

    Called when everything is drawn.
    """
    from matplotlib.ticker import NullFormatter

    axes.set_yscale("log")
    low, high = axes.get_ylim()
    if np.floor(np.log10(high)) - np.ceil(np.log10(low)) < 1:
        log_ticks(axes.yaxis, low, high)
    axes.yaxis.set_minor_formatter(NullFormatter())


def label(
    axes: Axes,
    wishes: Sequence[Wish],
    marks: Floats,
    lines: Floats,
    radius: float,
    **looks: Any,
) -> int:
    """Write texts next to their points where there is room; return how many are written.

    Called last, when everything else is in its place. A text never covers a mark or another
    text; of the sides left it takes the one where it covers the fewest lines.

    Parameters
    ----------
    axes : Axes
    wishes : sequence of Wish
        The most wanted first.
    marks : ndarray, shape (m, 2)
        Middles of all marks, data coordinates.
    lines : ndarray, shape (s, 2, 2)
        Both ends of all lines.
    radius : float
        Of a mark, in points.
    **looks
        Of the texts.
    """
    figure: Any = axes.get_figure(root=True)
    for _ in range(2):  # constrained layout has then settled, and shall stay
        figure.draw_without_rendering()
    figure.set_layout_engine("none")
    renderer, point = figure.canvas.get_renderer(), figure.dpi / 72
    pixels = axes.transData.transform
    middle = pixels(marks)
    strokes = pixels(lines.reshape(-1, 2)).reshape(-1, 2, 2)
    taken: list[Any] = [t.get_window_extent(renderer).extents for t in axes.texts]
    frame = axes.bbox.padded(6 * point).extents
    written = 0
    for x, y, text in wishes:
        one = axes.text(x, y, text, in_layout=False, **looks)
        box = one.get_window_extent(renderer)
        here = pixels((x, y))
        found = []
        for rank, (right, up) in enumerate(_SIDES):
            reach = (radius + 1.5) * point * (0.8 if right and up else 1.0)
            low = (
                here[0] + (right * reach if right else 0) - (0, 0.5, 1)[1 - right] * box.width,
                here[1] + (up * reach if up else 0) - (0, 0.5, 1)[1 - up] * box.height,
            )
            extent = np.array([*low, low[0] + box.width, low[1] + box.height])
            if _free(extent, middle, radius * point, taken, frame):
                crossed = _crossed(extent, strokes)
                if crossed <= CROSSED:
                    found.append((crossed, rank, extent))
        if not found:
            one.remove()
            continue
        extent = min(found, key=lambda f: f[:2])[2]
        old = np.array([box.x0, box.y0])
        at = axes.transData.inverted().transform(pixels((x, y)) + extent[:2] - old)
        one.set_position((float(at[0]), float(at[1])))
        taken.append(extent)
        written += 1
    return written


def _free(box: Floats, marks: Floats, radius: float, taken: list[Any], frame: Any) -> bool:
    """Return whether a box covers no mark and no other text, and stays in its frame."""
    inside = frame[0] <= box[0] and frame[1] <= box[1] and box[2] <= frame[2] and box[3] <= frame[3]
    nearest = np.clip(marks, box[:2], box[2:])
    return bool(
        inside
        and (np.linalg.norm(nearest - marks, axis=1) >= radius).all()
        and all(box[2] <= b[0] or b[2] <= box[0] or box[3] <= b[1] or b[3] <= box[1] for b in taken)
    )


def _crossed(box: Floats, strokes: Floats) -> int:
    """Return how many lines pass through a box, by points along them."""
    if not len(strokes):
        return 0
    share = np.linspace(0, 1, 41)[:, None, None]
    along = strokes[:, 0] * (1 - share) + strokes[:, 1] * share
    within = ((along > box[:2]) & (along < box[2:])).all(axis=2)
    return int(within.any(axis=0).sum())
