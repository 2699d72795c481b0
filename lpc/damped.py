"""Damped Newton steps for many small convex functions at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from .arrays import Floats

Objective = Callable[[Floats], tuple[Floats, Floats, Floats]]


def descend(objective: Objective, start: Floats, steps: int = 60) -> Floats:
    """Return points near the minima of m functions, none of them higher than its start.

    Each step solves ``(H + d I) p = -g``; d falls after a descent and grows after a failure, so
    that flat, linear and badly scaled functions are treated as well as curved ones. Negative
    eigenvalues of H, which a convex function has not, count as 0.

    Parameters
    ----------
    objective : callable
        From points (m, n) to values (m,), gradients (m, n) and Hessians (m, n, n). Values that
        are not finite count as higher than all others.
    start : ndarray, shape (m, n)
    steps : int
        How many steps are tried, at most.

    Returns
    -------
    ndarray, shape (m, n)
    """
    y = np.array(start, dtype=np.float64)
    m, n = y.shape
    identity = np.eye(n)
    damping = np.full(m, 1e-3)
    with np.errstate(all="ignore"):
        F, g, H = objective(y)
        for _ in range(steps):
            flat = _length(g) / (1 + _length(y))  # for functions without curvature
            scale = np.abs(H).max(axis=(1, 2), initial=0.0) + flat
            shift = np.maximum(damping * scale, np.finfo(float).tiny)
            usable = np.isfinite(H).all(axis=(1, 2)) & np.isfinite(g).all(axis=1)
            usable &= (scale > 0) & (damping < 1e12)
            if not usable.any():
                break
            bends, axes = np.linalg.eigh(np.where(usable[:, None, None], H, identity))
            turned = (g[:, None, :] @ axes)[:, 0] / (np.maximum(bends, 0.0) + shift[:, None])
            trial = y - (axes @ turned[:, :, None])[:, :, 0]
            F_new, g_new, H_new = objective(trial)
            better = usable & (F_new < F)
            y = np.where(better[:, None], trial, y)
            g = np.where(better[:, None], g_new, g)
            H = np.where(better[:, None, None], H_new, H)
            F = np.where(better, F_new, F)
            damping = np.where(better, np.maximum(0.1 * damping, 1e-14), 10 * damping)
    return y


def _length(y: Floats) -> Floats:
    """Return the Euclidean norms of rows, without overflow."""
    found: Floats = np.hypot.reduce(np.abs(y), axis=1)
    return found
