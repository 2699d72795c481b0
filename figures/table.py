"""The data of a picture: one table, kept as CSV with what it is of on top."""

from __future__ import annotations

import csv
import io
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from itertools import takewhile
from typing import Any

import numpy as np
import numpy.typing as npt

from ..graphs import InputError

Value = str | int | float | None


@dataclass(frozen=True)
class Table:
    """Rows of numbers, texts and gaps (None).

    Parameters
    ----------
    columns : tuple of str
    rows : tuple of tuples
        One value for each column.

    Raises
    ------
    InputError
        If a row has another length.
    """

    columns: tuple[str, ...]
    rows: tuple[tuple[Value, ...], ...]

    def __post_init__(self) -> None:
        if any(len(row) != len(self.columns) for row in self.rows):
            raise InputError(f"every row of a table needs {len(self.columns)} values")

    @classmethod
    def of(cls, records: Iterable[Mapping[str, Any]]) -> Table:
        """Return the table of records; what a record does not name is a gap."""
        records = tuple(records)
        columns = tuple(dict.fromkeys(name for record in records for name in record))
        rows = tuple(tuple(_plain(record.get(name)) for name in columns) for record in records)
        return cls(columns, rows)

    def where(self, **wanted: Value) -> Table:
        """Return the rows with these values in these columns."""
        places = {self._place(name): value for name, value in wanted.items()}
        kept = (row for row in self.rows if all(row[i] == v for i, v in places.items()))
        return Table(self.columns, tuple(kept))

    def values(self, column: str) -> list[Value]:
        """Return one column as it stands."""
        at = self._place(column)
        return [row[at] for row in self.rows]

    def distinct(self, column: str) -> list[Value]:
        """Return the values of one column in the order they come, each once, gaps left out."""
        return [value for value in dict.fromkeys(self.values(column)) if value is not None]

    def numbers(self, column: str) -> npt.NDArray[np.float64]:
        """Return one column as floats, NaN for a gap, shape (rows,)."""
        return np.array([np.nan if v is None else v for v in self.values(column)], dtype=float)

    def records(self) -> list[dict[str, Any]]:
        """Return every row as a dictionary."""
        return [dict(zip(self.columns, row, strict=True)) for row in self.rows]

    def _place(self, column: str) -> int:
        if column not in self.columns:
            raise InputError(f"the table has no column {column!r}: {', '.join(self.columns)}")
        return self.columns.index(column)

    def to_csv(self, head: Mapping[str, str]) -> str:
        """Return the text of the file: lines ``# name: value``, the columns, the rows.

        Floats are written with all their digits, so that reading gives the same bits.
        """
        out = io.StringIO()
        for name, value in head.items():
            out.write(f"# {name}: {one_line(value)}\n")
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(self.columns)
        writer.writerows(["" if v is None else v for v in row] for row in self.rows)
        return out.getvalue()

    @classmethod
    def from_csv(cls, text: str) -> tuple[Table, dict[str, str]]:
        """Return the table and the head of a file that `to_csv` has written.

        Raises
        ------
        InputError
            If it is none.
        """
        # a name may hold any letter, also those that `str.splitlines` takes for an end
        lines = list(io.StringIO(text, newline=""))
        above = list(takewhile(lambda line: line.startswith("# "), lines))
        head = dict(line[2:].rstrip("\n").partition(": ")[::2] for line in above)
        try:
            body = list(csv.reader(lines[len(above) :]))
        except csv.Error:
            body = []
        if not body or any(len(row) != len(body[0]) for row in body):
            raise InputError("no table: columns and rows of one length are needed")
        return cls(tuple(body[0]), tuple(tuple(map(_parsed, row)) for row in body[1:])), head


def one_line(text: str) -> str:
    """Return a text in one line, as it stands in the head of a file."""
    return " ".join(text.splitlines())


def _plain(value: Any) -> Value:
    """Return a number of NumPy as one of Python, and a truth value as 0 or 1."""
    if hasattr(value, "item"):
        value = value.item()
    return int(value) if isinstance(value, bool) else value


def _parsed(text: str) -> Value:
    if text == "":
        return None
    for kind in (int, float):
        try:
            return kind(text)
        except ValueError:
            continue
    return text
