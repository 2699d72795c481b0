"""A simulation on disk: the steps it has completed, ready to be resumed."""

from __future__ import annotations

import json
import zlib
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..graphs import InputError
from .arrays import Floats
from .controller import Controller
from .identity import identity

_MAGIC = "nearsight checkpoint 1"


class Checkpoint:
    """Actions appended to a file, step by step.

    The file holds one line of JSON that says which simulation it is of, then for every completed
    step its actions, (N, n) numbers of 8 bytes, little-endian, the largest error of one of them,
    and a checksum of all these (CRC 32, as an integer of 8 bytes). A step that was being written
    when the program was killed, or was damaged since, and all steps after it are computed again.

    Parameters
    ----------
    path : Path
        Created if it is not there.
    controller : Controller
        Whose steps they are.

    Raises
    ------
    InputError
        If the file is no checkpoint, or one of another simulation.
    """

    def __init__(self, path: Path, controller: Controller) -> None:
        problem = controller.problem
        self._shape = (problem.N, problem.n)
        header = json.dumps({"format": _MAGIC, **identity(controller)}, sort_keys=True)
        line = header.encode() + b"\n"
        size = problem.N * problem.n + 1
        self.done, self.errors = np.zeros((0, *self._shape)), np.zeros(0)
        try:
            if path.exists() and path.stat().st_size:
                torn = self._check(path, line)
                values = np.zeros((0, size)) if torn else _whole(path, len(line), size, problem.H)
                steps = len(values)
                self.done, self.errors = values[:, :-1].reshape(steps, *self._shape), values[:, -1]
                self._file: BinaryIO = path.open("r+b")
                if torn:
                    self._file.write(line)
                self._file.truncate(len(line) + steps * 8 * (size + 1))
                self._file.seek(0, 2)
            else:
                self._file = path.open("wb")
                self._file.write(line)
                self._file.flush()
        except OSError as error:
            raise InputError(f"checkpoint {path}: {error.strerror or error}") from error

    def add(self, actions: Floats, error: float) -> None:
        """Append the next step, and leave none of it in memory."""
        data = np.append(actions, error).astype("<f8").tobytes()
        self._file.write(data + np.int64(zlib.crc32(data)).astype("<i8").tobytes())
        self._file.flush()

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    @staticmethod
    def _check(path: Path, line: bytes) -> bool:
        """Return whether the file ends within its first line; refuse that of something else."""
        with path.open("rb") as file:
            found = file.readline(1 << 16)
        if found == line:
            return False
        if not found.endswith(b"\n") and line.startswith(found):
            return True
        try:
            theirs = json.loads(found)
            kind = theirs.get("format") == _MAGIC
        except (ValueError, AttributeError):
            kind = False
        if not kind:
            raise InputError(f"checkpoint {path}: it is no checkpoint; name a file not there yet")
        ours = json.loads(line)
        other = ", ".join(name for name in ours if ours[name] != theirs.get(name))
        raise InputError(
            f"checkpoint {path}: it is of another simulation (other {other}); "
            "name another file, or delete it"
        )


def _whole(path: Path, start: int, size: int, most: int) -> Floats:
    """Return the rows up to the first that is short or fails its checksum, shape (steps, size)."""
    data, row, rows = path.read_bytes()[start:], 8 * (size + 1), []
    for at in range(0, min(len(data) // row, most) * row, row):
        body = data[at : at + row - 8]
        if zlib.crc32(body) != int.from_bytes(data[at + row - 8 : at + row], "little"):
            break
        rows.append(np.frombuffer(body, "<f8").astype(np.float64))
    return np.stack(rows) if rows else np.zeros((0, size))
