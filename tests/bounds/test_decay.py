import flint
import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from nearsight.bounds import decay

from . import textbook
from .support import ratios, ulps

EXACT = {
    "g": textbook.g,
    "gamma_T": textbook.gamma_T,
    "gamma_S": textbook.g,
    "rho": textbook.rho,
    "one_minus_g": textbook.digits(lambda y: 1 - textbook.g(y)),
    "one_minus_rho": textbook.digits(lambda y: 1 - textbook.rho(y)),
    "half_over_g": textbook.digits(lambda y: y / (2 * textbook.g(y))),
    "over_rho": textbook.digits(lambda y: y / textbook.rho(y)),
    "slice_first": textbook.digits(lambda a: a / (2 * mp.sqrt(1 + a))),
}


@pytest.mark.parametrize("name", EXACT)
@settings(max_examples=50)
@given(y=ratios)
def test_closed_forms_to_the_last_bits(name, y):
    assert ulps(getattr(decay, name)(y), EXACT[name](y)) <= 1


@given(excess=ratios)
def test_demko_to_the_last_bits(excess):
    kappa = 1 + excess
    assert ulps(decay.demko(kappa), textbook.demko(kappa)) <= 1


@given(y=ratios)
def test_logarithm_of_the_rate(y):
    exact = textbook.digits(lambda y: mp.log(textbook.g(y)))(y)
    assert ulps(decay.log_g(y), exact) <= 8


@given(a=ratios, d=st.integers(0, 400))
def test_slice_decay_to_the_last_bits(a, d):
    assert ulps(decay.slice_decay(a, d), textbook.s(a, d)) <= 1


def test_slice_decay_of_many_distances_at_once():
    distances = np.arange(60).reshape(6, 10)
    values = decay.slice_decay(0.7, distances)
    assert values.shape == (6, 10)
    assert values.ravel().tolist() == [decay.slice_decay(0.7, d) for d in range(60)]


@pytest.mark.parametrize("y", [1e17, 1e33, 1e100, 1e150, 1e300])
def test_complements_where_the_rate_rounds_to_one(y):
    assert (decay.g(y) == 1) is (y > 1e34)
    assert ulps(decay.one_minus_g(y), EXACT["one_minus_g"](y)) <= 1
    assert ulps(decay.one_minus_rho(y), EXACT["one_minus_rho"](y)) <= 1
    assert decay.one_minus_g(y) > 0
    assert decay.one_minus_rho(y) > 0


def test_without_coupling():
    assert decay.g(0.0) == decay.rho(0.0) == decay.slice_first(0.0) == decay.over_rho(0.0) == 0
    assert decay.one_minus_g(0.0) == decay.one_minus_rho(0.0) == 1
    assert decay.half_over_g(0.0) == 2
    assert decay.demko(1.0) == 2
    assert [decay.slice_decay(0.0, d) for d in (0, 1, 2)] == [1, 0, 0]


def test_demko_is_one_from_a_large_condition_on():
    threshold = (1 + np.sqrt(2)) ** 2  # (1 + sqrt k)^2 = 2 k
    assert decay.demko(threshold * 1.0001) == 1
    assert decay.demko(threshold * 0.9999) > 1


@pytest.mark.parametrize("name", [*EXACT, "demko"])
@settings(max_examples=30)
@given(y=ratios)
def test_intervals_enclose(name, y):
    argument = 1 + y if name == "demko" else y
    exact = textbook.demko(argument) if name == "demko" else EXACT[name](y)
    value = getattr(decay, name)(mpmath.iv.mpf(argument))
    ball = getattr(decay, name)(flint.arb(argument))
    with mp.workdps(60):
        assert value.a <= exact <= value.b
        assert value.b - value.a <= abs(exact) * mpf(10) ** -13
    assert _inside(ball, exact)
    assert ball.rel_accuracy_bits() >= 40


@given(y=ratios)
def test_ball_of_the_logarithm(y):
    exact = textbook.digits(lambda y: mp.log(textbook.g(y)))(y)
    assert _inside(decay.log_g(flint.arb(y)), exact)


def test_mpmath_intervals_refuse_the_logarithm():
    with pytest.raises(TypeError, match="arb"):
        decay.log_g(mpmath.iv.mpf(1))


@given(a=ratios, d=st.integers(0, 60))
def test_intervals_enclose_slice_decay(a, d):
    exact = textbook.s(a, d)
    value = decay.slice_decay(mpmath.iv.mpf(a), d)
    with mp.workdps(60):
        assert value.a <= exact <= value.b
    assert _inside(decay.slice_decay(flint.arb(a), d), exact)


def _inside(ball, exact):
    with mp.workdps(80):
        text = mp.nstr(exact, 75, min_fixed=0, max_fixed=0)
    flint.ctx.prec, before = 300, flint.ctx.prec
    try:
        return bool(ball.overlaps(flint.arb(text)))
    finally:
        flint.ctx.prec = before


@given(y=ratios)
def test_mpmath_keeps_its_precision(y):
    with mp.workdps(60):
        value = decay.g(mpf(y))
        assert abs(value - textbook.g(y)) <= abs(value) * mpf(10) ** -57


def test_symbols():
    y, a = sympy.symbols("y a", positive=True)
    s = sympy.sqrt(1 + y)
    assert sympy.simplify(decay.g(y) - (s - 1) / (s + 1)) == 0
    assert sympy.simplify(decay.gamma_T(a) - (1 - 2 / (sympy.sqrt(1 + 2 * a) + 1))) == 0
    assert sympy.simplify(decay.one_minus_g(y) + decay.g(y) - 1) == 0
    assert sympy.simplify(decay.rho(y) ** 2 - decay.g(y)) == 0
    assert sympy.simplify(decay.one_minus_rho(y) + decay.rho(y) - 1) == 0
    assert sympy.simplify(decay.half_over_g(y) * 2 * decay.g(y) - y) == 0
    assert sympy.simplify(decay.slice_first(a) - a / (2 * sympy.sqrt(1 + a))) == 0


@pytest.mark.parametrize("d", [0, 1, 2, 5])
def test_slice_decay_at_rational_points(d):
    a = sympy.Rational(3, 2)  # sqrt(1 + 2a) = 2, so gamma_T = 1/3
    expected = 1 if d == 0 else a / (2 * sympy.sqrt(sympy.Rational(5, 2))) / 3 ** (d - 1)
    assert sympy.simplify(decay.slice_decay(a, d) - expected) == 0


def test_rates_increase_with_the_coupling():
    y = np.logspace(-150, 12, 400)
    assert np.all(np.diff(decay.g(y)) > 0)
    assert np.all(np.diff(decay.rho(y)) > 0)
    assert np.all(np.diff(decay.slice_decay(y[y > 1e-90], 3)) > 0)
