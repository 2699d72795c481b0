"""The theorems and which proof uses which, as one SVG: a box a theorem, a cell a claim."""

from __future__ import annotations

from html import escape

from ..claim import Claim
from ..results import Report
from .layout import boxes_of, layout, uses_between
from .words import SIGNS, word_of

WIDE, HIGH, GAP, ROW, TOP = 208, 42, 36, 54, 29
_LETTERS = 26  # of a label fit into its box
_CELL = 15  # largest width of a cell; narrower where a box has many


def picture(report: Report, anchors: dict[str, str]) -> str:
    """Return the SVG; every cell links to the card of its claim.

    Parameters
    ----------
    report : Report
    anchors : dict
        Key -> name of the card on the page.
    """
    boxes = boxes_of(report.claims)
    found = layout(uses_between(boxes))
    width = max(found.columns, 1) * (WIDE + GAP) - GAP + 8
    below = TOP + (found.rows + 1.4) * ROW if found.places else 0
    parts = [_edge(report, boxes, *edge) for edge in found.edges]
    for name, (column, row) in found.places.items():
        x, y = 4 + column * (WIDE + GAP), TOP + row * ROW
        parts.append(_box(report, name, boxes[name], anchors, x, y))
    if found.places:
        parts.append(_caption(4, 14, "what others build on →"))
        parts.append(_caption(width - 4, 14, "→ what builds on others", "end"))
    if found.alone:
        step = WIDE + 14
        fit = max(int((width + 12) // step), 3)
        width = max(width, min(fit, len(found.alone)) * step - 6)
        parts.append(_caption(4, below + 14, "What neither uses another nor is used"))
        for i, name in enumerate(found.alone):
            x, y = 4 + (i % fit) * step, below + TOP + (i // fit) * ROW
            parts.append(_box(report, name, boxes[name], anchors, x, y))
        below += TOP + ((len(found.alone) - 1) // fit + 1) * ROW
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {below:.0f}" '
        f'style="width:{width:.0f}px;min-width:{0.6 * width:.0f}px" role="img" '
        f'aria-label="Which proof uses which claim">{"".join(parts)}</svg>'
    )


def _caption(x: float, y: float, text: str, anchor: str = "start") -> str:
    return f'<text class="caption" x="{x:.0f}" y="{y:.0f}" text-anchor="{anchor}">{text}</text>'


def _edge(
    report: Report,
    boxes: dict[str, list[Claim]],
    used: str,
    user: str,
    path: tuple[tuple[int, float], ...],
) -> str:
    """Return a smooth curve through the gaps; straight where it passes a column."""
    x, y = 4 + path[0][0] * (WIDE + GAP) + WIDE, TOP + path[0][1] * ROW + HIGH / 2
    drawn = [f"M{x:.1f} {y:.1f}"]
    for column, row in path[1:]:
        left, high = 4 + column * (WIDE + GAP), TOP + row * ROW + HIGH / 2
        bend = max(left - x, GAP) / 2
        drawn.append(f"C{x + bend:.1f} {y:.1f} {left - bend:.1f} {high:.1f} {left} {high:.1f}")
        x, y = left + WIDE, high
        if (column, row) != path[-1]:
            drawn.append(f"H{x}")
    below = {claim.key for claim in boxes[used]}
    pairs = [(c.key, key) for c in boxes[user] for key in c.uses if key in below]
    broken = " broken" if any(word_of(report, key) == "refuted" for _, key in pairs) else ""
    hint = escape("\n".join(f"{a} uses {b}" for a, b in pairs))
    return f'<path class="edge{broken}" d="{"".join(drawn)}"><title>{hint}</title></path>'


def _box(
    report: Report, name: str, claims: list[Claim], anchors: dict[str, str], x: float, y: float
) -> str:
    """Return the box of a theorem, in the colour of its main claim, with a cell a claim."""
    main = next((claim for claim in claims if claim.key == name), None)
    word = word_of(report, name) if main else "several"
    short = name if len(name) <= _LETTERS else f"{name[: _LETTERS - 11]}…{name[-10:]}"
    step = min(_CELL + 3, (WIDE - 10) / len(claims))
    cells = "".join(
        _cell(report, claim, anchors[claim.key], 7 + i * step, step - 3)
        for i, claim in enumerate(claims)
    )
    title = f"<title>{escape(f'{name}: {main.title}' if main else name)}</title>"
    return (
        f'<g transform="translate({x:.1f} {y:.1f})">'
        f'<rect class="frame" width="{WIDE}" height="{HIGH}" rx="5"/>'
        f'<a href="#{anchors[claims[0].key]}" class="box {word}">{title}'
        f'<path d="M0 21V5a5 5 0 0 1 5-5H{WIDE - 5}a5 5 0 0 1 5 5V21Z"/>'
        f'<text x="8" y="14.5">{escape(short)}</text></a>{cells}</g>'
    )


def _cell(report: Report, claim: Claim, anchor: str, x: float, width: float) -> str:
    word = word_of(report, claim.key)
    rests = word != "undecided" and report[claim.key].rests_on
    hint = f"{claim.key}: {claim.title}; {word}"
    if rests:
        hint += f"; its proof rests on the refuted {', '.join(rests)}"
    ring = f'<path class="ring" d="M{x:.1f} 40h{width:.1f}"/>' if rests else ""
    sign = (
        f'<text x="{x + width / 2:.1f}" y="34.5" text-anchor="middle">{SIGNS[word]}</text>'
        if width > 8
        else ""
    )
    return (
        f'<a href="#{anchor}" class="node {word}"><title>{escape(hint)}</title>'
        f'<rect x="{x:.1f}" y="25" width="{width:.1f}" height="12.5"'
        f' rx="{0 if word == "refuted" else 3}"/>{sign}{ring}</a>'
    )
