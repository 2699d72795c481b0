"""One claim on the page: its card, its row, its erratum."""

from __future__ import annotations

import json
import re
from collections.abc import Collection, Mapping
from html import escape, unescape
from typing import Any

from ..claim import Claim
from ..evidence import Evidence
from ..results import Report
from .prose import coded, html_of, plain_html
from .words import SIGNS, effort, number, replay, sides, word_of

_LONG = 90  # letters of a detail that is folded away


def told(text: str, keys: Collection[str]) -> str:
    """Return a text as HTML, keys of claims in it as code."""
    return html_of(coded(text, keys))


def chip(word: str) -> str:
    """Return a verdict as a coloured word with its sign."""
    return f'<span class="chip {word}">{SIGNS[word]} {word}</span>'


def link(key: str, anchors: dict[str, str]) -> str:
    """Return the key of a claim as a link to its card, if it has one."""
    code = f"<code>{escape(key)}</code>"
    return f'<a href="#{anchors[key]}">{code}</a>' if key in anchors else code


def row(report: Report, claim: Claim, anchors: dict[str, str]) -> str:
    """Return the row of a claim in the table."""
    engine = rests = ""
    if claim.key not in report.errors:
        verdict = report[claim.key]
        extent = effort(verdict.evidence)
        engine = escape(verdict.evidence.engine) + (f"<small>{extent}</small>" if extent else "")
        rests = ", ".join(link(key, anchors) for key in verdict.rests_on)
    return (
        f"<tr><td>{chip(word_of(report, claim.key))}</td><td>{link(claim.key, anchors)}</td>"
        f"<td>{html_of(claim.title)}</td><td>{engine}</td><td>{rests}</td></tr>"
    )


def erratum(report: Report, claim: Claim, anchors: dict[str, str]) -> str:
    """Return what is printed, where it fails, and what holds."""
    evidence = report[claim.key].evidence
    printed, reason = (told(text, anchors) for text in (claim.statement, evidence.reason))
    repaired = told(claim.repaired, anchors) if claim.repaired else "<em>No repair is offered.</em>"
    found = (
        f'<article class="erratum"><h3>{html_of(claim.title)} {link(claim.key, anchors)}</h3>'
        f'<div class="pair"><div class="printed"><h4>Printed</h4><p>{printed}</p>'
        f'</div><div class="holds"><h4>Holds</h4><p>{repaired}</p></div></div>'
        f'<div class="fails"><h4>Where it fails</h4><p>{reason}</p>'
        f'{_instance(evidence)}</div><p class="again"><b>Again</b> '
        f"<code>{escape(replay(claim, report))}</code></p></article>"
    )
    return _linked(found, anchors)


def card(report: Report, claim: Claim, anchors: dict[str, str]) -> str:
    """Return the card of a claim."""
    word = word_of(report, claim.key)
    parts = [
        f'<article class="card {word}" id="{anchors[claim.key]}"><header>'
        f"<h3>{html_of(claim.title)}</h3>{chip(word)}</header>"
        f'<p class="where"><code>{escape(claim.key)}</code> · {claim.kind}</p>'
        f'<p class="statement">{told(claim.statement, anchors)}</p>'
    ]
    if claim.hypotheses:
        parts.append(f'<p class="given"><b>Supposed</b> {told(claim.hypotheses, anchors)}</p>')
    if claim.key in report.errors:
        parts.append(f'<p class="found"><b>No verdict</b> {escape(report.errors[claim.key])}</p>')
    else:
        parts.append(_evidence(report[claim.key].evidence, anchors))
        if rests := report[claim.key].rests_on:
            named = ", ".join(link(key, anchors) for key in rests)
            parts.append(f'<p class="rests"><b>Its printed proof rests on</b> {named}</p>')
    if claim.repaired:
        parts.append(f'<p class="mended"><b>Holds instead</b> {told(claim.repaired, anchors)}</p>')
    if claim.uses:
        named = ", ".join(link(key, anchors) for key in claim.uses)
        parts.append(f'<p class="uses"><b>Uses</b> {named}</p>')
    took = report.seconds.get(claim.key, 0.0)
    time = f" <small>{took:.1f} s</small>" if took > 0.05 else ""
    command = escape(replay(claim, report))
    parts.append(f'<p class="again"><b>Again</b> <code>{command}</code>{time}</p></article>')
    return _linked("".join(parts), anchors)


def _linked(html: str, anchors: dict[str, str]) -> str:
    """Turn every key of a claim that a text sets as code into a link."""

    def replaced(found: re.Match[str]) -> str:
        key = unescape(found[1])
        return link(key, anchors) if key in anchors else found[0]

    return re.sub(r'(?<!">)<code>([^<]+)</code>(?! ·)', replaced, html)


def _evidence(evidence: Evidence, keys: Collection[str]) -> str:
    """Return what was found; several checks one below the other."""
    parts = evidence.details.get("parts")
    several = parts or [
        {"engine": evidence.engine, "reason": evidence.reason} | dict(evidence.details)
    ]
    found = ""
    for part in several:
        rest = dict(part)
        engine, reason = rest.pop("engine"), told(rest.pop("reason"), keys)
        rest.pop("verdict", None)
        found += f'<p class="found"><b>{escape(engine)}</b> {reason}</p>' + _details(rest)
    if evidence.instance:
        return found + _instance(evidence)
    if sides(evidence):
        return found + f'<p class="sides">tightest seen: <b>{sides(evidence)}</b></p>'
    return found


def _instance(evidence: Evidence) -> str:
    cells = "".join(
        f"<div><dt>{plain_html(name)}</dt><dd>{escape(_text(value))}</dd></div>"
        for name, value in evidence.instance.items()
    )
    both = f'<p class="sides">there <b>{sides(evidence)}</b></p>' if sides(evidence) else ""
    return f'<dl class="instance">{cells}</dl>{both}'


def _details(details: Mapping[str, Any]) -> str:
    """Return short details in one line, long ones folded away."""
    short, long = [], ""
    for name, value in details.items():
        text, title = _text(value), escape(name.replace("_", " "))
        if len(text) <= _LONG and "\n" not in text:
            short.append(f"{title} <code>{escape(text)}</code>")
        else:
            long += f"<details><summary>{title}</summary><pre>{escape(text)}</pre></details>"
    return (f'<p class="detail">{" · ".join(short)}</p>' if short else "") + long


def _text(value: Any) -> str:
    if isinstance(value, str):
        return value
    if isinstance(value, float):
        return number(value) if abs(value) < float("inf") else str(value)
    return json.dumps(value, ensure_ascii=False)
