import numpy as np
import pytest
from hypothesis import given, settings
from mpmath import mp

from nearsight.bounds import Parameters, Setting, bounds_for

from . import textbook
from .support import exact, growth, log_uniform, settings_of, spheres, ulps


def bound_of(label, tier, variant=""):
    (bound,) = (b for b in bounds_for(label) if (b.tier, b.variant) == (tier, variant))
    return bound


def from_the_text(s, tier, lo=None):
    a, a_S, condition = exact(s)
    lo = lo or textbook.local(tier, a, a_S, s.max_degree)
    with mp.workdps(500):
        weight = condition + s.max_degree * a_S + 2 * a
    return lo, textbook.whole(tier, a), weight


@pytest.mark.parametrize("tier", ["stated", "repaired"])
@settings(max_examples=12)
@given(s=settings_of())
def test_ratio_from_the_text(tier, s):
    lo, wh, weight = from_the_text(s, tier)
    lateral, top, condition = textbook.ratio(lo, wh, weight, spheres(s), s.k)
    values = bound_of("coro:CR-LPC", tier).in_floats(s)
    assert ulps(values["lateral"], lateral) <= 8
    assert ulps(values["top"], top) <= 64
    assert ulps(values["condition"], condition) <= 64
    assert ulps(values["C_3"], textbook.C_3(spheres(s), lo.rho_S)) <= 64
    with mp.workdps(500):
        assert ulps(values["cr_minus_one"], lateral + top) <= 64
        assert ulps(values["condition_slack"], 0.5 - condition) <= 64


@pytest.mark.parametrize("tier", ["stated", "repaired"])
@settings(max_examples=12)
@given(s=settings_of())
def test_step_error_from_the_text(tier, s):
    lo, wh, _ = from_the_text(s, tier)
    text = textbook.per_step(lo, wh, spheres(s), s.k)
    values = bound_of("thm:per-step-err", tier).in_floats(s)
    for name, number in zip(("history", "lateral", "top"), text, strict=True):
        assert ulps(values[name], number) <= 64


@pytest.mark.parametrize("tier", ["stated", "repaired"])
@settings(max_examples=10)
@given(s=settings_of(ratio=log_uniform(-150, -3), k=(2, 40), r=(1, 30), b=(0.75, 3.0)))
def test_ratio_with_the_tight_theorem(tier, s):
    a, a_S, _ = exact(s)
    sums = textbook.sums(s.growth.source, 0.75, 3.0)
    if mp.isinf(sums[1]):
        return
    lo = textbook.local_tight(a, a_S, s.max_degree, 0.75, 3.0, *sums)
    lo, wh, weight = from_the_text(s, tier, lo)
    lateral, top, condition = textbook.ratio(lo, wh, weight, spheres(s), s.k)
    values = bound_of("coro:CR-LPC", tier, "tight").in_floats(s)
    for name, number in [("lateral", lateral), ("top", top), ("condition", condition)]:
        assert ulps(values[name], number) <= 64


@pytest.mark.parametrize("tier", ["stated", "repaired"])
@settings(max_examples=10)
@given(s=settings_of(ratio=log_uniform(-150, -3), k=(2, 40), r=(1, 30)))
def test_ratio_without_the_network(tier, s):
    a, a_S, _ = exact(s)
    Delta = s.max_degree
    lo = textbook.local_tight(a, a_S, Delta, 2.0 * Delta - 1, 4.0 * Delta**2 - 2 * Delta, 2.0, 2.0)
    lo, wh, weight = from_the_text(s, tier, lo)
    lateral, top = textbook.pure_ratio(lo, wh, weight, Delta, s.k, s.r)
    values = bound_of("coro:pure-exp-decay", tier).in_floats(s)
    with mp.workdps(500):
        assert ulps(values["cr_minus_one"], lateral + top) <= 64
        # rho_S = 4 Delta^2 gamma_S as in the appendix
        assert ulps(values["rho_S"], 4 * Delta**2 * textbook.g(Delta * a_S)) <= 8


@pytest.mark.parametrize("tier", ["stated", "repaired"])
@settings(max_examples=12)
@given(s=settings_of(ratio=log_uniform(-3, 1), k=(2, 40), r=(1, 40)))
def test_a_longer_horizon_never_hurts(tier, s):
    k = np.arange(2, 80)
    found = bound_of("coro:CR-LPC", tier).in_floats(Setting(s.parameters, s.growth, k, s.r))
    assert np.all(np.diff(found["cr_minus_one"]) <= 0)
    assert np.all(np.diff(found["condition"]) <= 0)


@settings(max_examples=12)
@given(s=settings_of())
def test_accumulation_from_the_text(s):
    a, *_ = exact(s)
    for tier in ("stated", "repaired"):
        wh = textbook.whole(tier, a)
        value = bound_of("thm:alg-perf-bound-err-inject", tier).in_floats(s)["factor"]
        with mp.workdps(500):
            assert ulps(value, wh.C_0**2 / (1 - wh.rho_G) ** 2) <= 8


def test_conditions_of_the_corollary():
    at = lambda l_T, l_S: bound_of("coro:pure-exp-decay", "repaired").evaluate(  # noqa: E731
        Setting(Parameters(1.0, 1.0, l_T, l_S), growth("line"), 60, 60)
    )
    assert at(1 / 16, 2.0**-7).guarantee
    assert at(1 / 16, 2.0**-7).values["cr"] > 1
    assert not at(0.0626, 2.0**-7).guarantee
    assert at(1 / 16, 0.0079).values["cr"] is None
    assert "Delta^7 l_S/mu <= 1" in at(1 / 16, 0.0079).reasons["cr"]
