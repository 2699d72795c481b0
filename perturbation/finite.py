"""Finite perturbations: what the theorems speak of."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..lpc.arrays import Floats
from ..lpc.window import Window


@dataclass(frozen=True, eq=False)
class Moved:
    """How far a solution moves when its boundary does.

    Parameters
    ----------
    distance : ndarray, shape (m,)
        ``|psi(y', z') - psi(y, z)|`` of every free action, in the order of ``window.free``.
    noise : float
        What of it may be the error of the two solutions.
    """

    distance: Floats
    noise: float


def moved(
    window: Window,
    before: tuple[Floats, Floats],
    after: tuple[Floats, Floats],
    *,
    tolerance: float = 1e-12,
) -> Moved:
    """Solve a window at two boundary values ``(y, z)`` and return how far each action moves."""
    found = [window.solved(*values, tolerance=tolerance) for values in (before, after)]
    gap = window.ordered(found[1].x) - window.ordered(found[0].x)
    noise = float(sum(np.max(solved.error, initial=0.0) for solved in found))
    return Moved(np.sqrt((gap**2).sum(axis=1)), noise)
