import dataclasses

import numpy as np
import pytest

from nearsight.graphs import NearsightError, Network
from nearsight.lpc import Problem
from nearsight.lpc.costs import LogCosh, Quadratic, Softplus
from nearsight.lpc.minimisers import minimisers_at, node_minimisers
from nearsight.lpc.sets import Ball, Box, Constraints, Everywhere

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


def formula_sets(n, rng, count):
    """Boxes and balls, and the same sets as formulas."""
    names = [f"y{j}" for j in range(n)]
    centre, size = 0.3 * rng.normal(size=(1, count, n)), rng.uniform(0.2, 1, size=(1, count))
    given = {"r": size} | {f"c{j}": centre[..., j] for j in range(n)}
    disc = "+".join(f"(y{j}-c{j})**2" for j in range(n)) + "-r**2"
    sides = [f"{s}*(y{j}-c{j})-r" for j in range(n) for s in (1, -1)]
    box = Box(centre - size[..., None], centre + size[..., None])
    return (
        (Ball(centre, size), Constraints([disc], names, given)),
        (box, Constraints(sides, names, given)),
    )


@pytest.mark.parametrize("kind", [Quadratic, LogCosh, Softplus])
@pytest.mark.parametrize("n", [1, 2, 3])
def test_formulas_have_the_minimisers_of_the_sets_they_describe(kind, n):
    rng, count = np.random.default_rng(n), 30
    aim = 2 * rng.normal(size=(1, count, n))
    if kind is Quadratic:
        root = rng.normal(size=(1, count, n, n))
        node = Quadratic(root @ root.swapaxes(2, 3) + 0.1 * np.eye(n), aim)
    else:
        a, b = rng.normal(size=(1, count, 2, n)), rng.normal(size=(1, count, 2))
        node = kind(a, b, 1.0, 0.8, aim)
    network = Network.from_edges(count, [])
    for plain, formulas in formula_sets(n, rng, count):
        one, other = (Problem(network, 1, node, feasible=s) for s in (plain, formulas))
        np.testing.assert_allclose(node_minimisers(other), node_minimisers(one), atol=1e-10)


def test_a_minimiser_is_right_or_an_error(monkeypatch):
    node = LogCosh(
        [[0.33126447991252045, 0.7232272859519225], [-1.6560383499454994, 0.6562962126693598]],
        [0.320711919204044, -0.14505602750353622],
        1.0,
        0.8,
        [-2.7396330841903476, 2.2462253583671417],
    )
    c, R = (-0.25562096452903815, -0.4227859854544748), 0.5495428732760477
    disc = Constraints([f"(a-({c[0]!r}))**2+(b-({c[1]!r}))**2-{R!r}**2"], ["a", "b"])
    one = Network.from_edges(1, [])
    found = node_minimisers(Problem(one, 1, node, feasible=disc))
    np.testing.assert_allclose(
        found, node_minimisers(Problem(one, 1, node, feasible=Ball(c, R))), atol=1e-10
    )
    monkeypatch.setattr("nearsight.lpc.interior.LIMIT", 3)
    with pytest.raises(NearsightError, match="step 1, agent 0"):
        node_minimisers(Problem(one, 1, node, feasible=disc))
