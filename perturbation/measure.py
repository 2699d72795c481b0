"""Measured perturbation decay: random local problems of a network, beside the promises."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from ..graphs import InputError
from ..lpc.arrays import Floats
from ..lpc.store import Store
from .fit import Fit, fit
from .profile import Cell, profile
from .promised import TIERS, Promised
from .slices import Slices
from .spec import Spec
from .units import Runner

UNIT = 20  # instances computed and kept together
Progress = Callable[[int, int], None]


@dataclass(frozen=True, eq=False)
class Measurement:
    """Measured sensitivities beside what each theorem promises.

    Parameters
    ----------
    spec : Spec
    profiles : tuple of Cell
        The largest sensitivity to one boundary variable, for every part and distance.
    slices : Slices
        The largest sensitivity of a time slice to another, by distance.
    jumps : dict
        For each tier the largest ``moved / promised`` when a whole boundary jumps by a finite
        amount, see `jumps`: above 1 the bound is false.
    fit : Fit
        Rates of decay of the profiles.
    instances : int
        How many were measured.
    """

    spec: Spec
    profiles: tuple[Cell, ...]
    slices: Slices
    jumps: dict[str, float]
    fit: Fit
    instances: int

    @property
    def violations(self) -> tuple[tuple[str, Cell], ...]:
        """Every (tier, cell) whose bound is exceeded."""
        return tuple((tier, cell) for cell in self.profiles for tier in cell.violated())


@dataclass(frozen=True)
class Work:
    """One unit of a measurement, to be sent to a worker."""

    spec: Spec = field(repr=False)
    first: int
    last: int

    def __call__(self) -> Floats:
        """Return the cells of instances ``first..last-1``, padded with NaN to a whole unit."""
        rows = [self.spec.cells(i) for i in range(self.first, self.last)]
        whole = np.full((UNIT, len(rows[0])), np.nan)
        whole[: len(rows)] = rows
        return whole


def measure(
    spec: Spec,
    instances: int,
    *,
    runner: Runner | None = None,
    checkpoint: str | Path | None = None,
    progress: Progress | None = None,
) -> Measurement:
    """Measure random instances.

    Parameters
    ----------
    spec : Spec
    instances : int
        How many, at least 1.
    runner : Runner, optional
        Who computes them; the numbers do not depend on it.
    checkpoint : path, optional
        A file that keeps every completed unit, and from which an interrupted run goes on.
    progress : callable, optional
        Called as ``progress(done, total)`` with instances.

    Raises
    ------
    InputError
        If an argument cannot be used, or the checkpoint is of another measurement.
    """
    if isinstance(instances, bool) or int(instances) != instances or instances < 1:
        raise InputError(f"instances = {instances}: an integer >= 1 is needed", "instances")
    starts = range(0, instances, UNIT)
    works = [Work(spec, first, min(first + UNIT, instances)) for first in starts]
    width = spec.width
    rows = np.empty((len(works), UNIT, width))
    with Store(checkpoint, "measurement", spec.identity(), UNIT * width) as store:
        missing = [j for j in range(len(works)) if not store.load(j, rows[j], works[j].last)]
        done = instances - sum(works[j].last - works[j].first for j in missing)
        runner = Runner() if runner is None else runner
        for j, found in runner.run({j: works[j] for j in missing}):
            rows[j] = found
            store.save(j, found, works[j].last)
            done += works[j].last - works[j].first
            if progress is not None:
                progress(done, instances)
    flat = rows.reshape(-1, width)[:instances]
    first = int(np.prod(spec.shape))
    cells = flat[:, :first].reshape(-1, *spec.shape)
    last = first + spec.k
    return Measurement(
        spec,
        profile(cells, Promised(spec.parameters, spec.growth)),
        Slices.of(flat[:, first:last], spec.parameters),
        dict(zip(TIERS, flat[:, last:].max(axis=0).tolist(), strict=True)),
        fit(cells, spec.seed),
        instances,
    )
