"""One look for one thing, everywhere: colour, line and mark of every tier and bound.

Colours are those of Okabe and Ito, which people with any colour vision tell apart; lines and marks
differ, too, so that nothing is lost in grey.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any


@dataclass(frozen=True)
class Look:
    """Colour, line and mark.

    Parameters
    ----------
    label : str
        What the legend says.
    colour : str
    line : str or tuple
        Matplotlib's line style.
    mark : str
        Matplotlib's marker.
    """

    label: str
    colour: str
    line: Any
    mark: str

    def plot(self, *, marked: bool = True, **changes: Any) -> dict[str, Any]:
        """Return keywords for ``Axes.plot``.

        Parameters
        ----------
        marked : bool
            Whether points are marked.
        **changes
            Keywords that replace, or are added.
        """
        return {
            "label": self.label,
            "color": self.colour,
            "linestyle": self.line,
            "marker": self.mark if marked else "",
            "markerfacecolor": "white" if self.mark in "os^vD" else self.colour,
            **changes,
        }


STATED = Look("stated", "#D55E00", (0, (4, 1.6)), "x")
REPAIRED = Look("repaired", "#E69F00", (0, (6, 1.5, 1.2, 1.5)), "s")
SHARP = Look("sharp", "#0072B2", "-", "o")
EXACT = Look("exact worst case", "#000000", "-", "D")
SEARCHED = Look("searched", "#CC79A7", (0, (1, 1)), "*")
MEASURED = Look("measured", "#56B4E9", (0, (3, 1, 1, 1, 1, 1)), "v")
LOWER = Look("lower bound", "#009E73", (0, (2, 1.2)), "^")

OPTIMUM = Look("clairvoyant optimum", "#000000", "-", "")
NEARSIGHTED = Look("LPC, short sight", "#E69F00", (0, (4, 1.6)), "s")
PLANNED = Look("LPC, planned sight", "#0072B2", (0, (6, 1.5, 1.2, 1.5)), "o")

LOOKS = {
    "stated": STATED,
    "repaired": REPAIRED,
    "sharp": SHARP,
    "exact": EXACT,
    "searched": SEARCHED,
    "measured": MEASURED,
    "lower": LOWER,
}
TIERS = ("stated", "repaired", "sharp")
VERDICTS = {"proved": "#0072B2", "supported": "#56B4E9", "refuted": "#D55E00"}
INK, FAINT, PAPER = "#222222", "#9A9A9A", "#FFFFFF"
OWN, TOP, LATERAL, BOTTOM = "#E69F00", "#0072B2", "#56B4E9", "#009E73"
"""Of an agent's local problem: its own action, and the three parts of the boundary."""
TEMPORAL, SPATIAL = "#CC79A7", "#0072B2"
"""Of the costs that couple an agent's steps, and neighbours."""
