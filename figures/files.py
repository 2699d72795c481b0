"""The files of one picture: its data as CSV, and the picture in several formats."""

from __future__ import annotations

import io
import os
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING

from ..graphs import InputError
from .table import Table, one_line

if TYPE_CHECKING:
    from matplotlib.figure import Figure

FORMATS = ("pdf", "png", "svg")
# No time and no version: the same picture has the same bytes.
_METADATA: dict[str, dict[str, str | None]] = {
    "pdf": {"Creator": "nearsight", "Producer": None, "CreationDate": None},
    "png": {"Software": None},
    "svg": {"Creator": "nearsight", "Date": None},
}


def write(path: Path, content: bytes) -> None:
    """Write a file at once: whoever interrupts leaves the old one or the new one, whole."""
    beside = path.with_name(f".{path.name}.{os.getpid()}")
    try:
        beside.write_bytes(content)
        beside.replace(path)
    finally:
        beside.unlink(missing_ok=True)


def save(figure: Figure, folder: Path, name: str, formats: Sequence[str]) -> tuple[Path, ...]:
    """Write a figure in each format, among `FORMATS`, and return the paths."""
    found = []
    for kind in formats:
        out = io.BytesIO()
        figure.savefig(out, format=kind, dpi=figure.dpi, metadata=_METADATA[kind])
        write(folder / f"{name}.{kind}", out.getvalue())
        found.append(folder / f"{name}.{kind}")
    return tuple(found)


def kept(path: Path, head: dict[str, str]) -> Table | None:
    """Return the table of a file, if it is there and was computed for the same head."""
    try:
        table, found = Table.from_csv(path.read_bytes().decode())
    except (FileNotFoundError, UnicodeDecodeError, InputError):
        return None
    return table if found == {name: one_line(text) for name, text in head.items()} else None
