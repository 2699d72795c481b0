import numpy as np
import pytest
import sympy
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from scipy.optimize import linprog

from nearsight.graphs import InputError
from nearsight.lpc.sets import Ball, Box, Constraints, Everywhere, Functions, kinds

ONE, ZERO = np.ones(1, dtype=int), np.zeros(1, dtype=int)
finite = st.floats(-1e6, 1e6)


def differences(feasible, y, h=1e-5):
    """Central differences of the constraints and of their gradients at one point."""
    n = len(y)
    slopes, bends = [], []
    for e in np.eye(n) * h:
        up, down = (feasible.constraints(ONE, ZERO, (y + s * e)[None]) for s in (1, -1))
        slopes.append((up[0][0] - down[0][0]) / (2 * h))
        bends.append((up[1][0] - down[1][0]) / (2 * h))
    return np.stack(slopes, axis=-1), np.stack(bends, axis=-1)


@pytest.mark.parametrize(
    "feasible",
    [
        Ball([0.5, -1.0], 2.0),
        Box([0.0, -np.inf], [1.0, 3.0]),
        Constraints(["x**2 + exp(y) - 3", "log(cosh(x - y)) - a"], ["x", "y"], {"a": 2.0}),
    ],
)
def test_derivatives_of_constraints(feasible):
    y = np.array([0.3, -0.4])
    _, slope, bend = feasible.constraints(ONE, ZERO, y[None])
    with np.errstate(invalid="ignore"):  # a bound that is not there: inf - inf
        slopes, bends = differences(feasible, y)
    there = np.isfinite(slopes)
    np.testing.assert_allclose(slope[0][there], slopes[there], atol=1e-8)
    np.testing.assert_allclose(bend[0], bends, atol=1e-8)


@given(arrays(float, (1, 3), elements=finite), arrays(float, 3, elements=finite), st.floats(0, 1e6))
def test_ball_projection_is_nearest(y, centre, radius):
    ball = Ball(centre, radius)
    found = ball.project(ONE, ZERO, y)
    size = 1 + np.abs(y).max() + np.abs(centre).max() + radius
    assert ball.violation(ONE, ZERO, found)[0] <= 1e-13 * size
    if ball.violation(ONE, ZERO, y)[0] <= 0:
        np.testing.assert_array_equal(found, y)
    # (y - found) is normal: no point of the ball lies beyond the tangent plane
    away = y[0] - found[0]
    farthest = centre + radius * away / max(np.linalg.norm(away), 1e-300)
    assert away @ (farthest - found[0]) <= 1e-12 * size**2


def test_ball_limits():
    ball = Ball([0.0], [1.0, np.inf, 0.0])
    v, t = np.arange(3), np.ones(3, dtype=int)
    y = np.full((3, 1), 1e200)
    np.testing.assert_array_equal(ball.project(t, v, y)[:, 0], [1.0, 1e200, 0.0])
    g, slope, bend = ball.constraints(t, v, np.ones((3, 1)))
    np.testing.assert_array_equal(g[:, 0], [0.0, -np.inf, 1.0])
    assert not slope[1].any()
    assert not bend[1].any()
    assert ball.violation(t, v, y)[1] == -np.inf
    np.testing.assert_array_equal(ball.interior(t[:2], v[:2]), np.zeros((2, 1)))
    with pytest.raises(InputError, match="agent 2: its interior is empty"):
        ball.interior(t, v)
    ball.check(5, 3, 4)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: Ball(0.0, -1.0), "-1; >= 0"),
        (lambda: Ball(np.inf, 1.0), "inf"),
        (lambda: Ball(0.0, [[1], [np.nan]]), "nan at step 2"),
        (lambda: Ball([0.0, 0.0], 1.0).check(1, 1, 3), "2 entries, not n = 3"),
        (lambda: Ball(0.0, [1.0, 1.0]).check(1, 3, 3), "radius of the ball"),
        (lambda: Box(1.0, 0.0), "no number is between 1 and 0"),
        (lambda: Box(np.nan, 0.0), "nan"),
        (lambda: Box(np.inf, np.inf), "no number"),
        (lambda: Box([[0.0], [1.0]], [[1.0], [1.0]]).interior(ONE, ZERO + 1), "agent 1: its int"),
    ],
)
def test_bad_balls_and_boxes(make, message):
    with pytest.raises(InputError, match=message):
        make()


def strictly_inside(texts, names, parameters=None):
    feasible = Constraints(texts, names, parameters)
    feasible.check(1, 1, len(names))
    y = feasible.interior(ONE, ZERO)
    assert y.shape == (1, len(names))
    assert feasible.constraints(ONE, ZERO, y)[0].max() < 0
    return y[0]


@pytest.mark.parametrize(
    ("texts", "names"),
    [
        (["(x - 1e6)**2 - 1"], "x"),
        (["x - 1e-3", "-x"], "x"),
        (["x - 1"], "x"),
        (["x - 1", "-1e9 - x", "x + 1e8"], "x"),
        (["exp(x) - 1e-9"], "x"),
        (["exp(x + y) - 5", "x**4 + y**4 - 100000", "-x - 1000*y"], "xy"),
        (["x + y + z - 1", "-x", "-y", "-z"], "xyz"),
        (["x**2 + y**2 - 1", "(x - 1.9999)**2 + y**2 - 1"], "xy"),
    ],
)
def test_interior_points_are_strictly_inside(texts, names):
    strictly_inside(texts, list(names))


def test_interior_of_a_lens_is_its_middle():
    y = strictly_inside(["x**2 + y**2 - 1", "(x - 1.9)**2 + y**2 - 1"], ["x", "y"])
    np.testing.assert_allclose(y, [0.95, 0.0], atol=1e-6)


@pytest.mark.parametrize("seed", range(5))
def test_deepest_point_of_a_polytope_agrees_with_linear_programming(seed):
    rng = np.random.default_rng(seed)
    A, b = rng.normal(size=(6, 2)), rng.uniform(-0.2, 0.5, 6)
    A = np.concatenate([A, [[1, 0], [-1, 0], [0, 1], [0, -1]]])
    b = np.concatenate([b, np.full(4, 0.5)])
    known = linprog([0, 0, 1], np.column_stack([A, -np.ones(10)]), b, bounds=(None, None))
    texts = [f"({a[0]})*x + ({a[1]})*y - ({c})" for a, c in zip(A, b, strict=True)]
    feasible = Constraints(texts, ["x", "y"])
    if known.fun > 1e-6:
        with pytest.raises(InputError, match="it is empty"):
            feasible.check(1, 1, 2)
    else:
        y = feasible.interior(ONE, ZERO)
        assert feasible.violation(ONE, ZERO, y)[0] == pytest.approx(known.fun, abs=1e-6)


@pytest.mark.parametrize(
    ("texts", "message"),
    [
        (["x - 1", "2 - x"], "it is empty, .* 0.5"),
        (["x**2 + 1"], "it is empty, .* 1"),
        (["x**2 - 1", "1 - x**2/2"], "not convex"),
        (["-x**2"], "step 1, agent 0: constraint '-x\\*\\*2' is not convex at y = "),
        (["log(x)"], "is not a number"),
        (["sin(x) - 2"], "not convex"),
        (["x + unknown"], "there are the names x"),
    ],
)
def test_bad_sets(texts, message):
    with pytest.raises(InputError, match=message):
        Constraints(texts, ["x"]).check(1, 1, 1)


def test_a_point_is_not_empty_but_has_no_interior():
    point = Constraints(["x**2"], ["x"])
    point.check(1, 1, 1)
    with pytest.raises(InputError, match="step 1, agent 0: no point with all g < 0"):
        point.interior(ONE, ZERO)


def test_an_interior_without_a_negative_constraint_is_said_to_be_so():
    def beyond(y):
        return np.maximum(np.abs(y) - 1, 0)

    flat = Functions(
        1,
        lambda t, v, y: beyond(y) ** 3,
        lambda t, v, y: (3 * beyond(y) ** 2 * np.sign(y))[:, :, None],
        lambda t, v, y: (6 * beyond(y))[:, :, None, None],
        constant=True,
    )
    flat.check(4, 4, 1)
    with pytest.raises(InputError, match="strictly feasible point"):
        flat.interior(ONE, ZERO)
    with pytest.raises(InputError, match="cannot be saved"):
        flat.fields()
    assert flat.everywhere is False


def test_sets_that_change_with_step_and_agent():
    rng = np.random.default_rng(0)
    a, r = rng.normal(size=(7, 1)) * 100, rng.uniform(0.1, 2, size=(1, 5))
    discs = Constraints(["(x - a)**2 + y**2 - r**2"], sympy.symbols("x y"), {"a": a, "r": r})
    assert discs.constant == (False, False)
    discs.check(7, 5, 2)
    t, v = rng.integers(1, 8, 30), rng.integers(0, 5, 30)
    y = discs.interior(t, v)
    np.testing.assert_allclose(y[:, 0], a[t - 1, 0], atol=2.1)
    assert (discs.violation(t, v, y) < 0).all()
    np.testing.assert_array_equal(discs.interior(t[3:4], v[3:4])[0], y[3])
    fresh = Constraints(discs.expressions, discs.variables, discs.parameters)
    np.testing.assert_array_equal(fresh.interior(t[3:4], v[3:4])[0], y[3])
    with pytest.raises(InputError, match="parameter r"):
        discs.check(7, 4, 2)
    bad = np.full((7, 5), 1.0)
    bad[2, 3] = -1.0
    with pytest.raises(InputError, match="step 3, agent 3: it is empty"):
        Constraints(["x**2 - b"], ["x"], {"b": bad}).check(7, 5, 1)


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda f: Functions(0, f, f, f), "size = 0"),
        (lambda f: Functions(1, f, f, None), "hessian of constraints"),
        (lambda f: Functions(1, f, f, f).check(1, 1, 1), "constraints of shapes"),
        (lambda f: Functions(1, f, f, f).check(1, 1, 2), "1 entries, not n = 2"),
    ],
)
def test_bad_functions(make, message):
    with pytest.raises(InputError, match=message):
        make(lambda t, v, y: y)


def test_every_kind_is_found():
    assert set(kinds()) >= {"ball", "box", "constraints", "everywhere", "functions"}
    assert Everywhere().fields() == {}
