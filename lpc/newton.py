"""Damped Newton steps on many small convex functions at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .arrays import Floats

Functions = Callable[[Floats], tuple[Floats, Floats, Floats]]


def minimise(functions: Functions, start: Floats, limit: int) -> Floats:
    """Return points near the minimisers of m convex functions of R^s, shape (m, s).

    Each takes steps ``w - a (H + e I)^-1 g``, e a trifle of the trace of H, with a halved until
    the value falls by a tenth of what the quadratic model says.

    Parameters
    ----------
    functions : callable
        From points of shape (m, s) to values (m,), gradients (m, s) and Hessians (m, s, s).
    start : ndarray, shape (m, s)
    limit : int
        The number of steps.
    """
    w = np.array(start, dtype=np.float64)
    value, slope, bend = functions(w)
    eye = np.eye(w.shape[1])
    for _ in range(limit):
        trifle = 1e-12 * np.trace(bend, axis1=1, axis2=2) + np.finfo(float).tiny
        step = -np.linalg.solve(bend + trifle[:, None, None] * eye, slope[:, :, None])[:, :, 0]
        fall = np.maximum(-(slope * step).sum(axis=1), 0.0)
        size = np.ones(len(w))
        for _ in range(40):
            trial = functions(w + size[:, None] * step)[0]
            worse = ~(trial <= value - 0.1 * size * fall)
            if not worse.any():
                break
            size = np.where(worse, size / 2, size)
        w = w + np.where(worse, 0.0, size)[:, None] * step
        value, slope, bend = functions(w)
        if worse.all():
            break
    return w
