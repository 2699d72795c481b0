"""Lower bounds against certificates: the sandwich, and resource augmentation."""

from functools import cache

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.bounds.lower import best_excess, final_excess, spatial_excess
from nearsight.graphs import parse_growth

FAMILIES = ["line", "grid2", "ring-of-blocks:2", "ring-of-blocks:3"]
K, R = np.arange(2, 41), np.arange(1, 31)
strengths = st.floats(-2.5, 1.5).map(lambda e: 10.0**e)


@cache
def growth(family):
    return parse_growth(family)


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
