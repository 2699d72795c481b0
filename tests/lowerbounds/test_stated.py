"""The printed bounds, and when they are implied by proven ones."""

import pytest
from mpmath import mp, mpf

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.graphs import parse_growth
from nearsight.lowerbounds import asymmetric_excess, stated_temporal_excess
from nearsight.lowerbounds.floor import floor


@pytest.mark.parametrize(("mu", "l_T", "k"), [(1.0, 1.0, 3), (0.01, 5.0, 2), (30.0, 1e-6, 1)])
def test_printed_constant(mu, l_T, k):
    with mp.workdps(60):
        m, ell = mpf(mu), mpf(l_T)
        rate = (1 - 2 / (mp.sqrt(1 + 4 * ell / m) + 1)) ** 2
        printed = m**3 * (1 - mp.sqrt(rate)) ** 2 / (48 * (m + 1) ** 2 * ell) * rate**k
        assert abs(stated_temporal_excess(mu, l_T, k) / printed - 1) < 1e-14


def test_printed_constant_depends_on_the_unit_of_costs():
    assert stated_temporal_excess(2.0, 2.0, 3) == pytest.approx(
        stated_temporal_excess(1.0, 1.0, 3) * 16 / 9, rel=1e-14
    )


def test_printed_rate_is_too_large_in_the_long_run():
    # LPC itself does better than the printed bound says anybody can
    found = None
    for k in range(10, 60, 2):
        s = Setting(Parameters(1.0, 1.0, 1.0, 0.0), parse_growth("line"), k, 1, unconstrained=True)
        values = [b.evaluate(s).values["cr_minus_one"] for b in bounds_for("nearsight:sharp-cr")]
        if min(v for v in values if v is not None) < stated_temporal_excess(1.0, 1.0, k):
            found = k
            break
    assert found is not None
    s = Setting(Parameters(1.0, 1.0, 1.0, 0.0), parse_growth("line"), found, 1)
    assert not floor(s, None, found, 1).stated.temporal_guarantee
    assert stated_temporal_excess(1.0, 1.0, found) > asymmetric_excess(1.0, found)
