import numpy as np
import pytest

from nearsight.graphs import InputError
from nearsight.lpc.barrier import Barrier, with_barrier
from nearsight.lpc.costs import Quadratic
from nearsight.lpc.local import LocalProblem
from nearsight.lpc.offline import optimum
from nearsight.lpc.sets import Box

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
