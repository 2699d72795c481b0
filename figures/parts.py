"""Parts that pictures share: a legend that fits, the line that says what a picture is of."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING, Any

from .size import FONTS
from .subject import Subject

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.legend import Legend

_SYMBOLS = {"mu": r"\mu", "l_f": r"\ell_f", "l_T": r"\ell_T", "l_S": r"\ell_S", "horizon": "H"}


def legend_below(figure: Figure, axes: Axes | list[Axes], **keywords: Any) -> Legend | None:
    """Put one legend for all axes below them, in as many columns as fit; None without entries."""
    several = axes if isinstance(axes, list) else [axes]
    found: dict[str, Any] = {}
    for one in several:
        for handle, label in zip(*one.get_legend_handles_labels(), strict=True):
            found.setdefault(label, handle)
    canvas: Any = figure.canvas
    legend = None
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


def style(name: str) -> float:
    """Return a number of the style in use, such as ``"lines.markersize"``, in points."""
    from matplotlib import rcParams

    settings: Any = rcParams
    return float(settings[name])


def thin() -> float:
    """Return the width of the thinnest lines of the style in use, in points."""
    return style("axes.linewidth")


def constants(subject: Subject, *names: str) -> str:
    """Return ``l_T = 1, l_S = 0.5, ...`` for some fields, in mathematics."""
    values = {_SYMBOLS.get(name, name): number(getattr(subject, name)) for name in names}
    return ", ".join(f"${symbol} = {value}$" for symbol, value in values.items())


def number(value: float, spec: str = "g") -> str:
    """Return a number as it stands in mathematics: ``1.5e-08`` as a multiple of a power of ten."""
    mantissa, _, exponent = f"{value:{spec}}".partition("e")
    if not exponent:
        return mantissa
    power = f"10^{{{int(exponent)}}}"
    return power if mantissa == "1" else f"{mantissa} \\times {power}"


def plain(text: str, longest: int, end: int = 0) -> str:
    """Return any text for print: no mathematics, in one line, not too long.

    Letters that none of the fonts has become squares.

    Parameters
    ----------
    text : str
    longest : int
        Letters kept, with one for what is left out.
    end : int
        How many of these are the last ones.
    """
    if len(text) > longest:
        text = text[: longest - 1 - end] + "\N{HORIZONTAL ELLIPSIS}" + text[len(text) - end :]
    known = _letters()
    shown = (c if ord(c) in known else "\N{WHITE SQUARE}" for c in text)
    seen = (s if c.isprintable() else " " for s, c in zip(shown, text, strict=True))
    return "".join(seen).replace("$", r"\$")


@cache
def _letters() -> frozenset[int]:
    """Return the letters that one of the fonts has; all of these come with Matplotlib."""
    from matplotlib import font_manager

    files = (font_manager.findfont(name, fallback_to_default=False) for name in FONTS)
    return frozenset(code for file in files for code in font_manager.get_font(file).get_charmap())


def network_name(subject: Subject) -> str:
    """Return where the network comes from, short and for print: of a file, its name."""
    return plain(last_part(subject.network.source), 40, 12)


def last_part(source: str) -> str:
    """Return the name of a file without its folder; a family as it stands."""
    return source.replace("\\", "/").rsplit("/", 1)[-1]
