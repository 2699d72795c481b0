"""Files that a command will write, looked at before it begins."""

from __future__ import annotations

import os
from pathlib import Path

import click


def writable(option: str, path: Path | None) -> None:
    """Raise a usage error if a file cannot be written, without making it."""
    if path is None:
        return
    place = path if path.exists() else path.parent
    if not (path.parent.is_dir() and os.access(place, os.W_OK)):
        raise click.UsageError(f"{option} {path}: a file in a folder to be written to is needed")
