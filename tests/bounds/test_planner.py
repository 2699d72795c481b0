"""A plan is the whole frontier of its tier, and moves with the setting as it must."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nearsight.bounds import Parameters, Prices, Search, Setting, catalogue, plan
from nearsight.graphs import parse_growth

from .support import growth

SPECS = ["line", "grid2", "tree:3", "ring-of-blocks:2", "grid:5x7", "ring:9", "star:6", "path:2"]


@pytest.mark.parametrize("tier", ["stated", "repaired", "sharp"])
@pytest.mark.parametrize("spec", SPECS)
def test_plan_is_the_whole_frontier_of_its_tier(tier, spec):
    for seed in range(1):
        rng = np.random.default_rng([seed, len(spec)])
        l_T, l_S = 10.0 ** rng.uniform(-2.5, -0.5, 2)
        s = Setting(
            Parameters(1.0, 2.0, l_T, l_S), growth(spec), unconstrained=bool(rng.integers(2))
        )
        target = 1 + 10.0 ** rng.uniform(-3, 0)
        search = Search(max_k=40, max_r=40)
        found = plan(s, target, search=search, tiers=(tier,), prices=Prices(3.0, 1.0))[tier]
        pairs = found.frontier
        if not pairs:
            assert found.pair is found.cheapest is found.bottleneck is None
            assert found.reason
            assert not found.guarantee
            continue
        assert found.pair == min(pairs, key=lambda p: (p.k + p.r, p.k))
        assert found.cheapest == min(pairs, key=lambda p: (3 * p.k + p.r, p.k + p.r, p.k))
        assert found.work == tuple((p.k - 1) * s.growth.ball(p.r - 1) for p in pairs)
        assert all(p.excess <= target - 1 for p in pairs)
        for p in pairs:
            best = best_ratio(s, tier, p.k, p.r)
            assert best <= (target - 1) * (1 + 1e-9)
            for k, r in ((p.k - 1, p.r), (p.k, p.r - 1)):
                if tier != "repaired" and k >= 2 and r >= 1:  # repaired: b_1, b_2 are searched
                    assert best_ratio(s, tier, k, r) > (target - 1) * (1 - 1e-9)


def best_ratio(s, tier, k, r):
    """The least CR - 1 of all statements of a tier that give one."""
    at = Setting(s.parameters, s.growth, k, r, unconstrained=s.unconstrained)
    values = [np.inf]
    for b in catalogue():
        if b.tier != tier or b.label not in ("coro:CR-LPC", "nearsight:sharp-cr"):
            continue
        if tier == "stated" and b.variant:
            continue
        value = b.evaluate(at).values["cr_minus_one"]
        values.append(np.inf if value is None else value)
    return min(values)


@pytest.mark.parametrize("spec", ["line", "grid2", "grid:5x7"])
@pytest.mark.parametrize("tier", ["stated", "repaired", "sharp"])
def test_bottleneck_by_direct_comparison(tier, spec):
    for l_T, l_S in ((0.5, 0.01), (0.01, 0.1)):
        s = Setting(Parameters(1.0, 1.0, l_T, l_S), growth(spec))
        found = plan(s, 1.05, tiers=(tier,))[tier]
        if tier == "repaired" and "tight" in found.pair.variant:
            continue
        p, b = found.pair, found.bottleneck
        here = best_ratio(s, tier, p.k, p.r)
        longer, wider = best_ratio(s, tier, p.k + 1, p.r), best_ratio(s, tier, p.k, p.r + 1)
        if tier != "repaired":
            assert b.excess_k == pytest.approx(longer, rel=1e-9)
            assert b.excess_r == pytest.approx(wider, rel=1e-9)
            if abs(longer - wider) > 1e-9 * here:
                expected = "neither" if min(longer, wider) >= here else "k"
                expected = "r" if expected == "k" and wider < longer else expected
                assert b.name == expected


@settings(max_examples=15)
@given(
    spec=st.sampled_from(SPECS),
    logs=st.tuples(st.floats(-3, 0), st.floats(-3, 0)),
    loose=st.floats(-2, 0),
    factor=st.floats(0.02, 1),
    tier=st.sampled_from(["stated", "repaired", "sharp"]),
)
def test_plans_are_monotone_in_the_target(spec, logs, loose, factor, tier):
    l_T, l_S = (10.0**e for e in logs)
    s = Setting(Parameters(1.0, 2.0, l_T, l_S), growth(spec))
    search = Search(max_k=200, max_r=100)
    wide, narrow = (
        plan(s, 1 + excess, search=search, tiers=(tier,))[tier]
        for excess in (10.0**loose, 10.0**loose * factor)
    )
    if not narrow.frontier:
        return
    for p in narrow.frontier:
        # with b_1, b_2 searched anew for each target, equal up to the search
        assert any(q.k <= p.k and q.r <= p.r for q in wide.frontier)
    for size in (lambda p: p.k, lambda p: p.r, lambda p: p.k + p.r):
        assert min(map(size, wide.frontier)) <= min(map(size, narrow.frontier))


@settings(max_examples=8)
@given(spec=st.sampled_from(SPECS), logs=st.tuples(st.floats(-3, 1), st.floats(-3, 0)))
def test_without_constraints_a_plan_is_no_worse(spec, logs):
    l_T, l_S = (10.0**e for e in logs)
    p, search = Parameters(1.0, 1.5, l_T, l_S), Search(max_k=60, max_r=60)
    bound, free = (
        plan(Setting(p, growth(spec), unconstrained=u), 1.02, search=search, tiers=("sharp",))
        for u in (False, True)
    )
    for p in bound["sharp"].frontier:
        assert any(q.k <= p.k and q.r <= p.r for q in free["sharp"].frontier)


@pytest.mark.parametrize("factor", [2.0**-300, 0.25, 2.0**200])
@pytest.mark.parametrize("spec", ["line", "grid:5x7"])
def test_scale_changes_no_plan(spec, factor):
    before = plan(Setting(Parameters(1.3, 2.0, 0.3, 0.11), growth(spec)), 1.03)
    scaled = Parameters(1.3 * factor, 2.0 * factor, 0.3 * factor, 0.11 * factor)
    assert plan(Setting(scaled, growth(spec)), 1.03).tiers == before.tiers


def test_a_target_next_to_one():
    target = 1 + 2.0**-52
    s = Setting(Parameters(1.0, 1.0, 0.1, 0.05), parse_growth("line"))
    p = plan(s, target, tiers=("sharp",))["sharp"].pair
    assert p.excess <= 2.0**-52
    assert best_ratio(s, "sharp", p.k - 1, p.r) > 2.0**-52
    assert best_ratio(s, "sharp", p.k, p.r - 1) > 2.0**-52
