"""What tells one simulation from another."""

from __future__ import annotations

import hashlib
import json
from typing import TYPE_CHECKING

import numpy as np

from ..graphs import InputError
from .codec import Arrays, encode
from .problem import Problem

if TYPE_CHECKING:
    from .controller import Controller


def digest(problem: Problem) -> str:
    """Return a hexadecimal digest of a problem.

    Every part that has a place in a problem file goes into it as it stands. Python functions have
    none: of them what counts is their values, agent by agent, at points drawn with a fixed seed.
    """
    found = hashlib.sha256()
    arrays: Arrays = {}
    parts: dict[str, object] = {"H": problem.H}
    for name in ("node", "temporal", "spatial", "feasible"):
        try:
            parts[name] = encode(getattr(problem, name), arrays)
        except InputError:
            _sample(problem, name, arrays)
    arrays["indptr"], arrays["indices"] = problem.network.indptr, problem.network.indices
    arrays["x_0"] = problem.x_0
    found.update(json.dumps(parts, sort_keys=True).encode())
    for name in sorted(arrays):
        array = np.ascontiguousarray(arrays[name])
        found.update(f"{name} {array.dtype} {array.shape}".encode())
        found.update(array.tobytes())
    return found.hexdigest()


def _sample(problem: Problem, name: str, arrays: Arrays) -> None:
    """Put values of a cost, or of constraints, at random points among the arrays."""
    rng, H, n = np.random.default_rng(0), problem.H, problem.n
    count = len(problem.edges) if name == "spatial" else problem.N
    t, i = np.repeat(np.arange(1, H + 1), count), np.tile(np.arange(count), H)
    for draw in range(2):
        if name == "feasible":
            y = rng.normal(size=(len(t), n))
            arrays[f"{name} {draw}"] = problem.feasible.constraints(t, i, y)[0]
        else:
            cost = getattr(problem, name)
            w = rng.normal(size=(len(t), cost.size))
            arrays[f"{name} {draw}"] = cost.value(t, i, w)
            arrays[f"{name} {draw} slope"] = cost.gradient(t, i, w)


def identity(controller: Controller) -> dict[str, object]:
    """Return what a checkpoint is of, as JSON values."""
    problem = controller.problem
    return {
        "problem": digest(problem),
        "N": problem.N,
        "n": problem.n,
        "H": problem.H,
        "k": controller.k,
        "r": controller.r,
        "method": controller.method,
        "tolerance": controller.tolerance,
    }
