"""Finite perturbations of a whole boundary, against the sums that the theorems promise."""

from __future__ import annotations

import numpy as np

from ..lpc.arrays import Floats, Ints
from ..lpc.local import LocalProblem
from .promised import TIERS, Promised
from .sensitivity import PARTS, Sensitivity

NOISE = 1e-9  # of the size of a perturbation: smaller movements are not told from errors


def tables(promised: Promised, k: int, reach: int) -> Floats:
    """Return every bound by tier, part, ``|t0 - tau|`` and distance; NaN where there is none.

    Shape (3, 3, k + 1, reach + 1), in the order of `TIERS` and `PARTS`.
    """
    found = np.full((len(TIERS), len(PARTS), k + 1, reach + 1), np.nan)
    for index, part in enumerate(PARTS):
        first = (0, 1) if part == "lateral" else (1, 0)
        dt, ds = np.meshgrid(
            np.arange(first[0], k + 1), np.arange(first[1], reach + 1), indexing="ij"
        )
        bounds = promised.local(part, dt, ds)
        for row, tier in enumerate(TIERS):
            found[row, index, first[0] :, first[1] :] = bounds[tier]
    return found


def jumps(
    window: LocalProblem,
    found: Sensitivity,
    values: tuple[Floats, Floats],
    distance: Ints,
    bounds: Floats,
    rng: np.random.Generator,
) -> Floats:
    """Move the whole boundary at random, and return the largest ``moved / promised``, shape (3,).

    The definition of a local perturbation bound sums over the boundary: with ``delta`` the
    perturbation, ``|psi(y', z') - psi(y, z)|_{(t0, v0)} <= sum_j bound_j |delta_j|``. The ratio is
    the largest over the free actions (t0, v0), one a tier.

    Parameters
    ----------
    window : LocalProblem
    found : Sensitivity
        At the boundary values before.
    values : (y, z)
        Those values.
    distance : ndarray, shape (N, N)
        Of the agents of its problem.
    bounds : ndarray
        `tables`.
    rng : Generator
        Of the perturbation, whose size is that of a standard normal in every boundary variable
        times a number between 1e-3 and 10.

    References
    ----------
    Paper, Definition 3.1 (``thm:networked-exp-decay:meta``).
    """
    size = 10 ** rng.uniform(-3, 1)
    steps = [size * rng.normal(size=part.shape) for part in values]
    after = window.solved(*(a + b for a, b in zip(values, steps, strict=True)), tolerance=1e-13).x
    moved = np.sqrt(((after - found.x) ** 2).sum(axis=1))
    delta = np.sqrt((window.fixed(steps[0], steps[1]) ** 2).sum(axis=1))
    gaps = distance[found.free[:, 1]][:, found.fixed[:, 1]]
    part = np.broadcast_to(found.part, gaps.shape)
    limit = bounds[:, part, found.time_gaps, gaps] @ delta
    above = np.maximum(moved - NOISE * size, 0.0)
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.where(above > 0, above / limit, 0.0)
    return np.asarray(ratio.max(axis=1))
