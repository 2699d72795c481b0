from fractions import Fraction

import flint
import mpmath
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nearsight.graphs.powers import eulerian, power_ceiling, power_series, power_sum_ceiling


def test_eulerian_numbers():
    assert [eulerian(p) for p in range(5)] == [(1,), (1,), (1, 1), (1, 4, 1), (1, 11, 11, 1)]
    assert sum(eulerian(20)) == mpmath.factorial(20)


@given(st.integers(1, 60), st.fractions(1, 9, max_denominator=20), st.integers(0, 7))
def test_integer_powers(q, c, p):
    assert power_ceiling(q, c, Fraction(p)) == c * q**p // 1
    assert power_sum_ceiling(q, c, Fraction(p)) == c * sum(j**p for j in range(1, q + 1)) // 1


@given(
    st.integers(1, 60),
    st.fractions(1, 9, max_denominator=20),
    st.fractions(0, 4, max_denominator=12),
)
def test_real_powers(q, c, p):
    with mpmath.workdps(60):
        power = mpmath.mpf(p.numerator) / p.denominator
        terms = [mpmath.mpf(j) ** power * c.numerator / c.denominator for j in range(1, q + 1)]
        tiny = mpmath.mpf(2) ** -60
        for found, exact in [
            (power_ceiling(q, c, p), terms[-1]),
            (power_sum_ceiling(q, c, p), mpmath.fsum(terms)),
        ]:
            assert exact - 1 < found <= exact + tiny


def test_a_power_that_is_an_integer():
    assert power_ceiling(9, Fraction(1), Fraction(1, 2)) == 3
    assert power_ceiling(10**12, Fraction(1), Fraction(3, 2)) == 10**18


def test_cost_does_not_grow_with_the_distance():
    q = 10**15
    assert power_sum_ceiling(q, Fraction(1), Fraction(1)) == q * (q + 1) // 2
    exact = mpmath.mpf(q) ** 1.5 * 2 / 3
    assert power_sum_ceiling(q, Fraction(1), Fraction(1, 2)) == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize("p", [Fraction(1, 2), Fraction(3, 2), Fraction(7, 3)])
@pytest.mark.parametrize("q", [200, 201, 202, 1000])
def test_long_sums_of_real_powers_are_tight_upper_bounds(p, q):
    exact = mpmath.fsum(
        mpmath.mpf(j) ** (mpmath.mpf(p.numerator) / p.denominator) for j in range(1, q + 1)
    )
    assert exact - 1 < power_sum_ceiling(q, Fraction(1), p) < exact * (1 + 1e-6)


@pytest.mark.parametrize("number", [mpmath.iv.mpf, flint.arb])
def test_close_to_the_pole_an_upper_bound_of_a_few_per_cent(number):
    z = 1 - 1e-9
    exact = float(power_series(mpmath.mpf(z), Fraction(3, 2)))
    found = power_series(number(z), Fraction(3, 2))
    found = float(found.mid()) if number is flint.arb else float(found.a)
    assert exact <= found <= 1.1 * exact
