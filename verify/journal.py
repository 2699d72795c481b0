"""Results of a long run on disk, one line of JSON each, ready to be resumed."""

from __future__ import annotations

import hashlib
import json
import sys
from functools import cache
from importlib import import_module, metadata
from pathlib import Path
from types import TracebackType
from typing import Any, BinaryIO

from ..graphs import InputError

_FORMAT = "nearsight verdicts 1"
_CODE = ("bounds", "graphs", "lowerbounds", "lpc", "perturbation", "verify")
_LIBRARIES = ("numpy", "scipy", "sympy", "mpmath", "python-flint", "z3-solver")


@cache
def fingerprint() -> str:
    """Return a hash of all that a verdict depends on: our code, and the libraries' versions."""
    found = hashlib.sha256(sys.version.encode())
    root = __package__.rpartition(".")[0]
    for name in _CODE:
        folder = Path(str(import_module(f"{root}.{name}").__file__)).parent
        for path in sorted(folder.rglob("*.py")):
            found.update(str(path.relative_to(folder)).encode() + b"\0" + path.read_bytes())
    for library in _LIBRARIES:
        try:
            found.update(f"{library} {metadata.version(library)}".encode())
        except metadata.PackageNotFoundError:
            continue
    return found.hexdigest()[:16]


class Journal:
    """A file of results, each with its task and with the `fingerprint` of the code behind it.

    A result of other code is not used again. A last line that is cut off, as a killed run leaves
    it, is dropped.

    Parameters
    ----------
    path : Path or None
        None keeps nothing.

    Raises
    ------
    InputError
        If the file is something else, or cannot be read or written.
    """

    def __init__(self, path: Path | None) -> None:
        self._known: dict[tuple[str, ...], Any] = {}
        self._file: BinaryIO | None = None
        if path is None:
            return
        try:
            old = path.read_bytes() if path.exists() else b""
            whole = self._read(path, old)
            self._file = path.open("r+b" if old else "wb")
        except OSError as error:
            raise InputError(
                f"checkpoint {path}: {error.strerror or error}", "checkpoint"
            ) from error
        self._file.truncate(whole)
        self._file.seek(0, 2)
        if not whole:
            self._write({"format": _FORMAT})

    def get(self, task: tuple[str, ...]) -> Any:
        """Return the result of a task, or None."""
        return self._known.get(task)

    def add(self, task: tuple[str, ...], result: Any) -> None:
        """Append the result of a task."""
        if self._file is not None:
            self._write({"task": task, "code": fingerprint(), "result": result})

    def _write(self, line: dict[str, Any]) -> None:
        if self._file is not None:
            self._file.write(json.dumps(line).encode() + b"\n")
            self._file.flush()

    def _read(self, path: Path, old: bytes) -> int:
        """Read the results of this code; return where the last whole line ends."""
        if not old:
            return 0
        first, *lines = old.splitlines(keepends=True)
        if first != json.dumps({"format": _FORMAT}).encode() + b"\n":
            text = f"checkpoint {path}: it is no file of verdicts; name another file, or delete it"
            raise InputError(text, "checkpoint")
        whole = len(first)
        for line in lines:
            try:
                found = json.loads(line)
            except ValueError:
                break
            if not line.endswith(b"\n"):
                break
            whole += len(line)
            if found["code"] == fingerprint():
                self._known[tuple(found["task"])] = found["result"]
        return whole

    def __enter__(self) -> Journal:
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        if self._file is not None:
            self._file.close()
