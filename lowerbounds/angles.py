"""A search over asymmetric couplings: it confirms the closed form's choice."""

from __future__ import annotations

import numpy as np

from ..graphs import InputError
from ..lpc.arrays import Floats
from .asymmetric import log_excess

STEP = 1e-6
MARGIN = 0.01  # of the angles, off 0 and pi/2, where nothing is passed on


def best_shares(a_T: float, k: int, seed: int = 0, starts: int = 1) -> tuple[float, ...]:
    """Return shares of (locally) largest bound, by quasi-Newton steps on the angles.

    The coupling ``(p x_t - q x_{t-1})^2`` has ``p = sqrt(a) sin(angle)``, ``q = sqrt(a)
    cos(angle)``, and the share ``P = sin(angle)^2``.

    Parameters
    ----------
    a_T : float
        ``l_T/mu > 0``.
    k : int
        Steps of look-ahead, ``>= 1``.
    seed : int
        Of the starts after the first, which is symmetric.
    starts : int
        How many.
    """
    from scipy.optimize import minimize

    if isinstance(k, bool) or int(k) != k or k < 1:
        raise InputError(f"k = {k}: an integer >= 1 is needed", "k")
    if not (np.isfinite(a_T) and a_T > 0):
        raise InputError(f"a_T = {a_T}: a finite number > 0 is needed", "l_T")
    m = k - 1
    if m == 0:
        return ()
    around = STEP * np.concatenate([np.eye(m), -np.eye(m), np.zeros((1, m))])

    def value(angles: Floats) -> tuple[float, Floats]:
        logs = log_excess(a_T, np.sin(angles + around) ** 2)
        slope: Floats = (logs[m : 2 * m] - logs[:m]) / (2 * STEP)
        return -float(logs[-1]), slope

    limits = [(MARGIN, np.pi / 2 - MARGIN)] * m
    rng = np.random.default_rng(seed)
    begin = [np.full(m, np.pi / 4), *rng.uniform(*limits[0], size=(starts - 1, m))]
    runs = [
        minimize(value, x, jac=True, method="L-BFGS-B", bounds=limits, tol=1e-15) for x in begin
    ]
    best = min(runs, key=lambda run: float(run.fun))
    return tuple((np.sin(best.x) ** 2).tolist())
