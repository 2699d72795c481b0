import itertools

import mpmath
import numpy as np
import pytest

from nearsight.graphs import InputError
from nearsight.lpc.costs import (
    Callables,
    Hyperbola,
    LogCosh,
    Mixture,
    Quadratic,
    Softplus,
    Symbolic,
    probe,
    stable,
)

ONE, ZERO = np.ones(1, dtype=int), np.zeros(1, dtype=int)


def places(m, H=1, count=1, seed=0):
    rng = np.random.default_rng(seed)
    return rng.integers(1, H + 1, m), rng.integers(0, count, m)


def assert_derivatives(cost, true, w, digits=12):
    """Compare one cost at w (m, s) with a function of mpmath numbers and its derivatives."""
    m, s = w.shape
    t, i = np.ones(m, dtype=int), np.zeros(m, dtype=int)
    found = cost.value(t, i, w), cost.gradient(t, i, w), cost.hessian(t, i, w)
    with mpmath.workdps(60):
        for j, point in enumerate(w):
            x = [mpmath.mpf(float(v)) for v in point]
            for order, got in zip(range(3), (f[j] for f in found), strict=True):
                scale = max(1.0, float(np.max(np.abs(got), initial=0.0)))
                for index in itertools.product(range(s), repeat=order):
                    exact = difference(true, x, index)
                    assert abs(float(got[index]) - exact) <= 10.0**-digits * scale, (point, index)


def difference(true, x, index):
    """Central differences of order up to two, in 60 digits."""
    if not index:
        return true(*x)
    h = mpmath.mpf(10) ** -12
    up, down = list(x), list(x)
    up[index[0]] += h
    down[index[0]] -= h
    return (difference(true, up, index[1:]) - difference(true, down, index[1:])) / (2 * h)


POINTS = np.array([[0.0], [1e-9], [0.3], [-0.7], [1.0], [-3.0], [17.0], [-40.0], [400.0], [2e5]])


@pytest.mark.parametrize(
    ("cost", "true"),
    [
        (LogCosh([[1.0]]), lambda x: mpmath.log(mpmath.cosh(x))),
        (Softplus([[1.0]]), lambda x: mpmath.log1p(mpmath.exp(x))),
        (Hyperbola([[1.0]]), lambda x: mpmath.sqrt(1 + x * x) - 1),
        (Symbolic("log(cosh(x))", ["x"], upper=1), lambda x: mpmath.log(mpmath.cosh(x))),
        (Symbolic("log(1 + exp(-x))", "x", upper=0.25), lambda x: mpmath.log1p(mpmath.exp(-x))),
        (Symbolic("sqrt(4 + 9*x**2)", ["x"], upper=4.5), lambda x: mpmath.sqrt(4 + 9 * x * x)),
        (Symbolic("sqrt(1 + x**4)", ["x"], upper=9), lambda x: mpmath.sqrt(1 + x**4)),
    ],
)
def test_profiles_agree_with_sixty_digits(cost, true):
    assert_derivatives(cost, true, POINTS)


def test_profiles_keep_relative_accuracy_and_never_overflow():
    z = np.concatenate([[0.0], *(s * np.geomspace(1e-150, 1e300, 80) for s in (1, -1))])
    with mpmath.workdps(400):
        for name, true in (
            ("logcosh", lambda u: abs(u) - mpmath.log(2) + mpmath.log1p(mpmath.exp(-2 * abs(u)))),
            ("softplus", lambda u: max(u, 0) + mpmath.log1p(mpmath.exp(-abs(u)))),
            ("hyperbola", lambda u: mpmath.sqrt(1 + u * u)),
            ("bell", lambda u: mpmath.sech(u) ** 2 if abs(u) < 1e4 else 0),
        ):
            found = getattr(stable, name)(z)
            exact = np.array([float(true(mpmath.mpf(float(u)))) for u in z])
            np.testing.assert_allclose(found, exact, rtol=1e-13, atol=1e-300)


@pytest.mark.parametrize("kind", [LogCosh, Softplus, Hyperbola])
def test_ridge_derivatives_and_curvature(kind):
    rng = np.random.default_rng(1)
    A, b, c = rng.normal(size=(3, 2)), rng.normal(size=3), rng.uniform(0.5, 2, size=3)
    cost = kind(A, b, c, base=0.7, centre=[0.2, -1.0])
    phi = {
        LogCosh: lambda z: mpmath.log(mpmath.cosh(z)),
        Softplus: lambda z: mpmath.log1p(mpmath.exp(z)),
        Hyperbola: lambda z: mpmath.sqrt(1 + z * z) - 1,
    }[kind]

    def true(x, y):
        ridges = sum(c[j] * phi(A[j, 0] * x + A[j, 1] * y - b[j]) for j in range(3))
        return ridges + mpmath.mpf(0.7) / 2 * ((x - 0.2) ** 2 + (y + 1) ** 2)

    assert_derivatives(cost, true, rng.normal(size=(4, 2)) * 3)
    # three lines in the plane do not meet: a bound only; two do: attained
    assert cost.curvature().source == "bound"
    pair = kind(A[:2], b[:2], c[:2], base=0.7)
    meeting = np.linalg.solve(A[:2], b[:2])[None]
    top = np.linalg.eigvalsh(pair.hessian(ONE, ZERO, meeting)[0])[-1]
    bounds = pair.curvature()
    assert bounds.source == "exact"
    assert abs(top - bounds.upper[0, 0]) <= bounds.error[0, 0]
    assert bounds.lower[0, 0] == 0.7
    seen = probe(cost, 1, 1, "ridge")
    assert seen.lower == pytest.approx(0.7, abs=1e-12)
    assert seen.upper <= cost.curvature().upper[0, 0] * (1 + 1e-12)


def test_a_single_ridge_with_unit_directions_is_exact_without_error():
    bounds = LogCosh([[[1.0, -1.0]]], weights=[[[0.3]], [[0.25]]], base=0.5).curvature()
    np.testing.assert_array_equal(bounds.upper[:, 0], [1.1, 1.0])
    assert bounds.error[1, 0] == 0
    assert LogCosh([[1.0, 2.0]]).curvature().upper[0, 0] == pytest.approx(5)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: LogCosh(np.zeros((0, 2))), "is empty"),
        (lambda: LogCosh([[1.0]], weights=-1.0), "weights .* >= 0"),
        (lambda: Softplus([[1.0]], shifts=[1.0, 2.0]), "shifts .* 2 entries"),
        (lambda: Softplus([[1.0]], base=np.nan), "base .* nan"),
        (lambda: Hyperbola(np.ones((2, 3, 1, 1)), base=np.ones((2, 4))), "do not fit"),
        (lambda: LogCosh([[1.0]]).check(3, 2, 2, "node cost"), "node cost: a ridge of 1"),
        (lambda: LogCosh(np.ones((2, 1, 1, 1))).check(3, 2, 1, "node cost"), "directions"),
    ],
)
def test_bad_ridges(make, message):
    with pytest.raises(InputError, match=message):
        make()


def functions(**changes):
    parts = {
        "size": 1,
        "value": lambda t, i, w: w[:, 0] ** 2 * t,
        "gradient": lambda t, i, w: 2 * w * t[:, None],
        "hessian": lambda t, i, w: np.broadcast_to(2.0 * t[:, None, None], (len(w), 1, 1)),
        "lower": [[2.0], [4.0]],
        "upper": [[2.0], [4.0]],
    }
    return Callables(**{**parts, **changes})


def test_callables():
    cost = functions()
    cost.check(2, 3, 1, "node cost")
    assert cost.curvature().source == "claimed"
    assert not cost.steady
    t, i = places(5, 2)
    np.testing.assert_array_equal(cost.value(t, i, np.full((5, 1), 3.0)), 9.0 * t)
    with pytest.raises(InputError, match="cannot be saved"):
        cost.fields()


@pytest.mark.parametrize(
    ("changes", "message"),
    [
        ({"size": 0}, "size = 0"),
        ({"value": 3}, "value of a cost"),
        ({"lower": np.nan}, "nan"),
        ({"lower": 5.0}, "0 <= lower <= upper"),
        ({"upper": 3.0, "lower": 0.0}, "step 2.*above the upper"),
        ({"gradient": lambda t, i, w: 3 * w * t[:, None]}, "gradient is not the derivative"),
        (
            {"hessian": lambda t, i, w: np.full((len(w), 1, 1), 3.0), "lower": 0, "upper": 9},
            "Hessian is not the derivative",
        ),
        ({"value": lambda t, i, w: w**2}, r"value at .* has shape \(.*, 1\)"),
        ({"value": lambda t, i, w: w[:, 0] * np.nan}, "value is not finite"),
        ({"value": lambda t, i, w: w[:, 0] ** 2 * t - 1}, "nonnegative"),
    ],
)
def test_bad_callables(changes, message):
    with pytest.raises(InputError, match=message):
        functions(**changes).check(2, 3, 1, "node cost")


def test_mixture_picks_and_sums():
    quadratic = Quadratic([[2.0]], [[1.0], [2.0]])
    ridge = LogCosh([[1.0]], base=1.0)
    picked = Mixture([quadratic, ridge], [[1, 0], [0, 1]])
    w, i = np.array([[0.5], [0.5]]), np.array([0, 1])
    t = np.ones(2, dtype=int)
    expected = [quadratic.value(t, i, w)[0], ridge.value(t, i, w)[1]]
    np.testing.assert_array_equal(picked.value(t, i, w), expected)
    bounds = picked.curvature()
    assert bounds.source == "exact"
    assert bounds.error[0, 0] == 0
    np.testing.assert_array_equal(bounds.upper, [[2.0, 2.0]])
    both = Mixture([quadratic, ridge], [0.5, [[1.0], [3.0]]])
    assert both.curvature().source == "bound"
    assert not both.steady
    assert picked.steady
    np.testing.assert_array_equal(both.curvature().lower[:, 0], [2.0, 4.0])
    for step in (1, 2):
        weight = [1.0, 3.0][step - 1]
        t = np.full(2, step)
        for method in ("value", "gradient", "hessian"):
            parts = [getattr(cost, method)(t, i, w) for cost in (quadratic, ridge)]
            expected = 0.5 * parts[0] + weight * parts[1]
            np.testing.assert_allclose(getattr(both, method)(t, i, w), expected, rtol=1e-15)
    claimed = Symbolic("log(cosh(x))", ["x"], upper=1)
    assert Mixture([quadratic, claimed], [1, 1]).curvature().source == "claimed"
    assert Mixture([quadratic, claimed], [1, 0]).curvature().source == "exact"
    both.check(2, 2, 1, "node cost")


def test_a_part_without_weight_is_not_evaluated():
    def never(*_):
        raise ZeroDivisionError

    broken = Callables(1, never, never, never, 0, 1)
    cost = Mixture([Quadratic([[1.0]]), broken], [1, 0])
    assert cost.value(ONE, ZERO, np.array([[2.0]]))[0] == 2.0


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda q: Mixture([], []), "0 parts"),
        (lambda q: Mixture([q, q], [1]), "2 parts and 1 weights"),
        (lambda q: Mixture([q], [[1, -1]]), "agent or edge 1: -1"),
        (lambda q: Mixture([q, Quadratic(np.eye(2))], [1, 1]), r"\[1, 2\]"),
        (lambda q: Mixture([q], [np.nan]), "nan"),
        (lambda q: Mixture([q, q], [[1, 1], [1, 1, 1]]), "do not fit"),
        (lambda q: Mixture([q], [[1, 1]]).check(1, 3, 1, "node cost"), "weight 0 of the node"),
        (lambda q: Mixture([q], [1]).check(1, 3, 2, "node cost"), "part 0 of the node cost"),
    ],
)
def test_bad_mixtures(make, message):
    with pytest.raises(InputError, match=message):
        make(Quadratic([[1.0]]))


def test_quadratic_refuses_what_is_not_convex():
    with pytest.raises(InputError, match="step 1, agent or edge 1: not convex, eigenvalue -1"):
        Quadratic([np.eye(2), [[1, 2], [2, 1]]])
