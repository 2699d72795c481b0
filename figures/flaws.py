"""What a reader would stumble over: texts that overlap, are cut off, or are too small."""

from __future__ import annotations

from itertools import combinations
from typing import Any

import numpy as np
from matplotlib.backends.backend_agg import RendererAgg
from matplotlib.figure import Figure
from matplotlib.legend import Legend
from matplotlib.text import Text
from matplotlib.transforms import Bbox

SMALLEST = 5.0  # points, at the final size
SLACK = 1.0  # points by which boxes may touch: they are larger than their ink


def _drawn(figure: Figure) -> tuple[Any, list[Text]]:
    """Return a renderer, and the texts that were drawn with it."""
    texts: list[Text] = []
    maker: Any = RendererAgg  # without types
    renderer = maker(*figure.bbox.size, figure.dpi)
    plain = renderer.draw_text

    def draw_text(*args: Any, mtext: Text | None = None, **keywords: Any) -> None:
        if mtext is not None and mtext not in texts and _seen(mtext):
            texts.append(mtext)
        plain(*args, mtext=mtext, **keywords)

    renderer.draw_text = draw_text
    figure.draw(renderer)
    texts.clear()
    figure.draw(renderer)  # constrained layout has settled
    return renderer, texts


def flaws(figure: Figure) -> tuple[str, ...]:
    """Return one line for each flaw, none for a good picture.

    Looked at are all texts that are really drawn, in their final place: two that overlap, one
    that leaves the figure, one below `SMALLEST` points, and a legend over the text of others.
    """
    renderer, texts = _drawn(figure)
    slack = SLACK * figure.dpi / 72
    boxes = [(text, _box(text, renderer, slack)) for text in texts if text.get_text()]
    found = [f"smaller than {SMALLEST} points: {_name(t)}" for t, _ in boxes if _small(t)]
    whole = figure.bbox
    for text, box in boxes:
        if box.x0 < whole.x0 or box.y0 < whole.y0 or box.x1 > whole.x1 or box.y1 > whole.y1:
            found.append(f"cut off: {_name(text)}")
    for (one, a), (two, b) in combinations(boxes, 2):
        if a.overlaps(b):
            found.append(f"overlap: {_name(one)} and {_name(two)}")
    for legend in figure.findobj(Legend):
        inside = set(legend.findobj(Text))
        frame = legend.get_window_extent(renderer)
        found += [
            f"under a legend: {_name(text)}"
            for text, box in boxes
            if text not in inside and box.overlaps(frame)
        ]
    return tuple(found)


def _seen(text: Text) -> bool:
    """Whether a text with this clipping shows at all."""
    inside = text.get_clip_box() if text.get_clip_on() else None
    return inside is None or bool(inside.overlaps(text.get_window_extent()))


def _box(text: Text, renderer: Any, slack: float) -> Bbox:
    box = text.get_window_extent(renderer)
    grown = np.array([[box.x0 + slack, box.y0 + slack], [box.x1 - slack, box.y1 - slack]])
    return Bbox(np.where(grown[0] < grown[1], grown, box.get_points()))


def _small(text: Text) -> bool:
    return float(text.get_fontsize()) < SMALLEST


def _name(text: Text) -> str:
    return repr(text.get_text().replace("\n", " "))
