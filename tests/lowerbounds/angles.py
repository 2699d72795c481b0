"""A search over asymmetric couplings: it confirms the closed form's choice."""

import numpy as np
from scipy.optimize import minimize

from nearsight.lowerbounds.asymmetric import log_excess

STEP = 1e-6
MARGIN = 0.01  # of the angles, off 0 and pi/2, where nothing is passed on


def best_shares(a_T, k, seed, starts):
    """Shares of (locally) largest bound, by quasi-Newton steps on the angles.

    The coupling (p x_t - q x_{t-1})^2 has p = sqrt(a) sin(angle), q = sqrt(a) cos(angle), and the
    share sin(angle)^2. The first start is symmetric, the others are random.
    """
    m = k - 1
    around = STEP * np.concatenate([np.eye(m), -np.eye(m), np.zeros((1, m))])

    def value(angles):
        logs = log_excess(a_T, np.sin(angles + around) ** 2)
        return -float(logs[-1]), -(logs[:m] - logs[m : 2 * m]) / (2 * STEP)

    limits = [(MARGIN, np.pi / 2 - MARGIN)] * m
    rng = np.random.default_rng(seed)
    begin = [np.full(m, np.pi / 4), *rng.uniform(*limits[0], size=(starts - 1, m))]
    runs = [
        minimize(value, x, jac=True, method="L-BFGS-B", bounds=limits, tol=1e-15) for x in begin
    ]
    best = min(runs, key=lambda run: float(run.fun))
    return tuple((np.sin(best.x) ** 2).tolist())
