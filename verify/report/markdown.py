"""The report in Markdown."""

from __future__ import annotations

import json
import re

from ..claim import Claim
from ..results import Report
from .words import SIGNS, effort, headline, replay, sides, word_of


def markdown(report: Report) -> str:
    """Return the report: errata first, then a table, then every claim with its evidence."""
    refuted = [claim for claim in report.claims if word_of(report, claim.key) == "refuted"]
    parts = [
        "# Is each claim true?",
        f"{headline(report)} (level `{report.level}`).",
        *_unusual(report),
        "## Errata",
        *([_erratum(report, claim) for claim in refuted] or ["None."]),
        "## All claims",
        _table(report),
        "## Evidence",
        *(_claim(report, claim) for claim in report.claims),
    ]
    return "\n\n".join(parts) + "\n"


def plain(text: str) -> str:
    """Return a text with what Markdown would read as its own signs escaped, outside code."""
    pieces = text.split("`")
    pieces[::2] = [re.sub(r"([\\*_|]|<(?=[a-zA-Z/!]))", r"\\\1", piece) for piece in pieces[::2]]
    return "`".join(pieces)


def _unusual(report: Report) -> list[str]:
    lines = [f"- changed: {change}" for change in report.changes]
    lines += [f"- {one.key}, check {one.check}: {one.outcome}: {one.text}" for one in report.weak]
    if report.mutations is not None:
        good = sum(one.good for one in report.mutations)
        lines.append(f"- {good} of {len(report.mutations)} false statements rejected")
    return ["\n".join(lines)] if lines else []


def _erratum(report: Report, claim: Claim) -> str:
    evidence = report[claim.key].evidence
    lines = [
        f"### `{claim.key}`: {claim.title}",
        f"Printed: {plain(claim.statement)}",
        f"Instance: `{json.dumps(evidence.instance)}`",
    ]
    if sides(evidence):
        lines.append(f"There: {sides(evidence)}")
    if claim.repaired:
        lines.append(f"Holds instead: {plain(claim.repaired)}")
    lines.append(f"Again: `{replay(claim, report)}`")
    return "\n\n".join(lines)


def _table(report: Report) -> str:
    lines = ["| | claim | | evidence | its proof rests on |", "|---|---|---|---|---|"]
    for claim in report.claims:
        word = word_of(report, claim.key)
        engine, rests = "", ""
        if claim.key not in report.errors:
            verdict = report[claim.key]
            extent = effort(verdict.evidence)
            engine = verdict.evidence.engine + (f", {extent}" if extent else "")
            rests = ", ".join(f"`{key}`" for key in verdict.rests_on)
        title = plain(claim.title)
        lines.append(f"| {SIGNS[word]} {word} | `{claim.key}` | {title} | {engine} | {rests} |")
    return "\n".join(lines)


def _claim(report: Report, claim: Claim) -> str:
    lines = [f"### {SIGNS[word_of(report, claim.key)]} `{claim.key}`: {claim.title}"]
    lines.append(plain(claim.statement))
    if claim.hypotheses:
        lines.append(f"Supposed: {plain(claim.hypotheses)}")
    if claim.key in report.errors:
        lines.append(f"No verdict: {report.errors[claim.key]}")
    else:
        verdict = report[claim.key]
        lines.append(
            f"**{verdict.verdict}** ({verdict.evidence.engine}): {plain(verdict.evidence.reason)}"
        )
        if verdict.rests_on:
            rests = ", ".join(f"`{key}`" for key in verdict.rests_on)
            lines.append(f"Its printed proof rests on the refuted {rests}.")
    lines.append(f"Again: `{replay(claim, report)}`")
    return "\n\n".join(lines)
