"""Completed units of a long run on disk, in any order, ready to be resumed."""

from __future__ import annotations

import json
import zlib
from os import PathLike
from pathlib import Path
from types import TracebackType
from typing import BinaryIO

import numpy as np

from ..graphs import InputError
from .arrays import Floats


class Store:
    """A file of records, one a unit.

    The file holds one line of JSON that says what the units are of, then records of equal length:
    the number of the unit (two integers), a checksum, and its numbers, all of 8 bytes,
    little-endian. A record that was being written when the program was killed fails its checksum
    or is short, and is computed again.

    Parameters
    ----------
    path : path or None
        None keeps nothing.
    kind : str
        What the file is of, such as ``"measurement"``.
    header : dict
        JSON values that tell one of the kind from another; a file with others is refused.
    size : int
        Numbers of one unit.

    Raises
    ------
    InputError
        If the file is something else, or cannot be read or written.
    """

    def __init__(
        self, path: str | PathLike[str] | None, kind: str, header: dict[str, object], size: int
    ) -> None:
        self._size = size
        self._known: dict[tuple[int, int], Floats] = {}
        self._file: BinaryIO | None = None
        if path is None:
            return
        path = Path(path)
        named = {"format": f"nearsight {kind}s 1", "numbers": size, **header}
        line = json.dumps(named, sort_keys=True).encode() + b"\n"
        try:
            old = path.read_bytes() if path.exists() else b""
            whole = self._read(path, old, line, kind)
            self._file = path.open("r+b" if old else "wb")
            if not whole:  # new, or killed within its first line
                self._file.write(line)
                whole = len(line)
            self._file.truncate(whole)
            self._file.seek(0, 2)
            self._file.flush()
        except OSError as error:
            raise InputError(f"checkpoint {path}: {error.strerror or error}") from error

    def load(self, unit: int, out: Floats, last: int = 0) -> bool:
        """Write the numbers of a unit to `out` if they are known; return whether they are."""
        found = self._known.get((unit, last))
        if found is None:
            return False
        out[...] = found.reshape(out.shape)
        return True

    def save(self, unit: int, values: Floats, last: int = 0) -> None:
        """Append a unit."""
        if self._file is None:
            return
        data = np.ascontiguousarray(values, dtype="<f8").tobytes()
        head = np.array([unit, last, zlib.crc32(data)], dtype="<i8").tobytes()
        self._file.write(head + data)
        self._file.flush()

    def _read(self, path: Path, data: bytes, line: bytes, kind: str) -> int:
        """Read all whole records; return where they end, 0 if the first line is not whole."""
        if len(data) < len(line) and line.startswith(data):
            return 0
        if not data.startswith(line):
            raise InputError(
                f"checkpoint {path}: {_stranger(data, line, kind)}; name another file, or delete it"
            )
        at, step = len(line), 8 * (3 + self._size)
        while at + step <= len(data):
            unit, last, check = np.frombuffer(data, "<i8", 3, at).tolist()
            body = data[at + 24 : at + step]
            if zlib.crc32(body) != check:
                break
            self._known[unit, last] = np.frombuffer(body, "<f8").astype(np.float64)
            at += step
        return at

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._file is not None:
            self._file.close()


def _stranger(data: bytes, line: bytes, kind: str) -> str:
    """Say what a file is that is not of these units."""
    ours = json.loads(line)
    try:
        theirs = json.loads(data.partition(b"\n")[0])
        same = theirs["format"] == ours["format"]
    except (ValueError, KeyError, TypeError):
        same = False
    if not same:
        return f"it is no file of {kind}s"
    other = [name for name in ours if ours[name] != theirs.get(name)]
    told = [name for name in other if name != "numbers"] or other  # a size follows from the rest
    return f"it is of another {kind} (other {', '.join(told)})"
