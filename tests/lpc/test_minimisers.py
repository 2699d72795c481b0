import dataclasses

import numpy as np
import pytest

from nearsight.lpc.costs import Quadratic
from nearsight.lpc.minimisers import minimisers_at, node_minimisers
from nearsight.lpc.sets import Ball, Box, Everywhere

from .support import COSTS, SETS, clarabel_error, oracle, random_problem


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("feasible", SETS)
@pytest.mark.parametrize("costs", COSTS)
def test_they_agree_with_clarabel_one_by_one(costs, feasible, n):
    problem = random_problem(4, n, 2, costs, feasible)
    zero = Quadratic(np.zeros((2 * n, 2 * n)))
    bare = dataclasses.replace(problem, temporal=zero, spatial=zero)
    theta = node_minimisers(problem)
    assert theta.shape == (2, 5, n)
    for t, v in ((1, 0), (2, 3)):
        nobody = {(s, u): np.zeros(n) for s in range(4) for u in range(5) if (s, u) != (t, v)}
        answer = oracle(bare, [(t, v)], nobody)[0]
        assert theta[t - 1, v] == pytest.approx(answer, abs=clarabel_error(problem))


@pytest.mark.parametrize("feasible", ["box", "ball"])
@pytest.mark.parametrize("n", [1, 2, 3])
def test_quadratics_satisfy_the_optimality_condition(feasible, n):
    problem = random_problem(6, n, 3, feasible=feasible)
    t, v = np.repeat([1, 2, 3], 5), np.tile(np.arange(5), 3)
    theta = node_minimisers(problem).reshape(-1, n)
    slope = problem.node.gradient(t, v, theta)
    step = problem.feasible.project(t, v, theta - slope)
    assert np.abs(step - theta).max() <= 1e-12


@pytest.mark.parametrize("costs", COSTS)
@pytest.mark.parametrize("feasible", SETS)
def test_each_depends_on_nothing_but_its_own_cost_and_set(costs, feasible):
    problem = random_problem(4, 2, 3, costs, feasible)
    theta = node_minimisers(problem)
    for t, v in ((1, 0), (3, 4), (2, 2)):
        assert np.array_equal(
            minimisers_at(problem, np.array([t]), np.array([v]))[0], theta[t - 1, v]
        )


def test_closed_forms_are_exact():
    base = random_problem(1, 2, 3)
    centre = np.array([0.3, -7.0])
    even = dataclasses.replace(base, node=Quadratic(3 * np.eye(2), centre))
    steep = dataclasses.replace(base, node=Quadratic(np.diag([1.0, 100.0]), centre))
    assert (node_minimisers(dataclasses.replace(even, feasible=Everywhere())) == centre).all()
    assert (node_minimisers(dataclasses.replace(steep, feasible=Box(-1, 1))) == [0.3, -1.0]).all()
    ball = node_minimisers(dataclasses.replace(even, feasible=Ball(0.0, 1.0)))
    assert ball == pytest.approx(
        np.broadcast_to(centre / np.linalg.norm(centre), ball.shape), rel=1e-15
    )
    assert node_minimisers(even).strides[0] == 0  # one step stands for all
    assert not ball.flags.writeable
