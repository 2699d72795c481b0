"""Lower bounds in time against policies that are optimal by brute force: one agent."""

import numpy as np
import pytest

from nearsight.bounds.lower import final_excess, temporal_excess


def agent(a, H):
    """Hessian of ``sum (x_t - theta_t)^2/2 + (a/4)(x_t - x_{t-1})^2`` with ``x_0 = 0``."""
    M = np.diag(np.full(H, 1 + a)) - a / 2 * (np.eye(H, k=1) + np.eye(H, k=-1))
    M[-1, -1] -= a / 2
    return M


def best_policy(a, k, H):
    """Expected excess and expected OPT of the optimal policy that sees k steps.

    The costs are quadratic, so it plans with the targets it does not see at their mean 0:
    the closed loop ``x_t = first action of argmin``, target by target.
    """
    M = agent(a, H)
    theta, actions = np.eye(H), np.zeros((H, H))
    for t in range(H):
        right = theta[t:] * (np.arange(H) < t + k)  # seen: theta_1 .. theta_{t+k-1}
        if t:
            right[0] += a / 2 * actions[t - 1]
        actions[t] = np.linalg.solve(M[t:, t:], right)[0]
    optimum = np.linalg.inv(M)
    off = np.linalg.cholesky(M).T @ (actions - optimum)
    return 0.5 * np.sum(off**2), 0.5 * np.trace(np.eye(H) - optimum)


@pytest.mark.parametrize("a", [0.05, 0.6, 4.0])
@pytest.mark.parametrize("k", [1, 2, 4])
def test_temporal_bound_is_what_the_best_policy_pays(a, k):
    # the ends of the horizon cancel between two horizons
    (short, opt_short), (long, opt_long) = best_policy(a, k, 80), best_policy(a, k, 110)
    slope = (long - short) / (opt_long - opt_short)
    assert slope == pytest.approx(temporal_excess(a, k), rel=1e-7)
    # the ratio itself is off by what the ends add, like 1/H
    off = [abs(z / temporal_excess(a, k) - 1) for z in (short / opt_short, long / opt_long)]
    assert off[1] < off[0] < 0.2
    assert off[1] * 110 == pytest.approx(off[0] * 80, rel=0.1)


@pytest.mark.parametrize("a", [0.05, 0.6, 4.0])
@pytest.mark.parametrize("k", [1, 2, 4])
def test_bound_from_the_last_target_alone(a, k):
    # only theta_H is random: its column of the best policy, which is blind to it until H - k + 1
    H = 120
    M = agent(a, H)
    source = np.zeros(H)
    source[-1] = 1
    optimum = np.linalg.solve(M, source)
    policy = np.zeros(H)
    policy[-k:] = np.linalg.solve(M[-k:, -k:], source[-k:])
    off = policy - optimum
    ratio = (off @ M @ off) / (1 - optimum[-1])
    assert ratio == pytest.approx(final_excess(a, k), rel=1e-9)
    assert 2 * temporal_excess(a, k) < ratio < 4 * temporal_excess(a, k)


@pytest.mark.parametrize(("a", "k", "H"), [(0.6, 2, 6), (3.0, 1, 5), (3.0, 3, 7)])
def test_no_linear_policy_beats_the_best_one(a, k, H):
    # all matrices K with K[t, s] = 0 for s >= t + k, by least squares over all entries at once
    M = agent(a, H)
    root, inverse = np.linalg.cholesky(M).T, np.linalg.inv(M)
    entries = [(t, s) for t in range(H) for s in range(H) if s < t + k]
    columns = np.zeros((H * H, len(entries)))
    for i, (t, s) in enumerate(entries):
        columns[np.arange(H) * H + s, i] = root[:, t]
    left = (root @ inverse).ravel()
    best = np.linalg.lstsq(columns, left, rcond=None)[0]
    excess = 0.5 * np.sum((columns @ best - left) ** 2)
    assert best_policy(a, k, H)[0] == pytest.approx(excess, rel=1e-9)
