import numpy as np
import pytest
import sympy
from mpmath import mp, mpf

from nearsight.bounds import Parameters
from nearsight.graphs import InputError

GOOD = {"mu": 1.0, "l_f": 2.0, "l_T": 0.3, "l_S": 0.2}


@pytest.mark.parametrize("name", GOOD)
@pytest.mark.parametrize("bad", [-1.0, np.inf, np.nan, np.array([0.5, np.nan]), np.array([1, -2])])
def test_values_out_of_range(name, bad):
    with pytest.raises(InputError, match=rf"^{name} = [^\n]*finite number [^\n]*$"):
        Parameters(**GOOD | {name: bad})


@pytest.mark.parametrize("name", ["mu", "l_f"])
def test_zero_is_out_of_range(name):
    with pytest.raises(InputError, match=rf"^{name} = 0 [^\n]*> 0[^\n]*$"):
        Parameters(**GOOD | {name: 0.0})


@pytest.mark.parametrize("name", GOOD)
@pytest.mark.parametrize("bad", ["strong", None, [1.0, "x"], object()])
def test_values_that_are_no_numbers(name, bad):
    with pytest.raises(InputError, match=rf"^{name} = [^\n]*$"):
        Parameters(**GOOD | {name: bad})


@pytest.mark.parametrize(("mu", "l_f"), [(2.0, 1.9), (1.0, np.array([2.0, 0.5]))])
def test_smoothness_below_convexity(mu, l_f):
    with pytest.raises(InputError, match=r"^l_f = [^\n]*l_f >= mu[^\n]*$"):
        Parameters(mu, l_f, 1.0, 1.0)


def test_long_arrays_still_give_one_line():
    with pytest.raises(InputError, match=r"^l_f = [^\n]*$"):
        Parameters(np.ones(200), np.linspace(0.5, 2, 200), 1.0, 1.0)


def test_shapes_that_do_not_fit():
    with pytest.raises(InputError, match=r"^[^\n]*l_T: \(2,\)[^\n]*l_S: \(3,\)[^\n]*$"):
        Parameters(1.0, 1.0, np.ones(2), np.ones(3))


def test_no_coupling_is_allowed():
    p = Parameters(1.0, 1.0, 0, 0)
    assert p.a_T == p.a_S == 0.0
    assert p.condition == 1.0


def test_conversion_is_exact():
    p = Parameters(0.1, 0.7, 0.3, 1e-200)
    with mp.workdps(400):
        assert p.converted("mpmath").l_T == mpf(0.3)
        assert p.converted("interval").l_S.a == p.converted("interval").l_S.b == mpf(1e-200)
    assert p.converted("sympy").mu == sympy.Rational(*(0.1).as_integer_ratio())
    assert p.converted("wide").l_f.to_float() == 0.7
    assert float(p.converted("arb").l_T) == 0.3
    assert p.converted("float") is p


def test_unknown_arithmetic():
    with pytest.raises(InputError, match=r"^arithmetic = 'decimal'[^\n]*mpmath[^\n]*$"):
        Parameters(**GOOD).converted("decimal")


def test_symbols_pass_unchecked():
    a = sympy.Symbol("a")
    p = Parameters(1, 1, a, -a)
    assert p.a_T == a
