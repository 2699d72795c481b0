from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nearsight.bounds.arithmetic import one_plus
from nearsight.bounds.frontier import Pair


@given(st.floats(0, 1e300))
def test_one_plus_brackets_the_exact_sum(excess):
    low, high = one_plus(excess, up=False), one_plus(excess, up=True)
    assert Fraction(float(low)) <= 1 + Fraction(excess) <= Fraction(float(high))
    assert high <= np.nextafter(low, np.inf)


def test_a_tiny_excess_is_not_rounded_away():
    assert Pair(60, 60, 1e-67).cr > 1
    assert one_plus(1e-67, up=False) == 1
    assert one_plus(0.0, up=True) == 1


@pytest.mark.parametrize("up", [True, False])
def test_what_is_not_finite_stays(up):
    np.testing.assert_array_equal(one_plus(np.array([np.inf, np.nan]), up=up), [np.inf, np.nan])
