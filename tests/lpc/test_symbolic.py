import itertools
import pickle

import mpmath
import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st

from nearsight.graphs import InputError
from nearsight.lpc.costs import Symbolic
from nearsight.lpc.costs.expression import FUNCTIONS, parse, write


def test_symbolic_in_several_variables_with_parameters():
    a = np.random.default_rng(0).normal(size=(3, 2))
    x, y, theta = sympy.symbols("x y theta")
    formula = (x - theta) ** 2 + sympy.exp(-(y**2)) + y**2 * 3 + sympy.log(sympy.cosh(x - y))
    cost = Symbolic(formula, [x, y], {"theta": a}, lower=0, upper=12)
    for step, member in itertools.product((1, 2, 3), (0, 1)):
        w = np.array([[0.3, -0.2]])
        t, i = np.array([step]), np.array([member])
        at = {x: 0.3, y: -0.2, theta: a[step - 1, member]}
        true = formula.subs(at)
        assert cost.value(t, i, w)[0] == pytest.approx(float(true), rel=1e-13)
        for j, u in enumerate((x, y)):
            slope = float(formula.diff(u).subs(at))
            assert cost.gradient(t, i, w)[0, j] == pytest.approx(slope, rel=1e-12)
            for k, v in enumerate((x, y)):
                bend = float(formula.diff(u, v).subs(at))
                assert cost.hessian(t, i, w)[0, j, k] == pytest.approx(bend, rel=1e-12)
    assert cost.steady
    cost.check(3, 2, 2, "node cost")
    again = pickle.loads(pickle.dumps(cost))  # noqa: S301 - made by this test
    np.testing.assert_array_equal(again.value(t, i, w), cost.value(t, i, w))


def test_points_do_not_see_each_other():
    cost = Symbolic("log(cosh(x - a)) + exp(-x) + sqrt(1 + x**4)", ["x"], {"a": 1.3}, upper=99)
    rng = np.random.default_rng(3)
    w = rng.normal(size=(257, 1)) * 10 ** rng.uniform(-2, 2, (257, 1))
    w[100] = -1e3  # exp overflows here, and is recomputed
    t, i = np.ones(257, dtype=int), np.zeros(257, dtype=int)
    whole = cost.value(t, i, w), cost.gradient(t, i, w), cost.hessian(t, i, w)
    for j in (0, 3, 99, 100, 101, 255, 256):
        one = slice(j, j + 1)
        alone = cost.value(t[one], i[one], w[one]), cost.gradient(t[one], i[one], w[one])
        np.testing.assert_array_equal(alone[0], whole[0][one])
        np.testing.assert_array_equal(alone[1], whole[1][one])
        np.testing.assert_array_equal(cost.hessian(t[one], i[one], w[one]), whole[2][one])
    assert cost.value(t[:0], i[:0], w[:0]).shape == (0,)


def test_constant_curvature_is_derived_exactly():
    cost = Symbolic(
        "b*(x - 2*y)**2 + (x + y)**2/c", ["x", "y"], {"b": [[0.3], [1.7]], "c": [3, 7.0]}
    )
    bounds = cost.curvature()
    assert bounds.source == "exact"
    assert not cost.steady
    for step, member in itertools.product(range(2), range(2)):
        b, c = [0.3, 1.7][step], [3, 7][member]
        H = np.array([[2 * b + 2 / c, -4 * b + 2 / c], [-4 * b + 2 / c, 8 * b + 2 / c]])
        values = np.linalg.eigvalsh(H)
        assert abs(values[0] - bounds.lower[step, member]) <= bounds.error[step, member]
        assert abs(values[1] - bounds.upper[step, member]) <= bounds.error[step, member]
    assert bounds.error.max() < 1e-13
    plain = Symbolic("a*x**2/2 + x*(x + 1) - x", ["x"], {"a": 1.5}).curvature()
    assert (plain.lower[0, 0], plain.source) == (3.5, "exact")
    assert Symbolic("(x - a)**2", ["x"], {"a": [[1], [2]]}).steady


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Symbolic("x**4", ["x"]), "say upper"),
        (lambda: Symbolic("x**4", ["x"], lower=2, upper=1), "0 <= lower <= upper"),
        (lambda: Symbolic("x**2", ["x"], upper=1.5), "upper curvature claimed as 1.5.*it is 2"),
        (lambda: Symbolic("-x**2", ["x"]), "not convex, eigenvalue -2"),
        (lambda: Symbolic("x*y", ["x", "y"]), "not convex, eigenvalue -1"),
        (lambda: Symbolic("a*x**2", ["x"], {"a": [[1], [-1]]}), "step 2, .*not convex"),
        (lambda: Symbolic("a*x**2", ["x"], {"a": np.nan}), "parameter a: nan"),
        (lambda: Symbolic("x**2", ["x", "x"]), "twice"),
        (lambda: Symbolic("x**2", []), "at least one"),
        (lambda: Symbolic("x**2", ["exp"]), "has a meaning"),
        (lambda: Symbolic("x**2", ["2x"]), "a name such as"),
        (lambda: Symbolic("sqrt(x**2)", ["x"], upper=1), "not twice differentiable"),
        (lambda: Symbolic(sympy.Abs(sympy.Symbol("x")), ["x"], upper=1), "Abs"),
        (lambda: Symbolic(3j, ["x"], upper=1), "not accepted"),
        (lambda: Symbolic("x**2", ["x"]).check(1, 1, 2, "node cost"), "1 variables where 2"),
        (
            lambda: Symbolic("a*x**2", ["x"], {"a": [1, 2]}).check(1, 3, 1, "node cost"),
            "parameter a of the node cost",
        ),
        (
            lambda: Symbolic("log(cosh(2*x))", ["x"], upper=3.9).check(2, 2, 1, "node cost"),
            "above the upper bound 3.9",
        ),
        (
            lambda: Symbolic("x**2 + log(cosh(x))", ["x"], lower=2.1, upper=3).check(1, 1, 1, "f"),
            "below the lower bound 2.1",
        ),
        (
            lambda: Symbolic("sin(x)", ["x"], upper=1).check(1, 1, 1, "node cost"),
            "node cost at step 1, .*point w = .*not convex",
        ),
        (lambda: Symbolic("log(x)", ["x"], upper=1).check(1, 1, 1, "f"), "not finite"),
        (
            lambda: Symbolic("log(cosh(x)) - 0.01", ["x"], upper=1).check(1, 1, 1, "f"),
            "costs are nonnegative",
        ),
    ],
)
def test_bad_formula_costs(make, message):
    with pytest.raises(InputError, match=message) as caught:
        make()
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    "text",
    [
        "__import__('os')",
        "x.real",
        "x[0]",
        "(lambda: x)()",
        "x if x else x",
        "x and x",
        "x < 1",
        "x ^ 2",
        "x // 2",
        "'x'",
        "True",
        "1j",
        "y",
        "Abs(x)",
        "exp(x, x)",
        "exp(x=x)",
        "exp(*x)",
        "x +",
        "x; x",
        "",
        "\x00",
        "9**9**9**9",
        "((9**60)**60)**60",
        "x**1000",
        "1/0",
        "log(0)",
        "(" * 500 + "x" + ")" * 500,
        "x" * 30_000,
        "-" * 19_000 + "x",
    ],
)
def test_parser_refuses(text):
    with pytest.raises(InputError) as caught:
        parse(text, ["x"])
    assert "\n" not in str(caught.value)
    assert len(str(caught.value)) < 400


leaves = st.one_of(
    st.sampled_from(["x", "y", "pi", "E"]),
    st.integers(0, 9).map(str),
    st.floats(0.01, 100, allow_nan=False).map(repr),
)
formulas = st.recursive(
    leaves,
    lambda inner: st.one_of(
        st.tuples(inner, st.sampled_from("+-*/"), inner).map(lambda p: f"({p[0]} {p[1]} {p[2]})"),
        st.tuples(inner, st.sampled_from(["2", "3", "-1", "0.5", "1/3"])).map(
            lambda p: f"({p[0]})**({p[1]})"
        ),
        st.tuples(st.sampled_from(FUNCTIONS), inner).map(lambda p: f"{p[0]}({p[1]})"),
    ),
    max_leaves=6,
)


@given(formulas)
def test_text_to_expression_and_back(text):
    try:
        first = parse(text, ["x", "y"])
    except InputError:
        return  # 1/0 and the like
    try:
        second = parse(write(first), ["x", "y"])
    except InputError as error:
        assert "not accepted" in str(error)  # noqa: PT017 - Abs(x) or I came out
        return
    assert set(first.free_symbols) == set(second.free_symbols)
    at = {"x": sympy.Rational(3, 7), "y": sympy.Rational(11, 5)}
    values = [evaluated(e, at) for e in (first, second)]
    if all(v is not None for v in values):
        size = max(1, abs(values[0]))
        assert abs(values[0] - values[1]) <= 1e-9 * size


def evaluated(expression, at):
    """Return a number in 30 digits; None where it overflows or is not real."""
    expression = expression.replace(
        lambda e: e.func.__name__ in ("logcosh", "softplus"),
        lambda e: sympy.log(
            sympy.cosh(e.args[0]) if e.func.__name__ == "logcosh" else 1 + sympy.exp(e.args[0])
        ),
    )
    try:
        value = expression.subs({s: at[str(s)] for s in expression.free_symbols}).evalf(30)
        found = complex(value)
    except (TypeError, OverflowError, ValueError, MemoryError):
        return None
    return found if np.isfinite(found) else None


def test_floats_of_any_precision_survive():
    x = sympy.Symbol("x")
    for number in (0.1, 1e-300, 1.7976931348623157e308, sympy.Float("0.1", 40), sympy.pi**2):
        text = write(number * x if not isinstance(number, float) else sympy.Float(number) * x)
        with mpmath.workdps(50):
            back = parse(text, ["x"]).subs(sympy.Symbol("x", real=True), 1)
            assert abs(sympy.N(back - number, 50)) <= abs(sympy.N(number, 50)) * 1e-49
