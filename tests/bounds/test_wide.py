import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from nearsight.bounds.wide import Wide, where

LIMIT = mpf(2) ** -96
numbers = st.builds(
    lambda m, e, sign: sign * float(m) * 2.0**e,
    st.integers(1, 2**53),
    st.integers(-900, 900),
    st.sampled_from([1, -1]),
)
positive = numbers.map(abs)


def value(w):
    with mp.workprec(400):
        return (mpf(float(w.high)) + mpf(float(w.low))) * mpf(2) ** int(w.exponent)


@st.composite
def wides(draw, base=numbers):
    """Numbers that need both halves: a quotient of floats."""
    return Wide(draw(base)) / Wide(draw(base))


def check(result, exact):
    with mp.workprec(400):
        assert abs(value(result) - exact) <= LIMIT * abs(exact)
    assert result.high == 0 or 0.5 <= abs(float(result.high)) < 1
    assert abs(float(result.low)) <= 2.0**-53


@given(numbers, numbers)
def test_operations_on_floats(a, b):
    x, y = Wide(a), Wide(b)
    with mp.workprec(4000):
        a, b = mpf(a), mpf(b)
        check(x + y, a + b)
        check(x - y, a - b)
        check(x * y, a * b)
        check(x / y, a / b)


@given(wides(), wides())
def test_operations_on_both_halves(x, y):
    with mp.workprec(4000):
        a, b = value(x), value(y)
        check(x * y, a * b)
        check(x / y, a / b)
        check(-x, -a)


@given(wides(positive), wides(positive))
def test_sums_of_one_sign(x, y):
    with mp.workprec(4000):
        check(x + y, value(x) + value(y))


@given(wides(positive), st.integers(40, 100), st.integers(1, 2**30))
def test_differences_of_neighbours_keep_the_bits_there_are(x, shift, m):
    y = x + x * Wide(m * 2.0**-shift)
    with mp.workprec(4000):
        error = abs(value(y - x) - (value(y) - value(x)))
        assert error <= mpf(2) ** -100 * abs(value(x))


@given(wides(positive))
def test_square_root(x):
    with mp.workprec(4000):
        check(x.sqrt(), mp.sqrt(value(x)))


@given(wides(positive), st.integers(0, 1000))
def test_powers(x, n):
    with mp.workprec(4000):
        exact = value(x) ** n
        assert abs(value(x**n) - exact) <= LIMIT * exact * max(n, 1)


@given(st.integers(-(2**400), 2**400))
def test_integers_of_any_size(n):
    with mp.workprec(600):
        assert abs(value(Wide(n)) - n) <= LIMIT * abs(n)
        if abs(n) < 2**106:
            assert value(Wide(n)) == n


@pytest.mark.parametrize("n", [2**53 + 1, -(2**53) - 1, 2**106 - 1, 3 * 2**59 + 1])
def test_large_integers_are_exact(n):
    with mp.workprec(400):
        assert value(Wide(n)) == n


@pytest.mark.parametrize("n", [np.int64(2**53 + 1), np.int64(2**62 - 1)])
def test_large_integers_of_numpy_are_exact(n):
    with mp.workprec(400):
        assert value(Wide(n)) == int(n)


@given(wides(), wides())
def test_comparison(x, y):
    with mp.workprec(4000):
        a, b = value(x), value(y)
        assert bool(x < y) == (a < b)
        assert bool(x <= y) == (a <= b)
        assert bool(x > y) == (a > b)
        assert bool(x >= y) == (a >= b)


@pytest.mark.parametrize(("a", "b"), [(np.inf, np.inf), (-np.inf, -np.inf), (-np.inf, np.inf)])
def test_comparison_of_infinities(a, b):
    x, y = Wide(a), Wide(b)
    assert (x <= y, x >= y, x < y, x > y) == (a <= b, a >= b, a < b, a > b)


@given(numbers)
def test_comparison_with_infinity_zero_and_nan(a):
    x = Wide(a)
    assert x < np.inf
    assert x > -np.inf
    assert bool(x > 0) == (a > 0)
    assert not any((x < np.nan, x > np.nan, x <= np.nan, x >= np.nan))


def test_zero_infinity_and_nan():
    zero, one, inf, nan = (Wide(v) for v in (0.0, 1.0, np.inf, np.nan))
    assert (zero + one).to_float() == (one - zero).to_float() == (zero + 1e-300).to_float() * 1e300
    assert (zero * one).to_float() == zero.sqrt().to_float() == (zero**5).to_float() == 0
    assert (zero**0).to_float() == 1
    assert (inf + one).to_float() == (inf * 2).to_float() == inf.sqrt().to_float() == np.inf
    assert (one / zero).to_float() == (inf**3).to_float() == np.inf
    assert (one / inf).to_float() == 0
    assert (-one / zero).to_float() == -np.inf
    for undefined in (inf - inf, zero / zero, inf * zero, inf / inf, (-one).sqrt(), nan + 1):
        assert np.isnan(undefined.to_float())


def test_products_beyond_the_floats_come_back():
    huge = Wide(1e300) ** 1000
    assert huge.to_float() == np.inf
    assert (1 / huge).to_float() == 0
    assert (huge * (Wide(1e-300) ** 1000)).to_float() == pytest.approx(1, rel=1e-12)


@given(wides(positive), st.integers(1023, 1120))
def test_subnormal_results(x, shift):
    x = x / Wide(2.0 ** (shift - 1000)) * Wide(2.0**-1000)
    x = Wide._make(x.high, x.low, np.asarray(-shift))
    with mp.workprec(4000):
        assert abs(mpf(x.to_float()) - value(x)) <= mpf(2) ** -1074 * mpf(0.5000001)


@given(wides())
def test_rounding_to_a_float(x):
    with mp.workprec(4000):
        exact = value(x)
        if mpf(2) ** -1000 < abs(exact) < mpf(2) ** 1000:
            assert abs(mpf(x.to_float()) - exact) <= abs(exact) * mpf(2) ** -53


def test_broadcasting():
    rows, columns = Wide(np.array([[1.0], [2.0], [3.0]])), np.array([10.0, 20.0])
    for result, expected in [
        (rows + columns, [[11, 21], [12, 22], [13, 23]]),
        (columns - rows, [[9, 19], [8, 18], [7, 17]]),
        (columns * rows, [[10, 20], [20, 40], [30, 60]]),
        (columns / rows, columns / np.array([[1.0], [2.0], [3.0]])),
        (rows ** np.array([0, 2]), [[1, 1], [1, 4], [1, 9]]),
        (where(rows > 1.5, columns, rows), [[1, 1], [10, 20], [10, 20]]),
    ]:
        assert isinstance(result, Wide)
        assert result.to_float().tolist() == np.asarray(expected, dtype=float).tolist()


def test_arrays_keep_each_entry_apart():
    x = np.array([1.0, 1e-300, 0.0, np.inf, 1e300])
    assert (Wide(x) + 1.0).to_float().tolist() == [2.0, 1.0, 1.0, np.inf, 1e300]
    assert (Wide(x) * Wide(x) / Wide(x)).to_float()[[0, 1, 4]].tolist() == [1.0, 1e-300, 1e300]


def test_negative_powers_are_refused():
    with pytest.raises(ValueError, match="exponent >= 0"):
        Wide(2.0) ** -1


def test_repr_and_copies():
    assert repr(Wide(0.1)) == "Wide(0.1)"
    assert Wide(Wide(0.1)).to_float() == 0.1
    assert isinstance(Wide(0.5).to_float(), float)
