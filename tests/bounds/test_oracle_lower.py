"""Lower bounds against policies that are optimal by brute force, and against certificates."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.bounds.lower import (
    best_excess,
    final_excess,
    spatial_excess,
    temporal_excess,
)
from nearsight.graphs import parse_growth

FAMILIES = ["line", "grid2", "ring-of-blocks:2", "ring-of-blocks:3"]


@cache
def growth(family):
    return parse_growth(family)


# -- in time: one agent, independent targets ------------------------------------------------


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


# -- in space: a long ring of blocks in extended precision ----------------------------------


def exactly(strength, d, r, blocks):
    """The bound on ``CR - 1`` by its definition, dense, on the quotient of the ring.

    Classes: vertex j, the other d - 1 of its block, then one class for each other block;
    a class function y solves ``(1 + 2 d l) y - l sum over neighbours = e_j``, l the strength.
    """
    others = list(range(1, blocks))
    classes = ["j", *(["own"] if d > 1 else []), *others]

    def solve(kept):
        M = mp.matrix(len(kept), len(kept))
        for i, here in enumerate(kept):
            M[i, i] = 1 + 2 * d * strength
            for m, there in enumerate(kept):
                block = [0 if c in ("j", "own") else c for c in (here, there)]
                if (block[0] - block[1]) % blocks in (1, blocks - 1):
                    M[i, m] -= strength * {"j": 1, "own": d - 1}.get(there, d)
        return mp.lu_solve(M, mp.matrix([1] + [0] * (len(kept) - 1)))[0]

    def seen(c):
        return c == "j" or (c == "own" and r >= 2) or (c != "own" and min(c, blocks - c) <= r)

    whole, ball = solve(classes), solve([c for c in classes if seen(c)])
    return (whole - ball) / (1 - whole)


@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("r", [1, 2, 3])
@pytest.mark.parametrize(("x", "blocks"), [(0.01, 16), (0.8, 26), (6.0, 56)])
def test_spatial_bound_to_twelve_digits(d, r, x, blocks):
    a_S = x / (2 * d)
    with mp.workdps(60):
        exact = exactly(mpf(a_S) / 2, d, r, blocks)
        longer = exactly(mpf(a_S) / 2, d, r, blocks + 6)
        assert abs(longer / exact - 1) < mpf(10) ** -14  # N is large enough
        assert abs(spatial_excess(a_S, d, r) / exact - 1) < 1e-12


def test_spatial_bound_does_not_subtract():
    x, d, r = 0.01, 1, 6
    with mp.workdps(60):
        exact = exactly(mpf(x) / 4, d, r, 30)
    assert spatial_excess(x / 2, d, r) == pytest.approx(float(exact), rel=1e-12)
    # the definition in floats: nothing is left
    M = np.eye(41) * (1 + x / 2) - x / 4 * (np.eye(41, k=1) + np.eye(41, k=-1))
    M[0, -1] = M[-1, 0] = -x / 4
    ball = slice(20 - r, 21 + r)
    gap = np.linalg.inv(M)[20, 20] - np.linalg.inv(M[ball, ball])[r, r]
    assert abs(gap) < 1e-15
    assert 1e-40 < exact < 1e-20


def test_quotient_is_the_ring():
    # the dense matrix of all vertices, 7 blocks of 3: whole ring and the ball of radius 2
    d, N, strength, r = 3, 7, mpf("0.21"), 2
    block = np.repeat(np.arange(N), d)
    apart = np.minimum((block[:, None] - block) % N, (block - block[:, None]) % N)
    kept = np.flatnonzero(apart[0] <= r)
    with mp.workdps(40):
        values = []
        for chosen in (np.arange(N * d), kept):
            M = mp.matrix(len(chosen), len(chosen))
            for i, u in enumerate(chosen):
                for m, w in enumerate(chosen):
                    joined = strength * int(apart[u, w] == 1)
                    M[i, m] = 1 + 2 * d * strength if u == w else -joined
            values.append((M**-1)[0, 0])
        direct = (values[0] - values[1]) / (1 - values[0])
        assert abs(exactly(strength, d, r, N) / direct - 1) < mpf(10) ** -25


# -- the sandwich: lower bound <= certificate -----------------------------------------------

K, R = np.arange(2, 41), np.arange(1, 31)
strengths = st.floats(-2.5, 1.5).map(lambda e: 10.0**e)


def setting(family, a, a_S, k, r, l_f=1.0, unconstrained=True):
    return Setting(Parameters(1.0, l_f, a, a_S), growth(family), k, r, unconstrained=unconstrained)


def certified(s):
    """The least sharp bound on ``CR - 1`` that applies, infinite where there is none."""
    least = np.inf
    for bound in bounds_for("nearsight:sharp-cr"):
        if bound.variant == "vi" or s.unconstrained:
            value = bound.evaluate(s).values["cr_minus_one"]
            value = np.inf if value is None else np.asarray(value)
            least = np.minimum(least, np.where(np.isnan(value), np.inf, value))
    return least


def test_lower_bounds_agree_with_one_another():
    s = setting("ring-of-blocks:2", 0.3, 0.1, K[:, None], R)
    temporal, spatial, both = (
        bounds_for(label)[-1].evaluate(s).values["cr_minus_one"]
        for label in (
            "nearsight:temporal-lower-bound",
            "nearsight:ring-of-blocks",
            "thm:bottleneck",
        )
    )
    np.testing.assert_array_equal(np.maximum(temporal, spatial), both)


@settings(max_examples=25)
@given(family=st.sampled_from(FAMILIES), a=strengths, x=strengths)
def test_lower_bound_is_below_the_certificate(family, a, x):
    s = setting(family, a, x / growth(family).max_degree, K[:, None], R)
    lower = [
        np.asarray(bound.evaluate(s).values["cr_minus_one"])
        for label in (
            "thm:bottleneck",
            "nearsight:temporal-lower-bound",
            "nearsight:ring-of-blocks",
        )
        for bound in bounds_for(label)
        if bound.tier != "stated"
    ]
    assert len(lower) == 4
    upper = certified(s)
    assert np.isfinite(upper).any()
    for values in lower:
        assert np.all(values > 0)
        assert np.all(values <= upper)


@pytest.mark.parametrize("family", FAMILIES)
def test_the_sandwich_is_not_empty(family):
    # the two sides come as near as a small factor, so that each would catch a slip of the other
    a_S = 0.05 / growth(family).max_degree
    s = setting(family, 0.5, a_S, K[:8, None], R[:6])
    time = certified(s) / np.asarray(best_excess(0.5, a_S, growth(family).max_degree, s.k, s.r))
    assert 1 <= time.min() < 30


# -- resource augmentation ------------------------------------------------------------------


@pytest.mark.parametrize("unconstrained", [True, False])
@pytest.mark.parametrize(
    ("family", "a", "x", "k", "r"),
    [
        ("line", 1.0, 1.0, 3, 2),
        ("line", 0.1, 5.0, 2, 4),
        ("line", 6.0, 0.2, 5, 1),
        ("grid2", 0.5, 0.5, 2, 1),
        ("grid2", 1.0, 0.1, 3, 3),
        ("ring-of-blocks:2", 0.3, 2.0, 2, 2),
        ("ring-of-blocks:3", 2.0, 1.0, 4, 2),
    ],
)
def test_augmentation_is_the_least_that_suffices(family, a, x, k, r, unconstrained):
    a_S = x / growth(family).max_degree
    (bound,) = (b for b in bounds_for("coro:resource-augmentation") if b.tier == "sharp")
    found = bound.evaluate(setting(family, a, a_S, k, r, 1.5, unconstrained)).values
    target = max(final_excess(a, k), spatial_excess(a_S, growth(family).max_degree // 2, r))
    assert found["excess"] == pytest.approx(target, rel=1e-12)
    kk, rr = found["k_needed"], found["r_needed"]
    total = kk + rr
    ks, rs = np.arange(2, total), np.arange(1, total - 1)
    upper = certified(setting(family, a, a_S, ks[:, None], rs, 1.5, unconstrained))
    assert upper[kk - 2, rr - 1] <= found["excess"]
    smaller = (ks[:, None] + rs < total) | ((ks[:, None] + rs == total) & (ks[:, None] < kk))
    assert np.all(upper[smaller] > found["excess"])
