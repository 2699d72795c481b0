"""The plans of the theory's reference table, and what limits and prices make of them."""

import pytest

from nearsight.bounds import Prices, Search, Setting, bounds_for, plan
from nearsight.bounds.frontier import frontier
from nearsight.bounds.sharp_promise import SharpPromise

from .support import reference


def ratio_at(s, label, variant, tier, k, r, unconstrained=False):
    at = Setting(s.parameters, s.growth, k, r, unconstrained=unconstrained)
    (bound,) = (b for b in bounds_for(label) if (b.variant, b.tier) == (variant, tier))
    return bound.evaluate(at)


@pytest.mark.parametrize(("a", "k", "r"), [(0.1, 6, 4), (1.0, 24, 19), (5, 81, 63), (20, 220, 161)])
def test_reference_stated(a, k, r):
    found = plan(reference(a), 1.01, tiers=("stated",))["stated"]
    assert (found.pair.k, found.pair.r) == (k, r)
    value = ratio_at(reference(a), "coro:CR-LPC", "", "stated", k, r).values["cr_minus_one"]
    assert value == pytest.approx(found.pair.excess, rel=1e-9)
    assert value <= 0.01


@pytest.mark.parametrize(
    ("a", "k", "r", "excess"),
    [
        (0.1, 2, 1, "2.5498e-03"),
        (1.0, 4, 3, "4.8242e-03"),
        (5.0, 8, 9, "7.0292e-03"),
        (20.0, 19, 19, "9.6731e-03"),
    ],
)
def test_reference_constrained(a, k, r, excess):
    found = plan(reference(a), 1.01, tiers=("sharp",))["sharp"]
    assert (found.pair.k, found.pair.r, found.pair.variant) == (k, r, "vi")
    assert found.guarantee
    result = ratio_at(reference(a), "nearsight:sharp-cr", "vi", "sharp", k, r)
    assert result.guarantee
    assert f"{result.values['cr_minus_one']:.4e}" == excess
    assert f"{found.pair.excess:.4e}" == excess


@pytest.mark.parametrize(
    ("a", "k", "r", "excess"),
    [
        (0.1, 2, 1, "2.4947e-03"),
        (1.0, 4, 3, "3.4717e-03"),
        (5.0, 8, 8, "6.9775e-03"),
        (20.0, 18, 18, "9.8566e-03"),
    ],
)
def test_reference_mixed(a, k, r, excess):
    pairs = frontier(SharpPromise(reference(a), "mix"), 0.01).pairs
    best = min(pairs, key=lambda p: (p.k + p.r, p.k))
    assert (best.k, best.r) == (k, r)
    result = ratio_at(reference(a), "nearsight:sharp-cr", "mix", "sharp", k, r, True)
    assert result.guarantee
    assert f"{result.values['cr_minus_one']:.4e}" == excess


def test_limits_of_the_search():
    s = reference(1.0)
    assert plan(s, 1.01, search=Search(max_k=3), tiers=("sharp",))["sharp"].pair is None
    for search in (Search(max_k=3), Search(max_r=2)):
        found = plan(s, 1.01, search=search, tiers=("sharp",))["sharp"]
        assert found.frontier == ()
        assert found.work == ()
        assert found.reason
    found = plan(s, 1.01, search=Search(max_k=26), tiers=("stated",))["stated"]
    assert [(p.k, p.r) for p in found.frontier] == [(24, 19)]
    found = plan(s, 1.01, search=Search(max_r=18), tiers=("stated",))["stated"]
    assert [(p.k, p.r) for p in found.frontier] == [(27, 18)]


def test_prices_move_the_choice():
    s = reference(1.0)
    free_radius = plan(s, 1.01, prices=Prices(1.0, 0.0), tiers=("stated",))["stated"].cheapest
    free_horizon = plan(s, 1.01, prices=Prices(0.0, 1.0), tiers=("stated",))["stated"].cheapest
    assert (free_radius.k, free_radius.r) == (24, 19)
    assert (free_horizon.k, free_horizon.r) == (27, 18)
