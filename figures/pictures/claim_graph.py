"""Which proof uses which claim, a box a theorem and a cell a claim, with recorded verdicts."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from itertools import count
from math import ceil
from typing import TYPE_CHECKING, Any

import numpy as np

from ...verify import catalogue
from ...verify.recorded import recorded
from ...verify.report.layout import Layout, boxes_of, layout, uses_between
from ..looks import FAINT, INK, PAPER, VERDICTS
from ..parts import legend_below, thin
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._text import heading
from ._verdicts import verdicts

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

NONE = "not recorded"
BOX = 0.8, 0.87  # width and height of a box, as shares of a column and a row
CELLS = 0.3  # of the height of a box
LARGEST, LEAST = 8.0, 5.0  # points, of the labels
_BREAK = re.compile(r"(?<=[-:_ #])")


def compute(subject: Subject, progress: Progress) -> Table:
    """Return rows for boxes (column and row), for their claims, and for edges.

    An edge leads from a box to one whose proofs use a claim in it; it is ``broken`` if one of
    these claims is refuted. ``path`` lists the places it passes, as ``column:row``.
    """
    claims, verdicts = catalogue(), recorded()
    boxes = boxes_of(claims)
    found = layout(uses_between(boxes))
    alone = dict(zip(found.alone, _free(found), strict=False))
    rows: list[dict[str, Any]] = []
    for name, (column, row) in (found.places | alone).items():
        rows.append({"kind": "box", "box": name, "column": column, "row": row})
        for claim in boxes[name]:
            word = verdicts.get(claim.key, NONE)
            rows.append({"kind": "claim", "box": name, "key": claim.key, "verdict": word})
    for used, user, path in found.edges:
        below = {claim.key for claim in boxes[used]}
        keys = {key for claim in boxes[user] for key in claim.uses if key in below}
        broken = any(verdicts.get(key) == "refuted" for key in keys)
        text = " ".join(f"{column}:{row!r}" for column, row in path)
        rows.append({"kind": "edge", "box": used, "user": user, "broken": broken, "path": text})
    return Table.of(rows)


def _free(found: Layout) -> Iterator[tuple[int, float]]:
    """Return free places, in the lower right corner and then below."""
    taken = [*found.places.values(), *(place for *_, path in found.edges for place in path)]
    last = round(max((row for _, row in taken), default=-1.0))
    for column in reversed(range(found.columns)):
        lowest = max((row for at, row in taken if at == column), default=-1.0)
        yield from ((column, float(row)) for row in range(last, ceil(lowest + 1), -1))
    for below in count(last + 2):
        yield from ((column, float(below)) for column in range(max(found.columns, 1)))


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw the boxes; once everything around has its place, a unit of the axes is a point."""
    figure = size.figure("page", 1.06)
    axes = figure.subplots()
    axes.set_axis_off()
    _legend(axes, table)
    heading(figure, ["Which proof uses which claim: to the right, what builds on others"])
    for _ in range(2):
        figure.draw_without_rendering()
    figure.set_layout_engine("none")
    width, height = np.array([axes.bbox.width, axes.bbox.height]) * 72 / figure.dpi
    axes.set_xlim(-1, width - 1)  # half a line more than the boxes
    axes.set_ylim(height - 1, -1)
    boxes = table.where(kind="box")
    columns, rows = (boxes.numbers(name).max() + 1 for name in ("column", "row"))
    # the last column and row need no gap
    step = np.array([(width - 2) / (columns - 1 + BOX[0]), (height - 2) / (rows - 1 + BOX[1])])
    part = step * BOX
    for row in table.where(kind="edge").records():
        places = [tuple(map(float, place.split(":"))) for place in str(row["path"]).split()]
        _edge(axes, np.array(places) * step, part, bool(row["broken"]))
    texts = _fitted(axes, [str(name) for name in boxes.values("box")], part)
    for row in boxes.records():
        claims = table.where(kind="claim", box=row["box"]).records()
        corner = np.array([row["column"], row["row"]]) * step
        _box(axes, corner, part, claims, texts[str(row["box"])])
    return figure


def _legend(axes: Axes, table: Table) -> None:
    """Write what colours and lines mean, with the number of claims."""
    from matplotlib.patches import Rectangle

    verdicts = table.where(kind="claim").values("verdict")
    for word in (*VERDICTS, NONE):
        if word in verdicts:
            looks: dict[str, Any] = {"facecolor": VERDICTS.get(word, PAPER), "edgecolor": INK}
            if word == "refuted":
                looks |= {"hatch": "xxxx", "edgecolor": PAPER}
            text = f"{verdicts.count(word)} {word}"
            axes.add_patch(Rectangle((0, 0), 0, 0, label=text, **looks))
    axes.plot([], [], color=FAINT, label="used in a proof")
    axes.plot([], [], **_broken(), label="used in a proof, but refuted")
    figure: Any = axes.figure
    legend_below(figure, axes)


def _broken() -> dict[str, Any]:
    return {"color": VERDICTS["refuted"], "linestyle": (0, (3, 1.5))}


def _edge(axes: Axes, at: Any, part: Any, broken: bool) -> None:
    """Draw a smooth curve through the gaps; straight where it passes a column."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    middle, across = at + np.array([0, part[1] / 2]), np.array([part[0], 0])
    points = [middle[0] + across]
    codes = [Path.MOVETO]
    for i, place in enumerate(middle[1:], 1):
        start = points[-1]
        bend = np.array([(place[0] - start[0]) / 2, 0])
        points += [start + bend, place - bend, place]
        codes += [Path.CURVE4] * 3
        if i < len(middle) - 1:
            points.append(place + across)
            codes.append(Path.LINETO)
    looks: dict[str, Any] = _broken() if broken else {"color": FAINT}
    curve = Path(np.array(points), [int(code) for code in codes])
    axes.add_patch(PathPatch(curve, fill=False, linewidth=1.3 * thin(), zorder=1, **looks))


def _fitted(axes: Axes, names: list[str], part: Any) -> dict[str, tuple[str, float]]:
    """Return every name in at most two lines, and the size at which all of them fit."""
    figure: Any = axes.figure
    renderer = figure.canvas.get_renderer()
    probe = axes.text(0, 0, "", fontsize=10, in_layout=False, parse_math=False)

    def wide(text: str) -> float:
        probe.set_text(text)
        width: float = probe.get_window_extent(renderer).width
        return width * 7.2 / float(figure.dpi)  # in points, per point of the font

    room, high = part[0] - 3, (1 - CELLS) * part[1] / 2.3
    broken = {name: _two_lines(name, wide) for name in names}
    widest = max(width for _, width in broken.values())
    font = float(np.clip(min(room / widest, high), LEAST, LARGEST))
    short = {name for name in names if wide(name) * font <= room}
    probe.remove()
    return {name: (name if name in short else broken[name][0], font) for name in names}


def _two_lines(name: str, wide: Callable[[str], float]) -> tuple[str, float]:
    """Return a name broken where its two lines are shortest, and the width of the longer one."""
    pieces = _BREAK.split(name)
    found = [(wide(name) if len(pieces) == 1 else np.inf, name)]
    for i in range(1, len(pieces)):
        lines = "".join(pieces[:i]).rstrip(), "".join(pieces[i:])
        found.append((max(map(wide, lines)), "\n".join(lines)))
    width, text = min(found)
    return text, float(width)


def _box(
    axes: Axes, corner: Any, part: Any, claims: list[dict[str, Any]], text: tuple[str, float]
) -> None:
    """Draw a box with its label, and a cell a claim."""
    from matplotlib.patches import Rectangle

    line = thin()
    looks: dict[str, Any] = {"facecolor": PAPER, "edgecolor": "0.35", "linewidth": line}
    axes.add_patch(Rectangle(corner, *part, zorder=2, **looks))
    upper = part[1] * (1 - CELLS)
    axes.text(
        corner[0] + part[0] / 2, corner[1] + upper / 2 + 0.3, text[0], fontsize=text[1],
        ha="center", va="center", linespacing=0.95, color=INK, parse_math=False, zorder=3,
    )  # fmt: skip
    step = min(part[1] * CELLS, (part[0] - 3) / len(claims))
    high, wide = part[1] * CELLS - 2, 0.84 * step
    for i, claim in enumerate(claims):
        x, y = corner[0] + 2 + i * step, corner[1] + upper
        word = str(claim["verdict"])
        fill = VERDICTS.get(word)
        edge: Any = {
            "facecolor": fill or PAPER,
            "edgecolor": fill or FAINT,
            "linewidth": 0.7 * line,
        }
        axes.add_patch(Rectangle((x, y), wide, high, zorder=3, **edge))
        if word == "refuted":  # seen in grey, too
            for ends in ((y, y + high), (y + high, y)):
                axes.plot((x, x + wide), ends, color=PAPER, linewidth=line, zorder=4)


PICTURE = Picture(
    name="claim-graph",
    title="Which proof uses which claim, and the recorded verdict on each.",
    caption="A box is a theorem, lemma or section of the paper (or of this project), a cell one of "
    "its claims with the recorded verdict. Lines lead from what is used to what uses it, from "
    "left to right; dashed ones from a refuted claim: a proof that rests on it is incomplete.",
    compute=compute,
    draw=draw,
    subject=Subject(),
    takes=(),
    also=verdicts,
)
