import numpy as np
import pytest

import nearsight as ns
from nearsight.lowerbounds import (
    augmentation,
    augmented,
    floor,
    printed_rates,
    sandwich,
    spatial_supremum,
    temporal_supremum,
    worst_case,
)
from nearsight.lowerbounds.augmentation import scan
from nearsight.lowerbounds.rates import PRINTED
from nearsight.lpc import instance

NETWORK = ns.parse_graph("ring:9")
GIVEN = ns.Parameters(2.0, 2.0, 2.0, 1.0)  # a = x = 1
SETTING = ns.Setting(GIVEN, ns.network_growth(NETWORK), unconstrained=True)
STARS = [(1, 1), (2, 2), (3, 1)]


@pytest.fixture(scope="module")
def found():
    return augmentation(NETWORK, 7, GIVEN, STARS, k_max=6, r_max=4)


def test_measured_pairs_reach_the_lower_bound_and_smaller_ones_do_not(found):
    problem = instance(NETWORK, 7, GIVEN)
    for row, (k_star, r_star) in zip(found, STARS, strict=True):
        assert (row.k_star, row.r_star) == (k_star, r_star)
        assert row.lower == floor(SETTING, NETWORK, k_star, r_star).cr_minus_one
        assert row.measured
        for p in row.measured:
            assert p.excess == worst_case(problem, p.k, p.r).cr_minus_one <= row.lower
        for k in range(2, 7):
            for r in range(1, 5):
                reached = worst_case(problem, k, r).cr_minus_one <= row.lower
                beaten = any(p.k <= k and p.r <= r for p in row.measured)
                assert beaten or not reached


def test_certified_pairs_are_no_smaller_than_measured_ones(found):
    for row in found:
        for p in row.certified:
            if p.k <= 6 and p.r <= 4:
                assert any(q.k <= p.k and q.r <= p.r for q in row.measured)


def test_factors_are_those_of_the_smallest_pair(found):
    row = found[1]
    least = min(row.measured, key=lambda p: (p.k + p.r, p.k))
    assert row.factors == (least.k / 2, least.r / 2)
    assert all(f < p for f, p in zip(row.factors, PRINTED, strict=True))
    assert row.certified_factors is not None


def test_nothing_is_invented_where_nothing_is_found():
    (row,) = augmentation(NETWORK, 7, GIVEN, [(4, 4)], k_max=2, r_max=1)
    assert (row.measured, row.factors) == ((), None)
    free = ns.Parameters(1.0, 1.0, 0.0, 0.0)
    (row,) = augmentation(NETWORK, 3, free, [(1, 1)], k_max=2, r_max=1)
    assert (row.lower, row.certified, row.certified_factors) == (0.0, (), None)
    assert [(p.k, p.r) for p in row.measured] == [(2, 1)]


def test_the_worst_case_is_not_monotone_in_r():
    line = [p.excess for p in scan(ns.parse_graph("grid:4x4"), 5, GIVEN, 2, 4)]
    assert sorted(line, reverse=True) != line


def test_printed_rates_over_the_whole_range():
    found = printed_rates()
    assert found.coupling[[0, -1]] == pytest.approx([1e-12, 1e12])
    # 4 log g(4a)/log g(2a): 4 for weak couplings, 4/sqrt(2) for strong ones
    assert found.temporal[[0, -1]] == pytest.approx([4.0, 4 / np.sqrt(2)], rel=0.03)
    in_time, in_space = found.exceeding
    assert not len(in_time)
    assert 200 < in_space.min() < in_space.max() < 750  # 32 is exceeded there
    assert found.spatial.max() > 35


def test_a_sandwich_says_the_same():
    rows = sandwich(NETWORK, 7, GIVEN, range(2, 7), range(1, 5)).rows
    stars = [(row.k, row.r) for row in rows]
    other = augmentation(NETWORK, 7, GIVEN, stars, k_max=6, r_max=4)
    for one, two in zip(augmented(rows, SETTING), other, strict=True):
        assert (one.k_star, one.r_star, one.lower) == (two.k_star, two.r_star, two.lower)
        assert (one.measured, one.certified) == (two.measured, two.certified)
        assert one.factors == two.factors


def test_the_supremum_in_space_by_intervals():
    # over all x > 0, y = 1/sqrt(x): 4 log lambda_S/log g(x), log g = -2 asinh(y), in intervals
    from flint import arb, ctx

    most, at = spatial_supremum().value, spatial_supremum().coupling
    ctx.prec = 80
    c = arb(48).sqrt()

    def below(low, high, limit, depth=0):
        y = arb.union(arb(low), arb(high))
        weak = 2 * (3 + 3 * y * y).log() / y.asinh()
        strong = -4 * (1 - c * y).log() / y.asinh() if 7 * high < 1 else weak
        if weak < limit or strong < limit:
            return True
        middle = (low + high) / 2
        return depth < 60 and all(
            below(*p, limit, depth + 1) for p in ((low, middle), (middle, high))
        )

    # y < 1e-3: strong <= 4 c/(1 - c y) y/asinh(y) < 28; y > 100: weak < 6
    assert 4 * c / (1 - c * arb("0.001")) * arb("1.001") < 28
    assert below(1e-3, 100.0, arb(most) + arb("1e-6"))
    assert not below(1e-3, 100.0, arb(most) - arb("1e-6"))
    assert printed_rates([at]).spatial[0] == pytest.approx(most, rel=1e-12)
    found = printed_rates()
    assert found.spatial.max() <= most
    assert found.temporal.max() <= temporal_supremum().value


def test_the_printed_spatial_factor_by_hand():
    # lambda_S = (1 - 4 sqrt(3)/sqrt(x))^2, rho_S = sqrt(g(x)), h(r)^2 rho_S^r ~ rho_S^(r/2)
    x = 300.0
    root = np.sqrt(1 + x)
    rho_S = np.sqrt((root - 1) / (root + 1))
    by_hand = 2 * np.log(max((1 - np.sqrt(48 / x)) ** 2, x / (3 + 3 * x))) / np.log(rho_S)
    assert printed_rates([x]).spatial[0] == pytest.approx(by_hand, rel=1e-12)
    assert by_hand > PRINTED[1]


def test_bad_arguments():
    with pytest.raises(ns.InputError, match="stars"):
        augmentation(NETWORK, 3, GIVEN, [(0, 1)])
    for wrong in ({"k_max": 1}, {"r_max": 0}, {"style": "softplus"}):
        with pytest.raises(ns.InputError, match=next(iter(wrong))):
            augmentation(NETWORK, 3, GIVEN, [(1, 1)], **wrong)
    for wrong in ([0.0], [np.nan], 1.0):
        with pytest.raises(ns.InputError, match="positive"):
            printed_rates(wrong)
