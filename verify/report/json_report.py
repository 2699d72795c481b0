"""The report as one JSON document."""

from __future__ import annotations

from dataclasses import asdict
from typing import Any

from ..claim import Claim
from ..results import Report
from .words import replay


def document(report: Report) -> dict[str, Any]:
    """Return the report as JSON values.

    ``claims`` lists every claim with a verdict, ``errors`` those without; ``mutation`` is null if
    mutants were not run.
    """
    return {
        "level": report.level,
        "good": report.good,
        "counts": report.counts,
        "claims": [
            _claim(report, claim) for claim in report.claims if claim.key not in report.errors
        ],
        "errors": [{"key": key, "reason": text} for key, text in report.errors.items()],
        "changes": [asdict(change) for change in report.changes],
        "mutation": None
        if report.mutations is None
        else {
            "mutants": len(report.mutations),
            "rejected": sum(one.good for one in report.mutations),
            "accepted": [asdict(one) for one in report.weak],
        },
    }


def _claim(report: Report, claim: Claim) -> dict[str, Any]:
    verdict = report[claim.key]
    return {
        "label": claim.label,
        "part": claim.part,
        "key": claim.key,
        "verdict": verdict.verdict,
        "rests_on": list(verdict.rests_on),
        "evidence": asdict(verdict.evidence),
        "kind": claim.kind,
        "title": claim.title,
        "statement": claim.statement,
        "hypotheses": claim.hypotheses,
        "uses": list(claim.uses),
        "repaired": claim.repaired,
        "seconds": report.seconds.get(claim.key),
        "replay": replay(claim, report),
    }
