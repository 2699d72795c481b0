import numpy as np
import pytest

from nearsight.graphs import InputError, parse_graph
from nearsight.lpc import Controller, Problem
from nearsight.lpc.barrier import Barrier, with_barrier
from nearsight.lpc.costs import LogCosh, Quadratic
from nearsight.lpc.local import LocalProblem
from nearsight.lpc.offline import optimum
from nearsight.lpc.sets import Ball, Box, Constraints

from .support import COSTS, random_problem


@pytest.mark.parametrize("feasible", ["box", "ball", "formulas"])
@pytest.mark.parametrize("n", [1, 2])
def test_derivatives_are_those_of_the_value(feasible, n):
    problem = random_problem(3, n, feasible=feasible)
    barrier = Barrier(problem.node, problem.feasible, 0.37)
    t, v = np.repeat([1, 2, 3, 4], 5), np.tile(np.arange(5), 4)
    y = problem.feasible.interior(t, v) + 0.01
    h = 1e-5
    for j in range(n):
        up, down = y + h * np.eye(n)[j], y - h * np.eye(n)[j]
        rise = (barrier.value(t, v, up) - barrier.value(t, v, down)) / (2 * h)
        bend = (barrier.gradient(t, v, up) - barrier.gradient(t, v, down)) / (2 * h)
        assert barrier.gradient(t, v, y)[:, j] == pytest.approx(rise, rel=1e-5, abs=1e-6)
        assert barrier.hessian(t, v, y)[:, j] == pytest.approx(bend, rel=1e-5, abs=1e-6)


def test_it_is_infinite_outside_and_on_the_boundary():
    barrier = Barrier(Quadratic(np.eye(1)), Box(0.0, 1.0), 1.0)
    one = np.ones(5, dtype=np.int64)
    y = np.array([[-0.1], [0.0], [0.5], [1.0], [1.1]])
    assert np.isinf(barrier.value(one, 0 * one, y)).tolist() == [True, True, False, True, True]
    assert barrier.curvature().upper == np.inf
    with pytest.raises(InputError, match="strength"):
        Barrier(Quadratic(np.eye(1)), Box(0.0, 1.0), 0.0)


def test_one_agent_has_the_root_of_a_quadratic():
    # minimise (y - 2)^2 / 2 - s ln(1 - y): (y - 2)(1 - y) + s = 0
    problem = random_problem(1)
    bare = with_barrier(
        type(problem)(problem.network, 1, Quadratic(np.eye(1), 2.0), feasible=Box(-np.inf, 1.0)),
        1e-3,
    )
    exact = (3 - np.sqrt(1 + 4e-3)) / 2
    assert optimum(bare).x.ravel() == pytest.approx(exact, rel=1e-13)


@pytest.mark.parametrize("feasible", ["box", "ball", "formulas"])
@pytest.mark.parametrize("costs", COSTS)
def test_the_gap_is_at_most_constraints_times_strength(costs, feasible):
    problem = random_problem(7, 2, 3, costs, feasible)
    best = optimum(problem)
    t, v = np.repeat([1, 2, 3], 5), np.tile(np.arange(5), 3)
    g = problem.feasible.constraints(t, v, np.zeros((15, 2)))[0]
    constraints = np.isfinite(g).sum()
    last = np.inf
    for strength in (1.0, 1e-2, 1e-4, 1e-6):
        found = optimum(with_barrier(problem, strength))
        assert found.converged
        assert found.residual <= 1e-7
        excess = problem.cost(found.x) - best.cost
        assert -1e-12 * best.cost <= excess <= constraints * strength
        assert problem.feasible.violation(t, v, found.x.reshape(-1, 2)).max() < 0
        wrong = np.abs(found.x - best.x).max()
        assert wrong < last
        last = wrong
    assert last <= 1e-3


def test_local_problems_of_a_barrier_converge_too():
    problem = random_problem(7, 2, 5, feasible="ball")
    plain = LocalProblem(problem, 2, 1, 3, 2)
    y, z = plain.default_boundary(problem.x_0)
    best = plain.solve(y, z)
    wrong = [
        np.abs(LocalProblem(with_barrier(problem, s), 2, 1, 3, 2).solve(y, z) - best).max()
        for s in (1e-2, 1e-4, 1e-6)
    ]
    assert wrong[2] < wrong[1] < wrong[0]
    assert wrong[2] <= 1e-3


def test_discs_as_formulas_never_stop_the_controller():
    rng, network = np.random.default_rng(0), parse_graph("ring:5")
    for _ in range(5):
        node = LogCosh(rng.normal(size=(4, 5, 2, 2)), rng.normal(size=(4, 5, 2)), 1.0, 0.8)
        m = rng.normal(size=(4, 5, 4, 4))
        c, R = 0.3 * rng.normal(size=(4, 5, 2)), rng.uniform(0.2, 1, size=(4, 5))
        disc = Constraints(
            ["(a-x)**2+(b-y)**2-r**2"], ["a", "b"], {"x": c[..., 0], "y": c[..., 1], "r": R}
        )
        pairs = Quadratic(m @ m.swapaxes(2, 3))
        one, two = (Problem(network, 4, node, pairs, pairs, s, 1.0) for s in (Ball(c, R), disc))
        exact, mine = Controller(one, 3, 1, "descent", tolerance=1e-13), Controller(two, 3, 1)
        x = one.x_0
        for t in range(1, 5):
            best = exact.step(t, x)
            np.testing.assert_allclose(mine.step(t, x), best, atol=1e-8)
            x = best


def test_stiff_costs_in_a_small_box_converge():
    box = Constraints(["-.1-a", "a-.1", "-.1-b", "b-.1"], ["a", "b"])
    for condition in (1.0, 1e4, 1e6):
        node = Quadratic(np.diag([1.0, condition]), np.random.default_rng(1).normal(size=(4, 5, 2)))
        found = optimum(Problem(parse_graph("ring:5"), 4, node, feasible=box))
        exact = optimum(Problem(parse_graph("ring:5"), 4, node, feasible=Box(-0.1, 0.1)))
        assert found.converged
        np.testing.assert_allclose(found.x, exact.x, atol=1e-8)
