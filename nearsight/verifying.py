"""One call for what ``nearsight verify`` does."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .verify.evidence import Level
    from .verify.results import Report


def verify_claims(
    labels: str | Sequence[str] = (),
    level: Level = "quick",
    workers: int = 1,
    checkpoint: str | PathLike[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
    *,
    mutation: bool = False,
    report: str | PathLike[str] | None = None,
    record: bool = False,
) -> Report:
    """Judge the claims of the paper, and of this project, one by one.

    Parameters
    ----------
    labels : str or sequence of str
        Labels (``"thm:networked-exp-decay"``), or keys with a part (``"coro:CR-LPC[a]"``); all
        claims if omitted.
    level : {"quick", "full"}
        How hard the searches try.
    workers : int
        Processes; 0 for one a core. More than one need joblib (the extra ``parallel``).
    checkpoint : path, optional
        A file that keeps what is done, and from which an interrupted run goes on. It counts for
        nothing once the code has changed.
    progress : callable, optional
        Called as ``progress(done, total)``.
    mutation : bool
        Also give every check false statements, which it has to reject.
    report : path, optional
        A folder that gets ``report.html``, ``report.md`` and ``report.json``.
    record : bool
        Write the verdicts to the repository, as those that later runs are compared with.

    Returns
    -------
    Report
        ``report["label"]`` is the verdict on one claim; ``report.changes`` lists the verdicts that
        differ from the recorded ones.

    Raises
    ------
    InputError
        If an argument cannot be used; the message says what would be accepted.

    Examples
    --------
    >>> import nearsight as ns
    >>> ns.verify_claims(level="medium")
    Traceback (most recent call last):
        ...
    nearsight.graphs.errors.InputError: level = 'medium': quick or full
    """
    from .perturbation import Runner
    from .verify.recorded import record as write_record
    from .verify.report.write import write
    from .verify.run import run

    labels = (labels,) if isinstance(labels, str) else tuple(labels)
    found = run(
        labels,
        level,
        mutation=mutation,
        runner=Runner(workers),
        checkpoint=None if checkpoint is None else Path(checkpoint),
        progress=progress,
    )
    if report is not None:
        write(found, Path(report))
    if record:
        write_record(found, everything=not labels)
    return found
