import numpy as np
import pytest

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.bounds.joint import best_tilt, entry_bound, slack

from . import textbook, textbook_sharp
from .support import exact, growth, ulps

CASES = [(0.3, 0.2), (5.0, 0.01), (0.01, 40.0), (1e-80, 1e-80), (1e80, 1e80)]


@pytest.mark.parametrize(("a", "x"), CASES[:3])
@pytest.mark.parametrize(("dt", "ds"), [(0, 0), (3, 0), (0, 4), (5, 7)])
def test_best_rates_are_the_best_of_a_grid(a, x, dt, ds):
    p, q = best_tilt(a, x, dt, ds)
    assert slack(a, x, p, q) > 0
    rates = np.exp(-np.linspace(0, 8, 400))
    grid = entry_bound(a, x, dt, ds, rates[:, None], rates[None, :])
    assert entry_bound(a, x, dt, ds, p, q) <= grid.min() * (1 + 1e-12)


def test_no_bound_without_slack():
    assert entry_bound(10.0, 1.0, 1, 1, 0.01, 0.9) == np.inf


def test_rates_of_many_distances_at_once():
    p, q = best_tilt(0.5, 0.3, np.arange(5)[:, None], np.arange(4)[None, :])
    for i, j in np.ndindex(5, 4):
        alone = best_tilt(0.5, 0.3, i, j)
        assert np.broadcast_to(p, (5, 4))[i, j] == pytest.approx(alone.p, rel=1e-12)
        assert np.broadcast_to(q, (5, 4))[i, j] == pytest.approx(alone.q, rel=1e-12)


@pytest.mark.parametrize(("l_T", "l_S"), CASES)
@pytest.mark.parametrize(("k", "r"), [(2, 1), (3, 2), (40, 30)])
def test_theorem_at_the_same_rates(l_T, l_S, k, r):
    s = Setting(Parameters(1.0, 1.0, l_T, l_S), growth("ring-of-blocks:2"), k, r)
    a, a_S, _ = exact(s)
    x = 4 * l_S
    values = bounds_for("nearsight:joint-decay")[0].in_floats(s)
    top = textbook_sharp.least_entry(a, 4 * a_S, k - 2, 0, *best_tilt(l_T, x, k - 2, 0))
    side = textbook_sharp.least_entry(a, 4 * a_S, 0, r - 1, *best_tilt(l_T, x, 0, r - 1))
    # one top variable moves no more than a whole slice would: s_d of (E1)
    least = textbook.digits(lambda e: min(a / 2 * e, textbook.s(a, k - 1)))(top)
    assert ulps(values["top"], least) <= 8
    assert ulps(values["lateral"], textbook.digits(lambda e: 2 * a_S / 2 * e)(side)) <= 8
