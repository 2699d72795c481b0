"""A simulation on disk: the steps it has completed, ready to be resumed."""

from __future__ import annotations

import hashlib
import json
from pathlib import Path
from typing import BinaryIO

import numpy as np

from ..graphs import InputError
from .arrays import Floats
from .controller import Controller

_MAGIC = "nearsight checkpoint 1"


class Checkpoint:
    """Actions appended to a file, step by step.

    The file holds one line of JSON that says which simulation it is of, then for every completed
    step its actions, (N, n) numbers of 8 bytes, little-endian, and the largest error of one of
    them. A step that was being written when
    the program was killed is incomplete, and is computed again.

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
        row = 8 * size
        self.done, self.errors = np.zeros((0, *self._shape)), np.zeros(0)
        try:
            if path.exists() and path.stat().st_size:
                self._check(path, line)
                steps = min((path.stat().st_size - len(line)) // row, problem.H)
                values = np.fromfile(path, "<f8", steps * size, offset=len(line))
                values = values.astype(np.float64).reshape(steps, size)
                self.done, self.errors = values[:, :-1].reshape(steps, *self._shape), values[:, -1]
                self._file: BinaryIO = path.open("r+b")
                self._file.truncate(len(line) + steps * row)
                self._file.seek(0, 2)
            else:
                self._file = path.open("wb")
                self._file.write(line)
                self._file.flush()
        except OSError as error:
            raise InputError(f"checkpoint {path}: {error.strerror or error}") from error

    def add(self, actions: Floats, error: float) -> None:
        """Append the next step, and leave none of it in memory."""
        self._file.write(np.append(actions, error).astype("<f8").tobytes())
        self._file.flush()

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    @staticmethod
    def _check(path: Path, line: bytes) -> None:
        with path.open("rb") as file:
            found = file.readline(1 << 16)
        if found == line:
            return
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


def identity(controller: Controller) -> dict[str, object]:
    """Return what tells one simulation from another, as JSON values.

    The problem is recognised by a digest of its network, its x_0, its node minimisers, and of its
    costs and constraints at trajectories drawn with a fixed seed, so that it works for every kind
    of cost.
    """
    problem = controller.problem
    digest = hashlib.sha256()
    network = problem.network
    for array in (network.indptr, network.indices, problem.x_0, controller.theta):
        digest.update(np.ascontiguousarray(array).tobytes())
    rng = np.random.default_rng(0)
    scale = 1.0 + float(np.abs(controller.theta).max(initial=0.0))
    agents = np.arange(problem.N)
    for _ in range(2):
        x = scale * rng.normal(size=(problem.H, problem.N, problem.n))
        for part in problem.costs(x).values():
            digest.update(part.tobytes())
        for s, actions in enumerate(x):
            t = np.full(problem.N, s + 1)
            digest.update(problem.feasible.violation(t, agents, actions).tobytes())
    return {
        "problem": digest.hexdigest(),
        "N": problem.N,
        "n": problem.n,
        "H": problem.H,
        "k": controller.k,
        "r": controller.r,
        "method": controller.method,
        "tolerance": controller.tolerance,
    }
