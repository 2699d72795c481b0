"""Heat maps over two whole numbers: cells of a table, their edges, logarithmic shades."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ...lpc.arrays import Floats
from ..looks import FAINT, PAPER
from ..parts import thin
from ..table import Table

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_EXTEND = {(0, 0): "neither", (1, 0): "min", (0, 1): "max", (1, 1): "both"}
_DEEPEST = 12  # decades that shades tell apart


def edges(rows: Table, x: str, y: str) -> tuple[Floats, Floats]:
    """Return the edges of the cells in both directions."""
    both = (rows.numbers(name) for name in (x, y))
    one, two = (np.arange(v.min() - 0.5, v.max() + 1) for v in both)
    return one, two


def cells(rows: Table, x: str, y: str, value: str) -> Floats:
    """Return the values as an array, shape (y, x); NaN for what no row names, and for gaps."""
    place = [(v - v.min()).astype(int) for v in (rows.numbers(x), rows.numbers(y))]
    found = np.full((place[1].max() + 1, place[0].max() + 1), np.nan)
    found[place[1], place[0]] = rows.numbers(value)
    return found


def limits(values: Floats) -> tuple[float, float]:
    """Return the range of logarithmic shades: of the positive values, at most 12 decades."""
    positive = values[np.isfinite(values) & (values > 0)]
    high = float(positive.max())
    low = max(float(positive.min()), high / 10.0**_DEEPEST)
    return (low, high) if low < high / 1.001 else (low / 2, high * 2)


def shade(
    figure: Figure,
    panel: Axes,
    rows: Table,
    names: tuple[str, str, str],
    label: str,
    span: tuple[float, float] | None = None,
    bar: bool = True,
) -> None:
    """Draw a heat map of positive values; zeros are darkest, gaps are hatched.

    Parameters
    ----------
    names : tuple of three str
        The columns for both directions and the value.
    label : str
        Of the colour bar.
    span : pair of float, optional
        The range of the shades; that of the values if omitted.
    bar : bool
        Whether there is a colour bar.
    """
    from matplotlib.colors import LogNorm
    from matplotlib.patches import Rectangle
    from matplotlib.ticker import LogLocator, NullLocator

    found = cells(rows, *names)
    low, high = span or limits(found)
    x, y = edges(rows, *names[:2])
    background = Rectangle(
        (0, 0), 1, 1, transform=panel.transAxes, facecolor=PAPER, edgecolor=FAINT, hatch="////"
    )
    background.set(zorder=-1, linewidth=0)
    panel.add_patch(background)
    image = panel.pcolormesh(
        x, y, np.ma.masked_invalid(found), norm=LogNorm(low, high, clip=True), rasterized=True
    )
    panel.spines[["left", "bottom"]].set_linewidth(thin())
    if bar:
        real = found[np.isfinite(found)]
        beyond = bool((real < low).any()), bool((real > high).any())
        drawn = figure.colorbar(image, ax=panel, label=label, extend=_EXTEND[beyond])
        drawn.ax.yaxis.set_major_locator(LogLocator(numticks=7))
        drawn.ax.yaxis.set_minor_locator(NullLocator())
        drawn.outline.set_linewidth(thin())


def whole_ticks(panel: Axes, x: Floats, y: Floats | None = None) -> None:
    """Put ticks at whole numbers only, at most seven in each direction that is given."""
    for axis, values in ((panel.xaxis, x), (panel.yaxis, y)):
        if values is None:
            continue
        first, last = int(values.min()), int(values.max())
        step = next(s for s in (1, 2, 5, 10, 20, 50, 100, last) if (last - first) // s < 7)
        axis.set_ticks([t for t in range(first, last + 1) if t % step == 0 or last == first])
