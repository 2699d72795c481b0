"""One formula in every arithmetic: floats, mpmath's intervals, balls and SymPy."""

import flint
import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from nearsight.bounds import arithmetic, energy, global_bound, joint, local_bound, lower
from nearsight.bounds.certificate import Shares, best_shares, sharp_excess
from nearsight.bounds.theorems.banded_inverse import inverse_entry
from nearsight.bounds.theorems.networked_soco import soco_repaired

from . import textbook, textbook_lower, textbook_sharp
from .support import log_uniform, ratios, ulps

wide_range, small = ratios, log_uniform(-6, 1.5)


def soco(a_S, Delta):
    return textbook.demko(1 + Delta * a_S) * mp.sqrt(max(Delta, 1)) * a_S / 2


# name -> (function of two couplings, the same from the text)
FORMULAS = {
    "global stated": (
        lambda a, x: global_bound.global_stated(a),
        lambda a, x: textbook.whole("stated", a),
    ),
    "global repaired": (
        lambda a, x: global_bound.global_repaired(a),
        lambda a, x: textbook.whole("repaired", a),
    ),
    "global sharp": (
        lambda a, x: global_bound.global_sharp(a),
        lambda a, x: textbook.whole("sharp", a),
    ),
    "local stated": (
        lambda a, x: local_bound.local_stated(a, x, 5),
        lambda a, x: textbook.local("stated", a, x, 5),
    ),
    "local repaired": (
        lambda a, x: local_bound.local_repaired(a, x, 5),
        lambda a, x: textbook.local("repaired", a, x, 5),
    ),
    "accumulation": (
        lambda a, x: (global_bound.accumulation_sharp(a),),
        textbook.digits(lambda a, x: (1 + textbook.s(a, 1) / (1 - textbook.gamma_T(a)),)),
    ),
    "final": (
        lambda a, x: (lower.final_excess(a, 7),),
        lambda a, x: (textbook_lower.final(a, 7),),
    ),
    "temporal": (
        lambda a, x: (lower.temporal_excess(a, 7),),
        lambda a, x: (textbook_lower.temporal(a, 7),),
    ),
    "lambda": (
        lambda a, x: (lower.lambda_T_stated(a), lower.lambda_S_stated(x)),
        lambda a, x: (textbook_lower.lambda_T(a), textbook_lower.lambda_S(x)),
    ),
    "banded inverse": (
        lambda a, x: (inverse_entry(1 + 0 * a, 1 + a, 2, 3),),
        textbook.digits(lambda a, x: (textbook.demko(1 + a) * textbook.g(a) ** 3,)),
    ),
    "one step": (lambda a, x: (soco_repaired(x, 5),), textbook.digits(lambda a, x: (soco(x, 5),))),
    "slices": (
        lambda a, x: (joint.slice_entry(2 * a, 4),),
        textbook.digits(lambda a, x: (textbook.demko(1 + 2 * a) * textbook.g(2 * a) ** 4,)),
    ),
}
every_formula = pytest.mark.parametrize("name", FORMULAS)


@every_formula
@settings(max_examples=40)
@given(a=wide_range, x=wide_range)
def test_floats_to_the_last_bits(name, a, x):
    function, text = FORMULAS[name]
    if name == "banded inverse":
        a = (1 + a) - 1  # the sum is a float
    for value, exact in zip(function(a, x), text(a, x), strict=True):
        assert ulps(value, exact) <= 1


@every_formula
@settings(max_examples=15)
@given(a=wide_range, x=wide_range)
def test_intervals_enclose(name, a, x):
    function, text = FORMULAS[name]
    if name == "banded inverse":
        a = max(a, 1.0)  # it takes 1 and 1 + a, whose difference cancels in intervals
    exact = text(a, x)
    values = function(mpmath.iv.mpf(a), mpmath.iv.mpf(x))
    balls = function(flint.arb(a), flint.arb(x))
    with mp.workdps(60):
        for value, ball, number in zip(values, balls, exact, strict=True):
            assert value.a <= number <= value.b
            assert encloses(ball, number)
            if name != "lambda" or x < 40:
                assert value.b - value.a <= abs(number) * mpf(10) ** -10


def encloses(ball, exact):
    """Whether a ball holds the number, told by its exact end points."""
    (m, e), (dm, de) = ball.mid().man_exp(), ball.rad().man_exp()
    with mp.workdps(400):
        middle, radius = mpf(int(m)) * mpf(2) ** int(e), mpf(int(dm)) * mpf(2) ** int(de)
        return abs(middle - exact) <= radius


@settings(max_examples=40)
@given(a=wide_range, x=wide_range, d=st.integers(1, 8), r=st.integers(1, 60))
def test_spatial_lower_bound_in_every_arithmetic(a, x, d, r):
    if not 1e-6 <= x <= 1e8:
        x = 10.0 ** (np.log10(x) / 40)  # the oracle subtracts: 2000 digits allow this
    exact = textbook_lower.spatial(x, d, r, dps=2000)
    assert ulps(lower.spatial_excess(x, d, r), exact) <= 2
    value = lower.spatial_excess(mpmath.iv.mpf(x), d, r)
    with mp.workdps(60):
        assert value.a <= exact <= value.b
    assert encloses(lower.spatial_excess(flint.arb(x), d, r), exact)


@settings(max_examples=15)
@given(a=small, x=small, p=st.floats(0.2, 1), q=st.floats(0.2, 1), n=st.integers(0, 9))
def test_joint_decay_in_every_arithmetic(a, x, p, q, n):
    exact = textbook_sharp.least_entry(a, x, n, n + 1, p, q)
    # one variable moves no more than a whole slice would: s_d of (E1)
    top = textbook.digits(lambda a, e: min(a / 2 * e, textbook.s(a, n + 1)))(a, exact)
    assert ulps(joint.top_bound(a, x, n + 1, n + 1, p, q), top) <= 8
    value = joint.top_bound(*map(mpmath.iv.mpf, (a, x)), n + 1, n + 1, *map(mpmath.iv.mpf, (p, q)))
    with mp.workdps(60):
        assert value.a <= top <= value.b
    ball = joint.top_bound(flint.arb(a), flint.arb(x), n + 1, n + 1, flint.arb(p), flint.arb(q))
    assert encloses(ball, top)


@pytest.mark.parametrize("kind", ["vi", "mix", "smooth"])
@settings(max_examples=12)
@given(a=small, a_S=small, Delta=st.integers(1, 8), k=st.integers(2, 9), r=st.integers(1, 9))
def test_sharp_ratio_in_intervals(kind, a, a_S, Delta, k, r):
    c = energy.Couplings(a, a_S, 2.0, Delta)
    shares, eta = best_shares(kind, c, 3 * r, k, r), 3 * r
    *_, exact = textbook_sharp.sharp_excess(kind, a, a_S, 2.0, Delta, eta, k, r, shares)
    lifted = energy.Couplings(mpmath.iv.mpf(a), mpmath.iv.mpf(a_S), mpmath.iv.mpf(2), Delta)
    value = sharp_excess(kind, lifted, eta, k, r, shares)
    with mp.workdps(60):
        assert value.a <= exact <= value.b or (mp.isinf(exact) and mp.isinf(value.b))
        if exact < 1:
            assert value.b - value.a <= exact * mpf(10) ** -9
    balls = energy.Couplings(flint.arb(a), flint.arb(a_S), flint.arb(2), Delta)
    ball = sharp_excess(kind, balls, eta, k, r, shares)
    assert encloses(ball, exact) if mp.isfinite(exact) and ball.is_finite() else not (exact < 1)


@pytest.mark.parametrize(("kind", "k", "r"), [("vi", 2, 1), ("mix", 2, 1), ("smooth", 2, 1)])
def test_sharp_ratio_at_rational_points(kind, k, r):
    shares = Shares(60, 70, 80)
    a, a_S = sympy.Rational(1, 3), sympy.Rational(1, 5)
    c = energy.Couplings(a, a_S, sympy.Integer(2), 3)
    value = sharp_excess(kind, c, 4, k, r, shares)
    with mp.workdps(40):
        *_, exact = textbook_sharp.sharp_excess(
            kind, mpf(1) / 3, mpf(1) / 5, mpf(2), 3, 4, k, r, shares, dps=60
        )
        found = mpf(str(sympy.N(value, 40)))
        assert abs(found - exact) <= mpf(10) ** -30 * exact


@pytest.mark.parametrize(
    "name", ["global sharp", "global repaired", "local repaired", "local stated"]
)
def test_formulas_at_rational_points(name):
    function, text = FORMULAS[name]
    for a, x in [
        (sympy.Rational(3, 2), sympy.Rational(3, 5)),
        (sympy.Integer(0), sympy.Rational(1, 7)),
    ]:
        with mp.workdps(50):
            numbers = text(mpf(a.p) / a.q, mpf(x.p) / x.q)
            for value, exact in zip(function(a, x), numbers, strict=True):
                assert abs(mpf(str(sympy.N(value, 40))) - exact) <= mpf(10) ** -35


def test_geometric_sum_of_symbols():
    p, q = sympy.symbols("p q", positive=True)
    for n in range(8):
        expected = sum(p**j * q ** (n - 1 - j) for j in range(n))
        assert sympy.expand(arithmetic.geometric_sum(p, q, n) - expected) == 0


def test_geometric_sum_of_many_lengths_at_once():
    n = np.arange(20)
    values = arithmetic.geometric_sum(0.5, 1.0, n)
    assert values.tolist() == [2 - 2.0 ** (1 - m) if m else 0.0 for m in range(20)]
    with pytest.raises(ValueError, match=">= 0"):
        arithmetic.geometric_sum(0.5, 1.0, -1)


def test_extremes_in_every_arithmetic():
    iv = mpmath.iv.mpf
    assert arithmetic.maximum(2.0, 3.0) == arithmetic.minimum(5.0, 3.0) == 3.0
    assert arithmetic.maximum(iv([1, 4]), iv([2, 3])) == iv([2, 4])
    assert arithmetic.minimum(iv([1, 4]), iv([2, 3])) == iv([1, 3])
    assert arithmetic.maximum(iv([1, 4]), 2) == arithmetic.maximum(2, iv([1, 4])) == iv([2, 4])
    assert arithmetic.maximum(flint.arb(2), 3) == arithmetic.maximum(3, flint.arb(2)) == 3
    assert arithmetic.minimum(mpf(2), mpf(3)) == 2
    a, b = sympy.symbols("a b", real=True)
    assert arithmetic.minimum(a, b).subs({a: 1, b: 2}) == 1
    assert arithmetic.maximum(np.array([1.0, 5.0]), 3.0).tolist() == [3.0, 5.0]


def test_kinds():
    kinds = [1, 2.0, np.ones(2), mpf(1), mpmath.iv.mpf(1), flint.arb(1), sympy.Integer(1)]
    found = [arithmetic.kind_of(x) for x in kinds]
    assert found == ["float", "float", "float", "mpmath", "interval", "arb", "sympy"]
    assert arithmetic.kind_of(1.0, sympy.Symbol("a")) == "sympy"


def test_arrays_take_the_same_values_as_numbers():
    a, x = np.logspace(-9, 9, 30), np.logspace(5, -5, 30)
    for name, (function, _) in FORMULAS.items():
        for i, values in enumerate(zip(*function(a, x), strict=True)):
            assert list(values) == list(function(float(a[i]), float(x[i]))), name
