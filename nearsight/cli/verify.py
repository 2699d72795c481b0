"""``nearsight verify``: is each claim of the paper true?"""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .options import JSON, PROCESSES, input_errors, options
from .output import Progress, print_json

if TYPE_CHECKING:
    from ..verify.results import Report

_OPTIONS = [
    click.argument("labels", nargs=-1, metavar="[LABEL]..."),
    click.option(
        "--level",
        type=click.Choice(["quick", "full"]),
        default="quick",
        show_default=True,
        help="How hard the searches try.",
    ),
    PROCESSES,
    click.option(
        "--checkpoint",
        type=click.Path(path_type=Path),
        help="Keep what is done in a file, and go on after what it holds.",
    ),
    click.option(
        "--report",
        metavar="DIR",
        type=click.Path(path_type=Path),
        help="Write report.html, report.md and report.json to a folder.",
    ),
    click.option(
        "--mutation", is_flag=True, help="Also give every check false statements to reject."
    ),
    click.option(
        "--record", is_flag=True, help="Keep these verdicts as those to compare with later."
    ),
]


@click.command("verify", short_help="Which claims of the paper hold, and on what evidence.")
@options(_OPTIONS, JSON)
def COMMAND(as_json: bool, **given: Any) -> None:
    """Go through the claims, or those with a LABEL, and say which hold.

    proved: by algebra, by a decision procedure, or by interval arithmetic over the whole
    range; supported: no violation among many instances; refuted: an instance that a reader
    can redo by hand. Beside the verdict stand the refuted claims that the proof rests on.

    Exit status 1 if a verdict is not the recorded one, if there is none, or if a check
    accepts a false statement.
    """
    progress = Progress()
    with input_errors():
        from ..verifying import verify_claims

        found = verify_claims(progress=lambda i, n: progress.step("claim", i, n), **given)
        progress.close()
        if as_json:
            from ..verify.report.json_report import document

            print_json(document(found))
        else:
            from .verdict_tables import print_verdicts

            print_verdicts(found, bool(given["labels"]), given["report"])
    complaints = _complaints(found, given["record"])
    for line in complaints:
        click.echo(line, err=True)
    if complaints:
        sys.exit(1)


def _complaints(found: Report, recorded: bool) -> list[str]:
    """Return why the answer is no; verdicts that were just recorded are no change."""
    lines = [] if recorded else [f"changed: {change}" for change in found.changes]
    lines += [f"no verdict: {key}: {text}" for key, text in found.errors.items()]
    lines += [
        f"cannot fail: {m.key}, check {m.check} ({m.engine}): {m.outcome}: {m.text}"
        for m in found.weak
    ]
    return lines
