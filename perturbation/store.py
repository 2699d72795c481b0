"""Completed units of a long run on disk, in any order, ready to be resumed."""

from __future__ import annotations

import json
import zlib
from pathlib import Path
from types import TracebackType
from typing import BinaryIO

import numpy as np

from ..graphs import InputError
from ..lpc.arrays import Floats

_MAGIC = "nearsight measurements 1"


class Store:
    """A file of records, one a unit.

    The file holds one line of JSON that says what the units are of, then records of equal length:
    the number of the unit, how many instances the run had reached with it, a checksum, and its
    numbers, all of 8 bytes, little-endian. A record that was being written when the program was
    killed fails its checksum or is short, and is computed again.

    Parameters
    ----------
    path : Path or None
        None keeps nothing.
    header : dict
        JSON values; a file with another header is refused.
    size : int
        Numbers of one unit.
    """

    def __init__(self, path: Path | None, header: dict[str, object], size: int) -> None:
        self._size = size
        self._known: dict[tuple[int, int], Floats] = {}
        self._file: BinaryIO | None = None
        if path is None:
            return
        line = (
            json.dumps({"format": _MAGIC, "numbers": size, **header}, sort_keys=True).encode()
            + b"\n"
        )
        try:
            if path.exists() and path.stat().st_size:
                whole = self._read(path, line)
                self._file = path.open("r+b")
                self._file.truncate(whole)
                self._file.seek(0, 2)
            else:
                self._file = path.open("wb")
                self._file.write(line)
                self._file.flush()
        except OSError as error:
            raise InputError(f"checkpoint {path}: {error.strerror or error}") from error

    @classmethod
    def open(cls, path: str | Path | None, header: dict[str, object], size: int) -> Store:
        """Open or create the file."""
        return cls(None if path is None else Path(path), header, size)

    def load(self, unit: int, out: Floats, last: int) -> bool:
        """Write the numbers of a unit to `out` if they are known; return whether they are."""
        found = self._known.get((unit, last))
        if found is None:
            return False
        out[...] = found.reshape(out.shape)
        return True

    def save(self, unit: int, values: Floats, last: int) -> None:
        """Append a unit."""
        if self._file is None:
            return
        data = np.ascontiguousarray(values, dtype="<f8").tobytes()
        head = np.array([unit, last, zlib.crc32(data)], dtype="<i8").tobytes()
        self._file.write(head + data)
        self._file.flush()

    def _read(self, path: Path, line: bytes) -> int:
        """Read all whole records; return where they end."""
        data = path.read_bytes()
        if not data.startswith(line):
            known = data.startswith(line[:12]) and _MAGIC.encode() in data[:4096]
            what = "it is of another measurement" if known else "it is no file of measurements"
            raise InputError(f"checkpoint {path}: {what}; name another file, or delete it")
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
