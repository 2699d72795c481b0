"""The verdicts as they were last recorded in the repository."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path

from ..graphs import InputError
from .evidence import Verdict
from .results import Change, Report

PATH = Path(__file__).with_name("recorded.json")


def recorded() -> dict[str, str]:
    """Return key -> verdict."""
    found: dict[str, str] = json.loads(PATH.read_text(encoding="utf-8"))
    return found


def changes(
    verdicts: Sequence[Verdict], keys: Sequence[str], *, everything: bool
) -> tuple[Change, ...]:
    """Return where verdicts differ from the recorded ones.

    Parameters
    ----------
    verdicts : sequence of Verdict
    keys : sequence of str
        The claims judged; one without a verdict has changed.
    everything : bool
        Whether these are all claims, so that a recorded one that is not there has changed too.
    """
    before, now = recorded(), {verdict.key: verdict.verdict for verdict in verdicts}
    gone = [key for key in before if key not in keys] if everything else []
    return tuple(
        Change(key, before.get(key), now.get(key))
        for key in [*keys, *gone]
        if before.get(key) != now.get(key) or key not in now
    )


def record(report: Report, *, everything: bool) -> int:
    """Write the verdicts of a report to the repository; return how many changed.

    Parameters
    ----------
    report : Report
    everything : bool
        Whether it is on all claims: recorded ones that are gone are then dropped.

    Raises
    ------
    InputError
        If a claim has no verdict, or the file cannot be written.
    """
    if report.errors:
        raise InputError(f"not recorded: no verdict on {', '.join(report.errors)}")
    before = recorded()
    after = {} if everything else dict(before)
    after |= {verdict.key: verdict.verdict for verdict in report.verdicts}
    try:
        PATH.write_text(json.dumps(after, indent=1, sort_keys=True) + "\n", encoding="utf-8")
    except OSError as error:
        raise InputError(f"{PATH.name}: {error.strerror or error}") from error
    return sum(before.get(key) != after.get(key) for key in before.keys() | after.keys())
