"""The largest sensitivities by distance in time, distance in the network and boundary part."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..lpc.arrays import Floats, Ints
from .promised import TIERS, Promised
from .sensitivity import PARTS, Sensitivity

ROUNDING = 1e-9  # by which a measured value may exceed a bound before it is called a violation


@dataclass(frozen=True, eq=False)
class Cells:
    """The largest block norms of one instance, shape (3, k + 1, reach + 1).

    Axes: boundary part (in the order of `PARTS`), ``|t0 - tau|``, ``d(v0, u)``; NaN where the
    instance has no such pair.
    """

    largest: Floats

    @classmethod
    def of(cls, found: Sensitivity, distance: Ints, k: int, reach: int) -> Cells:
        """Return the cells of one instance.

        Parameters
        ----------
        found : Sensitivity
        distance : ndarray, shape (N, N)
            Of the agents of its problem.
        k, reach : int
            The prediction horizon, and the largest distance between two agents.
        """
        shape = (len(PARTS), k + 1, reach + 1)
        gaps = distance[found.free[:, 1]][:, found.fixed[:, 1]]
        part = np.broadcast_to(found.part, gaps.shape)
        place = np.ravel_multi_index((part, found.time_gaps, gaps), shape).ravel()
        largest = np.full(int(np.prod(shape)), -np.inf)
        np.maximum.at(largest, place, found.norms.ravel())
        return cls(np.where(largest < 0, np.nan, largest).reshape(shape))


@dataclass(frozen=True)
class Cell:
    """One line of a profile.

    Parameters
    ----------
    part : {"top", "bottom", "lateral"}
    dt, ds : int
        ``|t0 - tau|`` and ``d(v0, u)``.
    measured_max : float
        The largest sensitivity seen.
    instance : int
        The number of the instance it was seen in.
    bounds : dict
        What each tier promises.
    """

    part: str
    dt: int
    ds: int
    measured_max: float
    instance: int
    bounds: dict[str, float]

    def violated(self) -> tuple[str, ...]:
        """Return the tiers whose bound is exceeded by more than rounding explains."""
        limit = self.measured_max / (1 + ROUNDING)
        return tuple(tier for tier, bound in self.bounds.items() if limit > bound)


def profile(cells: Floats, promised: Promised) -> tuple[Cell, ...]:
    """Return the largest values over instances beside the bounds.

    Parameters
    ----------
    cells : ndarray, shape (instances, 3, k + 1, reach + 1)
        `Cells.largest` of every instance.
    promised : Promised
    """
    seen = np.any(~np.isnan(cells), axis=0)
    filled = np.where(np.isnan(cells), -np.inf, cells)
    which, largest = filled.argmax(axis=0), filled.max(axis=0)
    found = []
    for index, part in enumerate(PARTS):
        dt, ds = np.nonzero(seen[index])
        if not len(dt):
            continue
        bounds = promised.bounds(part, dt, ds)
        for j in range(len(dt)):
            at = (index, dt[j], ds[j])
            each = {tier: float(values[j]) for tier, values in bounds.items()}
            found.append(
                Cell(part, int(dt[j]), int(ds[j]), float(largest[at]), int(which[at]), each)
            )
    return tuple(found)


__all__ = ["PARTS", "TIERS", "Cell", "Cells", "profile"]
