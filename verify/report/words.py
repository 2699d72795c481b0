"""Words, signs and colours that all forms of the report share."""

from __future__ import annotations

import shlex

from ..claim import Claim
from ..evidence import Evidence
from ..results import Report

SIGNS = {"proved": "✓", "supported": "≈", "refuted": "✗", "undecided": "?"}
MEANINGS = {
    "proved": "by algebra, by a decision procedure, or by interval arithmetic over the whole "
    "range: of the statement, or of the step to which the argument beside it reduces it; that "
    "argument is for the reader to check",
    "supported": "no violation among instances that try to break it",
    "refuted": "an explicit instance inside the hypotheses violates it",
    "undecided": "no verdict: a check gave up",
}


def word_of(report: Report, key: str) -> str:
    """Return the verdict on a claim, ``"undecided"`` if there is none."""
    return "undecided" if key in report.errors else report[key].verdict


def replay(claim: Claim, report: Report) -> str:
    """Return the command that judges one claim again."""
    level = " --level full" if report.level == "full" else ""
    return f"nearsight verify {shlex.quote(claim.key)}{level}"


def number(value: float) -> str:
    """Format a number: an integer as such, any other to six digits."""
    return f"{value:.0f}" if value == int(value) and abs(value) < 1e6 else f"{value:.6g}"


def sides(evidence: Evidence) -> str:
    """Return both sides of the claim at the instance, as one inequality; may be empty."""
    if evidence.measured is None or evidence.bound is None:
        return ""
    relation = ">" if evidence.verdict == "refuted" else "≤"
    if evidence.verdict == "refuted" and not evidence.measured > evidence.bound:
        relation = "against"  # the interval engine tells a negative value, and 0
    left, right = number(evidence.measured), number(evidence.bound)
    if left == right and evidence.measured != evidence.bound:
        left, right = f"{evidence.measured:.17g}", f"{evidence.bound:.17g}"
    return f"{left} {relation} {right}"


def effort(evidence: Evidence) -> str:
    """Return how much was done, in two or three words."""
    if evidence.instances:
        return f"{evidence.instances} instances"
    if "boxes" in evidence.details:
        return f"{evidence.details['boxes']} boxes"
    return ""


def headline(report: Report) -> str:
    """Return one sentence with the counts."""
    counts = ", ".join(f"{count} {word}" for word, count in report.counts.items())
    failed = f", {len(report.errors)} without a verdict" if report.errors else ""
    claims = f"{len(report.claims)} claim{'s' * (len(report.claims) != 1)}"
    return f"{claims}: {counts}{failed}"
