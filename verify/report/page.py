"""The report as one HTML page that needs nothing from outside."""

from __future__ import annotations

from html import escape
from pathlib import Path
from string import Template

from ..evidence import WORDS
from ..results import Report
from .cards import card, chip, erratum, row
from .picture import picture
from .words import MEANINGS, headline, word_of

_TEMPLATE = Path(__file__).with_name("page.html")


def page(report: Report) -> str:
    """Return the page: counts, errata, graph, table, and a card a claim."""
    anchors = {claim.key: f"claim-{i}" for i, claim in enumerate(report.claims, 1)}
    refuted = [claim for claim in report.claims if word_of(report, claim.key) == "refuted"]
    errata = "".join(erratum(report, claim, anchors) for claim in refuted)
    return Template(_TEMPLATE.read_text(encoding="utf-8")).substitute(
        headline=escape(headline(report)),
        level=report.level,
        tiles=_tiles(report),
        notices=_notices(report),
        errata=errata or "<p>None: no claim is refuted.</p>",
        errata_count=len(refuted),
        graph=picture(report, anchors),
        legend="".join(f"<li>{chip(word)} {MEANINGS[word]}</li>" for word in WORDS),
        rows="".join(row(report, claim, anchors) for claim in report.claims),
        cards="".join(card(report, claim, anchors) for claim in report.claims),
    )


def _tiles(report: Report) -> str:
    """Return the counts, large, over a bar of their shares."""
    total = max(sum(report.counts.values()), 1)
    tiles = "".join(
        f'<div class="tile {word}"><b>{count}</b><span>{word}</span></div>'
        for word, count in report.counts.items()
    )
    rests = sum(bool(v.rests_on) and v.verdict != "refuted" for v in report.verdicts)
    tiles += f'<div class="tile rests"><b>{rests}</b><span>hold, but their printed proof rests on '
    tiles += "a refuted claim</span></div>"
    bar = "".join(
        f'<i class="{word}" style="width:{100 * count / total:.2f}%"></i>'
        for word, count in report.counts.items()
    )
    return f'<div class="tiles">{tiles}</div><div class="bar" aria-hidden="true">{bar}</div>'


def _notices(report: Report) -> str:
    """Return what has changed, what failed, and how the checks fared with false statements."""
    bad = [f"changed: {change}" for change in report.changes]
    bad += [f"no verdict on {key}: {text}" for key, text in report.errors.items()]
    bad += [f"{m.key}, check {m.check} ({m.engine}): {m.outcome}: {m.text}" for m in report.weak]
    listed = "".join(f"<li>{escape(text)}</li>" for text in bad)
    found = f'<ul class="notice">{listed}</ul>' if bad else ""
    if report.mutations is not None:
        good = sum(one.good for one in report.mutations)
        found += (
            f'<p class="mutants">The checks were also given {len(report.mutations)} statements '
            f"nudged past the truth, and rejected {good} of them.</p>"
        )
    return found
