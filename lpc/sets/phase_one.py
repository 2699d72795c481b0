"""Points deep within convex sets: minimise the largest constraint."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from ..arrays import Floats
from ..damped import descend

Flags = NDArray[np.bool_]
Constraints = Callable[[Floats], tuple[Floats, Floats, Floats]]
ROUNDS = 14
SHARPEN = 0.2
DEEP = -1.0  # no deeper point is looked for


def deepest(constraints: Constraints, m: int, n: int) -> tuple[Floats, Floats]:
    """Return points near the minima of ``max_j g_j(y)``, for m sets at once.

    The maximum is smoothed to ``s log sum_j exp(g_j/s)``, which is convex, in C^2 and off by at
    most ``s log p``; s falls from the size of the constraints at the origin in `ROUNDS` rounds.
    A set is left alone where its point has ``max g <= DEEP``.

    Parameters
    ----------
    constraints : callable
        From points (m, n) to g (m, p), its gradients (m, p, n) and Hessians (m, p, n, n).
    m, n : int

    Returns
    -------
    y : ndarray, shape (m, n)
    top : ndarray, shape (m,)
        The largest constraint there.
    """
    y = np.zeros((m, n))
    with np.errstate(all="ignore"):
        g = constraints(y)[0]
        top = g.max(axis=1, initial=-np.inf)
        size = np.where(np.isfinite(g), np.abs(g), 0.0).max(axis=1, initial=0.0)
        sharpness = np.maximum(size, 1e-3)
        for _ in range(ROUNDS):
            if (top <= DEEP).all():
                break
            resting = top <= DEEP

            def smooth(
                z: Floats, s: Floats = sharpness, rest: Flags = resting
            ) -> tuple[Floats, Floats, Floats]:
                value, slope, bend = _smooth(constraints(z), s)
                # enough is enough: an unbounded set has no deepest point
                blocked = np.logical_or(rest, value < 10 * DEEP - s)
                return np.where(blocked, np.inf, value), slope, bend

            start = y
            y = descend(smooth, start, 25)
            found = constraints(y)[0].max(axis=1, initial=-np.inf)
            worse = ~(found < top)
            y = np.where(worse[:, None] & (top < 0)[:, None], start, y)
            top = np.where(worse & (top < 0), top, found)
            sharpness = SHARPEN * sharpness
    return y, top


def _smooth(constraints: tuple[Floats, Floats, Floats], s: Floats) -> tuple[Floats, Floats, Floats]:
    """Return ``s log sum exp(g/s)`` with its gradient and Hessian."""
    g, slope, bend = constraints
    top = g.max(axis=1, initial=-1e300)
    weight = np.exp((g - top[:, None]) / s[:, None])
    total = weight.sum(axis=1)
    share = weight / total[:, None]
    value = top + s * np.log(total)
    mean = (share[:, None, :] @ slope)[:, 0]
    off = slope - mean[:, None, :]
    spread = (share[:, :, None] * off).swapaxes(1, 2) @ off
    curved = (share[:, :, None, None] * bend).sum(axis=1)
    return value, mean, curved + spread / s[:, None, None]
