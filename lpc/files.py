"""Problem files: everything a problem is made from, without loss, in one ``.npz`` file.

The file is what ``numpy.savez`` writes (a zip archive of ``.npy`` files), and is read with
``allow_pickle=False``: it holds numbers and text, never code. Its entries are

``problem.json``
    UTF-8 text as an array of bytes: a JSON object with

    - ``"format"``: ``"nearsight-problem"``, and ``"version"``: 1;
    - ``"problem"``: an object with ``"H"``, ``"network"`` (an object with ``"indptr"``,
      ``"indices"``, ``"names"``, null where they are 0, 1, ..., ``"source"`` and
      ``"node"``, ``"temporal"``, ``"spatial"``, ``"feasible"`` and ``"x_0"``;
    - ``"metadata"``: an object of any JSON values, not interpreted.

``a0``, ``a1``, ...
    The arrays that the JSON refers to.

Within ``"problem"`` a value is null, true, false, an integer, a text or a list as in JSON; or

========================================  ==============================================
``{"array": "a3"}``                       an array
``{"float": "0x1.8p+1"}``                 a double, in C's hexadecimal notation
``{"map": {"a": value, ...}}``            a dict
``{"cost": "mixture", "fields": {...}}``  a cost of that kind and the values of its fields
``{"set": "box", "fields": {...}}``       a feasible set likewise
========================================  ==============================================

A kind is the attribute `kind` of a class in ``lpc/costs`` or ``lpc/sets``; its fields are the
arguments of its constructor. Arrays are stored as they are, with axes of length 1 where nothing
changes, so that every number comes back bit by bit.
"""

from __future__ import annotations

import json
import os
import uuid
from collections.abc import Mapping
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from ..graphs import InputError, Network
from .codec import Arrays, decode, encode
from .problem import Problem

FORMAT = "nearsight-problem"
VERSION = 1
OTHERS = (
    "not a problem file; those are written by --save or save_problem (a network goes to --graph)"
)
ENTRY = "problem.json"
PARTS = ("H", "network", "node", "temporal", "spatial", "feasible", "x_0")


class Loaded(NamedTuple):
    """A problem from a file, and what was noted beside it."""

    problem: Problem
    metadata: dict[str, Any]


def save_problem(
    problem: Problem, path: str | os.PathLike[str], metadata: Mapping[str, Any] | None = None
) -> None:
    """Write a problem to a file, which is there completely or not at all.

    Parameters
    ----------
    problem : Problem
    path : str or path-like
        Replaced if it exists.
    metadata : dict, optional
        JSON values to keep beside it: where it comes from, say.

    Raises
    ------
    InputError
        If a part of the problem cannot be saved (Python functions), the metadata are not JSON,
        or the file cannot be written.
    """
    path = Path(path)
    try:
        notes = dict(metadata or {})
        plain = json.loads(json.dumps(notes, allow_nan=False))
    except (TypeError, ValueError, RecursionError) as error:
        raise InputError(f"metadata: JSON values are needed ({error})", "metadata") from error
    if plain != notes:
        raise InputError("metadata: a dict of JSON values (lists, text keys) is needed", "metadata")
    arrays: Arrays = {}
    try:
        tree = {part: encode(getattr(problem, part), arrays) for part in PARTS if part != "network"}
        tree["network"] = _from_network(problem.network, arrays)
    except InputError as error:
        raise InputError(f"{path}: not saved: {error}") from error
    head = {"format": FORMAT, "version": VERSION, "problem": tree, "metadata": plain}
    text = json.dumps(head, allow_nan=False).encode()
    entries: Arrays = {ENTRY: np.frombuffer(text, dtype=np.uint8), **arrays}
    if not path.name:
        raise InputError(f"{str(path)!r}: the name of a file is needed")
    part = path.with_name(f".{path.name}.{uuid.uuid4().hex}.part")
    try:
        try:
            with part.open("xb") as stream:
                np.savez(stream, **entries)  # type: ignore[arg-type]
                stream.flush()
                os.fsync(stream.fileno())
            part.replace(path)
        finally:
            part.unlink(missing_ok=True)
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from error


def load_problem(path: str | os.PathLike[str]) -> Loaded:
    """Read a problem, and the metadata beside it, from a file of `save_problem`.

    Returns
    -------
    Loaded
        ``(problem, metadata)``.

    Raises
    ------
    InputError
        If the file is missing, is no such file or damaged, has another version, names an unknown
        kind, or does not describe a valid problem.
    """
    path = Path(path)
    arrays = _entries(path)
    try:
        head = json.loads(bytes(arrays[ENTRY]).decode("utf-8"))
        found, version = head["format"], head["version"]
    except (KeyError, TypeError, ValueError, RecursionError) as error:
        raise InputError(f"{path}: not a problem file; its entry {ENTRY} cannot be read") from error
    if found != FORMAT:
        raise InputError(f"{path}: not a problem file; its format is {str(found)[:40]!r}")
    if version != VERSION or isinstance(version, bool):
        raise InputError(
            f"{path}: version {str(version)[:40]} of the format; this program reads {VERSION}"
        )
    try:
        tree, metadata = head["problem"], head["metadata"]
        parts = {name: decode(tree[name], arrays) for name in PARTS if name != "network"}
        network = _to_network(tree["network"], arrays)
        return Loaded(Problem(network=network, **parts), dict(metadata))
    except InputError as error:
        raise InputError(f"{path}: {error}") from error
    except (AttributeError, KeyError, TypeError, ValueError, RecursionError) as error:
        reason = " ".join(str(error).split())
        raise InputError(
            f"{path}: damaged, not a problem ({type(error).__name__}: {reason})"
        ) from error


def _entries(path: Path) -> dict[str, Any]:
    """Return all arrays of an archive; raise `InputError` if it is none."""
    try:
        with path.open("rb") as stream:
            if stream.read(2) != b"PK":  # how zip archives begin; numpy would guess on
                raise InputError(f"{path}: {OTHERS}")
            stream.seek(0)
            archive = np.load(stream, allow_pickle=False)
            return {name: archive[name] for name in archive.files}
    except FileNotFoundError as error:
        raise InputError(f"{path}: no such file; a file of save_problem is needed") from error
    except InputError:
        raise
    except Exception as error:
        # zipfile and numpy raise whatever damaged input happens to lead to
        reason = " ".join(str(error).split()) or type(error).__name__
        if "allow_pickle" in reason:  # objects of Python, which no problem file holds
            raise InputError(f"{path}: {OTHERS}") from error
        raise InputError(f"{path}: not a problem file, or damaged: {reason}") from error


def _from_network(network: Network, arrays: Arrays) -> dict[str, Any]:
    plain = network.names == tuple(map(str, range(network.vertices)))
    return {
        "indptr": encode(network.indptr, arrays),
        "indices": encode(network.indices, arrays),
        "names": None if plain else list(network.names),
        "source": network.source,
    }


def _to_network(tree: dict[str, Any], arrays: Arrays) -> Network:
    indptr, indices = (decode(tree[name], arrays) for name in ("indptr", "indices"))
    for name, array in (("indptr", indptr), ("indices", indices)):
        if array.dtype.kind not in "iu" or (array.size and not 0 <= array.max() < 2**31):
            raise InputError(f"{name} of the network: integers from 0 to 2^31 - 1 are needed")
    names = range(len(indptr) - 1) if tree["names"] is None else tree["names"]
    # that a graph looks the same from everywhere is no file's to vouch for
    return Network(indptr, indices, tuple(map(str, names)), str(tree["source"]))
