"""Units of work, one after the other, on the cores of this machine, or on a cluster."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from ..graphs import InputError
from ..lpc.arrays import Floats

Unit = Callable[[], Floats]


@dataclass(frozen=True)
class Runner:
    """Compute independent units; what they return does not depend on who computes them.

    Parameters
    ----------
    workers : int
        Processes of this machine, by joblib; 1 computes here, 0 stands for one a core.
    cluster : str, optional
        Address of a Dask scheduler (``"tcp://host:8786"``), which then does the work.

    Raises
    ------
    InputError
        If the number is negative, or joblib or Dask is needed and missing.
    """

    workers: int = 1
    cluster: str | None = None

    def __post_init__(self) -> None:
        if isinstance(self.workers, bool) or int(self.workers) != self.workers or self.workers < 0:
            raise InputError(f"workers = {self.workers}: an integer >= 0 is needed", "workers")
        if self.workers == 0:
            object.__setattr__(self, "workers", os.cpu_count() or 1)

    def run(self, units: Mapping[int, Unit]) -> Iterator[tuple[int, Floats]]:
        """Yield ``(key, result)`` of every unit, in the order in which they are done."""
        if self.cluster is not None:
            yield from _on_cluster(self.cluster, units)
        elif self.workers == 1 or len(units) < 2:
            for key, unit in units.items():
                yield key, unit()
        else:
            yield from _on_cores(self.workers, units)


def _compute(key: int, unit: Unit) -> tuple[int, Floats]:
    return key, unit()


def _on_cores(workers: int, units: Mapping[int, Unit]) -> Iterator[tuple[int, Floats]]:
    try:
        from joblib import Parallel, delayed
    except ImportError as error:
        raise InputError(
            "workers > 1 need joblib: pip install joblib (the extra parallel)", "workers"
        ) from error
    # one thread of linear algebra in every process
    parallel = Parallel(n_jobs=workers, return_as="generator_unordered", inner_max_num_threads=1)
    yield from parallel(delayed(_compute)(key, unit) for key, unit in units.items())


def _on_cluster(address: str, units: Mapping[int, Unit]) -> Iterator[tuple[int, Floats]]:
    try:
        from distributed import Client, as_completed
    except ImportError as error:
        text = "a cluster needs Dask: pip install 'dask[distributed]' (the extra parallel)"
        raise InputError(text, "cluster") from error
    try:
        client = Client(address, timeout="10s")
    except (OSError, ValueError) as error:
        raise InputError(
            f"cluster {address!r}: no Dask scheduler answers there ({error})", "cluster"
        ) from error
    with client:
        futures = [client.submit(_compute, key, unit, pure=False) for key, unit in units.items()]
        for future in as_completed(futures):
            yield future.result()
            future.release()
