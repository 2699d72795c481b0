"""Where a picture will stand: in a column or across the page of a paper, or on a slide."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Span = Literal["column", "page"]
FONTS = ("STIXGeneral", "DejaVu Sans")
"""Of paper and of slides; each helps out where the other lacks a letter."""


@dataclass(frozen=True)
class Size:
    """Widths in inches and everything that Matplotlib is to be told.

    Parameters
    ----------
    name : str
    column, page : float
        Width of a picture in one column and across the page.
    height : float or None
        Fixed height; a share of the width where None.
    dpi : int
        Of the PNG.
    settings : mapping
        Matplotlib's rcParams.
    """

    name: str
    column: float
    page: float
    height: float | None
    dpi: int
    settings: Mapping[str, Any] = field(hash=False)

    def figure(self, span: Span, aspect: float) -> Figure:
        """Return an empty figure.

        Parameters
        ----------
        span : {"column", "page"}
        aspect : float
            Height over width, where the height is not fixed.
        """
        from matplotlib.backends.backend_agg import FigureCanvasAgg
        from matplotlib.figure import Figure

        width = self.column if span == "column" else self.page
        figure = Figure((width, self.height or aspect * width), dpi=self.dpi, layout="constrained")
        FigureCanvasAgg(figure)  # a figure without a window, and without global state
        return figure


def _settings(base: float, thin: float, family: str, mathematics: str) -> dict[str, Any]:
    """Return rcParams for a font of `base` points and lines of `thin` points."""
    sizes = ("axes.labelsize", "axes.titlesize", "legend.title_fontsize")
    small = ("xtick.labelsize", "ytick.labelsize", "legend.fontsize")
    ticks = {f"{axis}tick.{which}.width": thin for axis in "xy" for which in ("major", "minor")}
    return {
        "font.size": base,
        **dict.fromkeys(sizes, base),
        **dict.fromkeys(small, base - 1),
        "font.family": [family, *(name for name in FONTS if name != family)],
        "mathtext.fontset": mathematics,
        "axes.linewidth": thin,
        "axes.spines.top": False,
        "axes.spines.right": False,
        "axes.titlelocation": "left",
        "axes.titlepad": 0.6 * base,
        "axes.axisbelow": True,
        "axes.grid": False,
        "grid.color": "0.88",
        "grid.linewidth": thin,
        "lines.linewidth": 2.2 * thin,
        "lines.markersize": 0.5 * base,
        "lines.markeredgewidth": 1.4 * thin,
        "patch.linewidth": thin,
        "hatch.linewidth": thin,
        **ticks,
        "legend.frameon": False,
        "legend.handlelength": 2.4,
        "legend.borderaxespad": 0.2,
        "figure.constrained_layout.h_pad": 0.25 * base / 72,
        "figure.constrained_layout.w_pad": 0.25 * base / 72,
        "image.cmap": "cividis",
        "axes.formatter.use_mathtext": True,
        "axes.unicode_minus": True,
        "pdf.fonttype": 42,  # text stays text
        "svg.fonttype": "path",  # looks the same where the font is missing
        "svg.hashsalt": "nearsight",  # the same bytes every time
    }


PAPER = Size("paper", 3.25, 6.75, None, 300, _settings(8.0, 0.6, "STIXGeneral", "stix"))
SLIDES = Size("slides", 13.333, 13.333, 7.5, 144, _settings(18.0, 1.2, "DejaVu Sans", "dejavusans"))
SIZES = {size.name: size for size in (PAPER, SLIDES)}
"""``paper``: columns and pages of ICML (3.25 and 6.75 inches); ``slides``: 16:9."""
