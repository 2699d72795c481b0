"""What pictures over the coupling strength share: its grid, its mark, the scale of a rate."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ...lpc.arrays import Floats
from ..looks import FAINT, INK
from ..parts import thin

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_NEAR_ONE = (0.9, 0.99, 0.999, 0.9999, 0.99999, 0.999999)


def grid(low: float, high: float, per_decade: int, *given: float) -> Floats:
    """Return strengths at equal steps of their logarithm, as far as those given (0 left out)."""
    decades = [np.log10(value) for value in given if value > 0]
    first = int(np.floor(min([np.log10(low), *decades])))
    last = int(np.ceil(max([np.log10(high), *decades])))
    found: Floats = np.logspace(first, last, (last - first) * per_decade + 1)
    return found


def mark_here(panel: Axes, coupling: float) -> None:
    """Mark the strength that the subject has, if it has one."""
    if coupling > 0:
        panel.axvline(coupling, color=FAINT, linestyle=":", linewidth=2 * thin(), zorder=0)


def logarithmic(panel: Axes, values: Floats) -> None:
    """Make the horizontal axis logarithmic, with a tick a decade, or every second or third."""
    from matplotlib.ticker import LogLocator, NullLocator

    panel.set_xscale("log")
    panel.set_xlim(values[0], values[-1])
    panel.xaxis.set_major_locator(LogLocator(numticks=8))
    panel.xaxis.set_minor_locator(NullLocator())


def rate_axis(panel: Axes, rates: Floats) -> None:
    """Scale an axis for rates between 0 and 1 so that both ends are seen (logit)."""
    low, high = float(np.nanmin(rates)), float(np.nanmax(rates))
    panel.set_yscale("logit")
    panel.set_ylim(low / 3, 1 - (1 - high) / 2)
    deepest = int(np.floor(np.log10(low / 3)))
    step = 2 if deepest < -4 else 1
    step = max(step, -(deepest // 4))
    small = [10.0**-e for e in range(step, -deepest, step)]
    ticks = [*small, 0.5, *(t for t in _NEAR_ONE if t < 1 - (1 - high) / 2)]
    ticks = [t for t in ticks if t >= low / 3]
    panel.set_yticks(ticks)
    panel.set_yticklabels([_rate(t) for t in ticks])
    panel.yaxis.set_minor_locator(_none())


def count_axis(panel: Axes, values: Floats, *, vertical: bool = True) -> None:
    """Scale an axis for counts or factors: logarithmic, ticks 1, 2, 5, 10, ... or 1, 10, ..."""
    low, high = float(np.nanmin(values)), float(np.nanmax(values))
    axis: Any = panel.yaxis if vertical else panel.xaxis
    (panel.set_yscale if vertical else panel.set_xscale)("log")
    room = (high / low) ** 0.08 if high > low else 1.5
    low, high = low / room, high * room
    (panel.set_ylim if vertical else panel.set_xlim)(low, high)
    for steps in ((1, 2, 4) if high < 70 else (1, 2, 5), (1, 3), (1,)):
        ticks = _ticks(low, high, steps)
        if len(ticks) <= 7:
            break
    axis.set_ticks(ticks)
    axis.set_ticklabels([f"{t:.9g}" for t in ticks])
    axis.set_minor_locator(_none())


def _ticks(low: float, high: float, steps: tuple[int, ...]) -> list[float]:
    if steps == (1, 2, 4):  # powers of two
        every = (2.0**e for e in range(-20, 30))
    else:
        every = (s * 10.0**e for e in range(-9, 10) for s in steps)
    return [t for t in every if low <= t <= high]


def _rate(value: float) -> str:
    return f"{value:g}" if value >= 0.1 else f"$10^{{{round(np.log10(value))}}}$"


def _none() -> Any:
    from matplotlib.ticker import NullLocator

    return NullLocator()


def say(panel: Axes, text: str) -> None:
    """Write in the middle of a panel why it shows nothing."""
    panel.text(0.5, 0.5, text, ha="center", va="center", color=INK, transform=panel.transAxes)
