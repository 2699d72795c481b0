import numpy as np
import pytest
from hypothesis import given, settings
from mpmath import mp

from nearsight.bounds import Parameters, Setting, bounds_for, plan
from nearsight.bounds.lower import best_excess
from nearsight.bounds.resource import contains_ring_of_blocks, converges_up_to
from nearsight.graphs import parse_growth

from . import textbook, textbook_lower
from .support import exact, growth, ratios, settings_of, ulps

STATED, REPAIRED, SHARP = bounds_for("coro:resource-augmentation")


@settings(max_examples=50)
@given(s=settings_of())
def test_ratios_of_the_printed_rates(s):
    a, a_S, _ = exact(s)
    s = Setting(s.parameters, s.growth)
    values = STATED.evaluate(s).values
    with mp.workdps(500):
        x = s.max_degree * a_S
        in_time = mp.log(textbook_lower.lambda_T(a)) / mp.log(textbook.rho(2 * a))
        in_space = mp.log(textbook_lower.lambda_S(x)) / (mp.log(textbook.rho(x)) / 2)
    assert ulps(values["k_ratio_of_rates"], in_time) <= 16
    assert ulps(values["r_ratio_of_rates"], in_space) <= 16
    assert (values["k_ratio"], values["r_ratio"]) == (4, 32)


@settings(max_examples=30)
@given(x=ratios)
def test_ratio_for_odd_degrees(x):
    s = Setting(Parameters(1.0, 1.0, 1.0, x), growth("tree:3"))
    with mp.workdps(500):
        expected = mp.log(textbook.g(2 * mp.mpf(x))) / mp.log(textbook.g(3 * mp.mpf(x)))
    assert ulps(SHARP.in_floats(s)["r_ratio"], expected) <= 16
    assert 1 <= SHARP.in_floats(s)["r_ratio"] <= 1.2248  # sqrt(3/2) as x grows


def test_even_degrees_need_no_more():
    for spec in ("line", "grid2", "ring-of-blocks:2"):
        result = SHARP.evaluate(Setting(Parameters(1.0, 1.0, 0.7, 0.3), growth(spec)))
        assert result.guarantee
        assert result.values["k_ratio"] == result.values["r_ratio"] == 1
    assert not SHARP.evaluate(Setting(Parameters(1, 1, 0.7, 0.3), growth("tree:3"))).guarantee


@pytest.mark.parametrize("bound", [STATED, REPAIRED, SHARP], ids=lambda b: b.tier)
def test_needed_pair_is_the_plan_for_the_lower_bound(bound):
    s = Setting(Parameters(1.0, 1.0, 0.4, 0.2), growth("line"), 2, 1)
    result = bound.evaluate(s)
    excess = best_excess(0.4, 0.2, 2, 2, 1)
    assert result.values["excess"] == excess
    found = plan(s, 1 + excess, tiers=(bound.tier,))[bound.tier]
    needed = (result.values["k_needed"], result.values["r_needed"])
    if found.guarantee:
        assert needed == (found.pair.k, found.pair.r)
    else:
        assert needed == (None, None)
        assert "no pair is guaranteed" in result.reasons["k_needed"]


def test_uncoupled_networks_have_no_ratio():
    result = STATED.evaluate(Setting(Parameters(1.0, 1.0, 0.0, 0.3), growth("line")))
    assert result.values["k_ratio"] is result.values["k_ratio_of_rates"] is None
    assert "nothing is coupled" in result.reasons["k_ratio"]
    assert result.values["r_ratio"] == 32


def test_convergence():
    assert converges_up_to(growth("grid2"), 1.0)
    assert not converges_up_to(growth("tree:3"), 1.0)
    assert converges_up_to(growth("tree:3"), 0.5)
    assert not converges_up_to(growth("tree:3"), 0.51)
    assert converges_up_to(growth("star:6"), 1.0)


def test_best_excess_is_the_larger_bound():
    assert best_excess(1.0, 1e-3, 4, 3, 3) == pytest.approx(float(textbook_lower.final(1.0, 3)))
    assert best_excess(1e-3, 5.0, 4, 3, 3) == pytest.approx(
        float(textbook_lower.spatial(5.0, 2, 3))
    )
    assert best_excess(1.0, 9.0, 1, 3, 3) == pytest.approx(float(textbook_lower.final(1.0, 3)))
    assert np.all(np.diff(best_excess(1.0, 0.5, 4, np.arange(1, 9), 30)) < 0)


@pytest.mark.parametrize("spec", ["line", "grid2", "grid3", "ring-of-blocks:3", "tree:3"])
def test_families_that_grow_at_least_like_their_ring_of_blocks(spec):
    assert contains_ring_of_blocks(parse_growth(spec))


def test_a_class_of_few_neighbours_at_a_distance_holds_no_ring_of_blocks():
    assert contains_ring_of_blocks(parse_growth("poly:5,1", 4))
    assert not contains_ring_of_blocks(parse_growth("poly:4,0", 4))  # 5 at distance 2 there


@pytest.mark.parametrize("spec", ["ring:9", "star:6"])
def test_finite_networks_contain_no_infinite_ring(spec):
    s = Setting(Parameters(1.0, 1.0, 1.0, 0.5), growth(spec))
    assert not contains_ring_of_blocks(s.growth)
    assert not any(b.evaluate(s).guarantee for b in bounds_for("coro:resource-augmentation"))
