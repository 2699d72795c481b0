"""Verdicts, for people."""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING

import click
from rich import box
from rich.table import Table

from .tables import show

if TYPE_CHECKING:
    from pathlib import Path

    from ..verify import Claim
    from ..verify.results import Report

_STYLE = {"proved": "green", "supported": "cyan", "refuted": "red", "undecided": "yellow"}


def print_verdicts(report: Report, single: bool, folder: Path | None = None) -> None:
    """Print one row a claim and the counts, or for single claims also the evidence.

    Then where the report is, if it has been written to a folder.
    """
    from ..verify.report.words import SIGNS, effort, headline, word_of

    lines = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    longest = max((2 + len(word_of(report, claim.key)) for claim in report.claims), default=0)
    lines.add_column("verdict", no_wrap=True, min_width=longest)
    # keys are searched for and pasted: they never break, the evidence wraps before
    longest = max([28, *(len(claim.key) for claim in report.claims)])
    lines.add_column("claim", no_wrap=True, min_width=longest)
    lines.add_column("evidence")
    longest = max((len(key) for v in report.verdicts for key in v.rests_on), default=0)
    lines.add_column("its proof rests on", no_wrap=True, min_width=longest)
    for claim in report.claims:
        word = word_of(report, claim.key)
        engine, rests = "", ""
        if claim.key not in report.errors:
            verdict = report[claim.key]
            extent = effort(verdict.evidence)
            engine = verdict.evidence.engine + (f", {extent}" if extent else "")
            rests = "\n".join(verdict.rests_on)
        signed = f"[{_STYLE[word]}]{SIGNS[word]} {word}[/]"
        lines.add_row(signed, claim.key.replace("[", r"\["), engine, rests.replace("[", r"\["))
    show(lines)
    for claim in report.claims:
        if single and claim.key not in report.errors:
            _print_evidence(report, claim)
    click.echo(f"\n{headline(report)}")
    if report.mutations is not None:
        good = sum(one.good for one in report.mutations)
        click.echo(f"{good} of {len(report.mutations)} false statements rejected")
    if folder is not None:
        click.echo(f"report: {folder / 'report.html'} .md .json")


def _print_evidence(report: Report, claim: Claim) -> None:
    from ..verify.report.words import sides

    evidence = report[claim.key].evidence
    click.echo(f"\n{claim.key}: {claim.title}")
    entries = {
        "claim": claim.statement,
        "supposed": claim.hypotheses,
        "verdict": f"{evidence.verdict} ({evidence.engine}): {evidence.reason}",
        "instance": ", ".join(f"{name} = {value}" for name, value in evidence.instance.items()),
        "there" if evidence.instance else "tightest": sides(evidence),
        "instead": claim.repaired,
    }
    for name, text in entries.items():
        if text:
            lead = f"  {name}: "
            click.echo(textwrap.fill(text, 100, initial_indent=lead, subsequent_indent="      "))
