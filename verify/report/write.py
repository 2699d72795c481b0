"""All forms of the report in a folder."""

from __future__ import annotations

import json
from pathlib import Path

from ...graphs import InputError
from ..results import Report
from .json_report import document
from .markdown import markdown
from .page import page


def write(report: Report, folder: Path) -> tuple[Path, ...]:
    """Write ``report.html``, ``report.md`` and ``report.json``; return their paths.

    Raises
    ------
    InputError
        If they cannot be written.
    """
    texts = {
        "report.html": page(report),
        "report.md": markdown(report),
        "report.json": json.dumps(document(report), indent=1) + "\n",
    }
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            (folder / name).write_text(text, encoding="utf-8")
    except OSError as error:
        raise InputError(f"{folder}: {error.strerror or error}", "report") from error
    return tuple(folder / name for name in texts)
