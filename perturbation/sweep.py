"""Measurements over many networks and parameters."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Callable, Iterable
from os import PathLike
from pathlib import Path

from ..graphs import InputError
from .measure import Measurement, measure
from .spec import Spec
from .units import Runner

Progress = Callable[[int, int], None]


def sweep(
    specs: Iterable[Spec],
    instances: int,
    *,
    runner: Runner | None = None,
    folder: str | PathLike[str] | None = None,
    progress: Progress | None = None,
) -> tuple[Measurement, ...]:
    """Measure the same number of instances of every spec.

    Parameters
    ----------
    specs : iterable of Spec
        Networks, classes, k and r; each has its own seed, which its `Measurement` keeps.
    instances : int
        Of each, at least 1.
    runner : Runner, optional
        Who computes them: cores, or a Dask cluster; the numbers do not depend on it.
    folder : path, optional
        Keeps one file a spec, named after what it is of. A sweep that is begun again, also with
        more specs or more instances, computes only what is missing.
    progress : callable, optional
        Called as ``progress(done, total)`` with the instances of all specs.

    Raises
    ------
    InputError
        If an argument cannot be used, or the folder cannot be made.
    """
    chosen = list(specs)
    if folder is not None:
        try:
            Path(folder).mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise InputError(f"folder {folder}: {error.strerror or error}", "folder") from error
    found = []
    for j, spec in enumerate(chosen):

        def shown(done: int, total: int, before: int = j * instances) -> None:
            if progress is not None:
                progress(before + done, len(chosen) * instances)

        kept = None if folder is None else Path(folder) / f"{name(spec)}.measurements"
        found.append(measure(spec, instances, runner=runner, checkpoint=kept, progress=shown))
    return tuple(found)


def name(spec: Spec) -> str:
    """Return a name for the file of a spec: equal ones have the same."""
    text = json.dumps(spec.identity(), sort_keys=True)
    return hashlib.sha256(text.encode()).hexdigest()[:24]
