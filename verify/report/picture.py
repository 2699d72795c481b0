"""The claims and their uses as one SVG, coloured by verdict."""

from __future__ import annotations

from html import escape

from ..claim import Claim
from ..results import Report
from ..run import uses
from .layout import layout
from .words import SIGNS, word_of

WIDE, HIGH, GAP, ROW, SIGHT = 204, 24, 42, 33, 29
_LETTERS = 26  # of a key fit into its box


def picture(report: Report, anchors: dict[str, str]) -> str:
    """Return the SVG; every claim links to its card.

    Parameters
    ----------
    report : Report
    anchors : dict
        Key -> name of the card on the page.
    """
    claims = {claim.key: claim for claim in report.claims}
    graph = uses(report.claims).subgraph(claims)
    found = layout(graph)
    across = max(found.columns, 1)
    width = across * (WIDE + GAP) - GAP + 4
    below = SIGHT + (found.rows + 1.6) * ROW if found.places else 0
    parts = [_edge(report, used, user, path) for used, user, path in found.edges]
    for key, (column, row) in found.places.items():
        x, y = 2 + column * (WIDE + GAP), SIGHT + row * ROW
        parts.append(_node(report, claims[key], anchors[key], x, y))
    if found.places:
        parts.append(_caption(2, 14, "what others build on →"))
        parts.append(_caption(width - 2, 14, "→ what builds on others", "end"))
    if found.alone:
        step = WIDE + 12
        fit = min(max(int((width + 12) // step), 3), 8)
        width = max(width, min(fit, len(found.alone)) * step - 8)
        parts.append(_caption(2, below + 14, "Claims that neither use another nor are used"))
        for i, key in enumerate(found.alone):
            x, y = 2 + (i % fit) * step, below + SIGHT + (i // fit) * ROW
            parts.append(_node(report, claims[key], anchors[key], x, y))
        below += SIGHT + ((len(found.alone) - 1) // fit + 1) * ROW
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {below:.0f}" '
        f'style="width:{width:.0f}px;min-width:{0.72 * width:.0f}px" role="img" '
        f'aria-label="Which proof uses which claim">{"".join(parts)}</svg>'
    )


def _caption(x: float, y: float, text: str, anchor: str = "start") -> str:
    return f'<text class="caption" x="{x:.0f}" y="{y:.0f}" text-anchor="{anchor}">{text}</text>'


def _edge(report: Report, used: str, user: str, path: tuple[tuple[int, float], ...]) -> str:
    """Return a smooth curve through the gaps; straight where it passes a column."""
    x, y = 2 + path[0][0] * (WIDE + GAP) + WIDE, SIGHT + path[0][1] * ROW + HIGH / 2
    drawn = [f"M{x:.1f} {y:.1f}"]
    for column, row in path[1:]:
        left, high = 2 + column * (WIDE + GAP), SIGHT + row * ROW + HIGH / 2
        bend = (left - x) / 2
        drawn.append(f"C{x + bend:.1f} {y:.1f} {left - bend:.1f} {high:.1f} {left} {high:.1f}")
        x, y = left + WIDE, high
        if (column, row) != path[-1]:
            drawn.append(f"H{x}")
    broken = " broken" if word_of(report, used) == "refuted" else ""
    return (
        f'<path class="edge{broken}" d="{"".join(drawn)}"><title>{escape(user)} uses '
        f"{escape(used)}</title></path>"
    )


def _node(report: Report, claim: Claim, anchor: str, x: float, y: float) -> str:
    word = word_of(report, claim.key)
    rests = word != "undecided" and report[claim.key].rests_on
    key = claim.key
    if len(key) > _LETTERS:
        key = f"{key[: _LETTERS - 12]}…{key[-11:]}"
    hint = f"{claim.key}: {claim.title}; {word}"
    if rests:
        hint += f"; its proof rests on the refuted {', '.join(rests)}"
    ring = f'<rect class="ring" x="-3" y="-3" width="{WIDE + 6}" height="{HIGH + 6}" rx="8"/>'
    return (
        f'<a href="#{anchor}" class="node {word}" transform="translate({x:.1f} {y:.1f})">'
        f"<title>{escape(hint)}</title>{ring if rests else ''}"
        f'<rect width="{WIDE}" height="{HIGH}" rx="{0 if word == "refuted" else 5}"/>'
        f'<text x="9" y="16.5">{SIGNS[word]}</text><text class="key" x="25" y="16">{escape(key)}'
        "</text></a>"
    )
