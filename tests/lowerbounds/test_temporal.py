"""One agent: closed forms against dense matrices, intervals, asymmetric couplings."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from nearsight.bounds.lower import final_excess, temporal_excess
from nearsight.graphs import InputError, parse_graph
from nearsight.lowerbounds import Asymmetric, Temporal, asymmetric, asymmetric_excess
from nearsight.lpc import optimum, simulate
from nearsight.lpc.constants import constants

from .angles import best_shares

PAIR = parse_graph("path:2")


def chain(a, H):
    M = mp.matrix(H, H)
    for i in range(H):
        M[i, i] = 1 + mpf(a) - (mpf(a) / 2 if i == H - 1 else 0)
        if i:
            M[i, i - 1] = M[i - 1, i] = -mpf(a) / 2
    return M


@pytest.mark.parametrize("a", [1e-5, 0.6, 40.0, 1e6])
@pytest.mark.parametrize(("k", "H"), [(1, 1), (1, 4), (2, 6), (4, 7), (5, 3)])
def test_closed_forms_in_extended_precision(a, k, H):
    found = Temporal(a, k, H)
    with mp.workdps(80):
        M = chain(a, H)
        B = M**-1
        for tau in range(1, H + 1):
            first = max(1, tau - k + 1) - 1
            part = mp.matrix([[M[i, j] for j in range(first, H)] for i in range(first, H)])
            team = B[tau - 1, tau - 1] - (part**-1)[tau - 1 - first, tau - 1 - first]
            if tau <= k:
                assert found.excess[tau - 1] == 0
            else:
                assert abs(found.excess[tau - 1] / team - 1) < 1e-12
            assert abs(found.optimal[tau - 1] / (1 - B[tau - 1, tau - 1]) - 1) < 1e-12


@pytest.mark.parametrize("a", [0.05, 0.6, 4.0])
@pytest.mark.parametrize("k", [1, 3])
def test_limits(a, k):
    assert Temporal(a, k, 300).cr_minus_one == pytest.approx(final_excess(a, k), rel=1e-12)
    assert Temporal(a, k, 300).step == 300
    long, longer = (Temporal(a, k, H) for H in (1000, 2000))
    slope = (longer.excess.sum() - long.excess.sum()) / (longer.optimal.sum() - long.optimal.sum())
    assert slope == pytest.approx(temporal_excess(a, k), rel=1e-9)
    assert long.limit == final_excess(a, k)
    assert long.long_run == temporal_excess(a, k)


def play(a, k, theta):
    """The best policy, step by step: plan with mean 0 for what is not seen."""
    H = len(theta)
    M = np.array(chain(a, H).tolist(), dtype=float)
    x = np.zeros(H)
    for t in range(H):
        right = np.where(np.arange(t, H) < t + k, theta[t:], 0.0)
        right[0] += a / 2 * x[t - 1] if t else 0.0
        x[t] = np.linalg.solve(M[t:, t:], right)[0]
    return x


@pytest.mark.parametrize(("a", "k", "H"), [(0.5, 1, 5), (3.0, 2, 6)])
def test_an_interval_changes_nothing(a, k, H):
    # all 2^H targets at the ends of D: the best policy and the optimum stay within D, and their
    # mean costs are the closed forms
    signs = np.array(np.meshgrid(*[[-1.0, 1.0]] * H)).reshape(H, -1).T
    found = Temporal(a, k, H)
    M = np.array(chain(a, H).tolist(), dtype=float)
    excess, optimal = 0.0, 0.0
    for theta in signs:
        x, best = play(a, k, theta), np.linalg.solve(M, theta)
        assert max(np.abs(x).max(), np.abs(best).max()) <= 1
        excess += (x - best) @ M @ (x - best) / len(signs)
        optimal += theta @ (theta - best) / len(signs)
    assert found.excess.sum() == pytest.approx(excess, rel=1e-10)
    assert found.optimal.sum() == pytest.approx(optimal, rel=1e-10)


@pytest.mark.parametrize("interval", [None, (0.0, 1.0)])
def test_lpc_pays_the_bound(interval):
    found = Temporal(1.3, 2, 8)
    problem = found.problem(mu=0.5, interval=interval, network=PAIR)
    run = simulate(problem, 2, 1, tolerance=1e-12)
    assert run.ratio_minus_one >= found.cr_minus_one * (1 - 1e-6)
    assert constants(problem).l_T.value == pytest.approx(0.65)
    if interval:
        assert optimum(problem).x.min() >= 0.5 - 1e-9


# -- asymmetric couplings -------------------------------------------------------------------


@pytest.mark.parametrize(
    ("k", "a", "value"), [(2, 10, 2.4569), (2, 1, 1.0505), (3, 1, 1.00354), (3, 10, 1.4407)]
)
def test_known_values(k, a, value):
    assert 1 + asymmetric_excess(float(a), k) == pytest.approx(value, abs=5e-5)


def test_one_step_of_look_ahead():
    assert asymmetric_excess(0.3, 1) == 0.3
    assert asymmetric(0.3, 1).cr_minus_one == pytest.approx(0.3, rel=1e-15)


@pytest.mark.parametrize("a", [1e-4, 0.3, 5.0, 1e5])
@pytest.mark.parametrize("k", [2, 3, 6])
def test_closed_form_by_elimination_in_extended_precision(a, k):
    shares = asymmetric(a, k).shares
    with mp.workdps(80):
        A = mpf(a)
        share = 1 / (1 + mp.sqrt((1 + 2 * A) / (1 + A)))
        P = [A * share, *[A / 2] * (k - 2)]
        M = mp.eye(k)
        for t, p in enumerate(P):
            q = A - p
            M[t, t] += q
            M[t + 1, t + 1] += p
            M[t, t + 1] = M[t + 1, t] = -mp.sqrt(p * q)
        part = mp.matrix([[M[i, j] for j in range(1, k)] for i in range(1, k)])
        free, held = (M**-1)[k - 1, k - 1], (part**-1)[k - 2, k - 2]
        exact = (1 + A * free) / (1 + A * held) - 1
        assert abs(asymmetric_excess(a, k) / exact - 1) < 1e-13
        assert abs(Asymmetric(a, shares).cr_minus_one / exact - 1) < 1e-11


@pytest.mark.parametrize("a", [0.05, 1.0, 20.0])
@pytest.mark.parametrize("k", [2, 3, 5])
def test_no_search_finds_better_angles(a, k):
    found = Asymmetric(a, best_shares(a, k, seed=3, starts=5)).cr_minus_one
    assert found == pytest.approx(asymmetric_excess(a, k), rel=1e-9)


@given(
    a=st.floats(-3, 3).map(lambda e: 10.0**e),
    shares=st.lists(st.floats(0.01, 0.99), max_size=6),
)
def test_no_shares_do_better(a, shares):
    found = Asymmetric(a, tuple(shares)).cr_minus_one
    assert found <= asymmetric_excess(a, len(shares) + 1) * (1 + 1e-9)


@pytest.mark.parametrize("a", [1e-3, 1.0, 50.0])
def test_it_is_above_the_symmetric_bound(a):
    for k in range(1, 30):
        assert asymmetric_excess(a, k) >= 2 * final_excess(a, k)
    rate = asymmetric_excess(a, 41) / asymmetric_excess(a, 40)
    s = np.sqrt(1 + 2 * a)
    assert rate == pytest.approx(((s - 1) / (s + 1)) ** 2, rel=1e-5)


@pytest.mark.parametrize("a", [0.1, 1.0, 10.0])
@pytest.mark.parametrize("k", [1, 2, 4])
def test_lpc_attains_it(a, k):
    instance = asymmetric(a, k)
    problem = instance.problem(2.0, 0.7, PAIR)
    found = constants(problem)
    assert (found.mu.value, found.l_T.value) == pytest.approx((0.7, 0.7 * a))
    run = simulate(problem, k, 1)
    assert run.ratio_minus_one == pytest.approx(instance.cr_minus_one, rel=1e-8)


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: Temporal(-1.0, 1, 1),
        lambda: Temporal(1.0, 0, 1),
        lambda: Temporal(1.0, 1, 0),
        lambda: Temporal(1.0, 1, 2).ratio([1.0, -1.0]),
        lambda: Temporal(1.0, 1, 2).problem([1.0]),
        lambda: Temporal(1.0, 1, 2).problem(interval=(1.0, 0.0)),
        lambda: Asymmetric(1.0, (1.5,)),
        lambda: Asymmetric(np.inf, ()),
        lambda: asymmetric(1.0, 0),
    ],
)
def test_bad_input(wrong):
    with pytest.raises(InputError):
        wrong()
