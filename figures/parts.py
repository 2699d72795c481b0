"""Parts that pictures share: a legend that fits, the line that says what a picture is of."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from .subject import Subject

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.legend import Legend

_SYMBOLS = {"mu": r"\mu", "l_f": r"\ell_f", "l_T": r"\ell_T", "l_S": r"\ell_S", "horizon": "H"}


def legend_below(figure: Figure, axes: Axes | list[Axes], **keywords: Any) -> Legend:
    """Put one legend for all axes below them, in as many columns as fit."""
    several = axes if isinstance(axes, list) else [axes]
    found: dict[str, Any] = {}
    for one in several:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            found.setdefault(label, handle)
    canvas: Any = figure.canvas
    for columns in range(min(len(found), 6), 0, -1):
        legend = figure.legend(
            list(found.values()),
            list(found),
            loc="outside lower center",
            ncols=columns,
            **keywords,
        )
        if columns == 1 or legend.get_window_extent(canvas.get_renderer()).width < (
            0.98 * figure.bbox.width
        ):
            break
        legend.remove()
    return legend


def constants(subject: Subject, *names: str) -> str:
    """Return ``l_T = 1, l_S = 0.5, ...`` for some fields, in mathematics."""
    return ", ".join(f"${_SYMBOLS.get(name, name)} = {getattr(subject, name):g}$" for name in names)


def network_name(subject: Subject) -> str:
    """Return where the network comes from, short: of a file, its name."""
    source = subject.network.source
    return source.replace("\\", "/").rsplit("/", 1)[-1]
