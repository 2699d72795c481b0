import dataclasses

import numpy as np
import pytest

from nearsight.graphs import InputError, Network
from nearsight.lpc.costs import Quadratic
from nearsight.lpc.offline import optimum
from nearsight.lpc.problem import Problem
from nearsight.lpc.sets import Box
from nearsight.lpc.terms import Terms
from nearsight.lpc.whole import whole

from .support import (
    COSTS,
    SETS,
    clarabel_error,
    cost_in_long_doubles,
    dense_system,
    everything,
    oracle_optimum,
    random_problem,
    reference,
)


@pytest.mark.parametrize("graph", ["ring", "tree", "dense"])
@pytest.mark.parametrize("n", [1, 2, 3])
@pytest.mark.parametrize("method", ["cg", "banded", "descent", "auto"])
def test_unconstrained_quadratics_agree_with_dense_linear_algebra(method, n, graph):
    problem = random_problem(n, n, graph=graph)
    A, b = dense_system(problem)
    exact = np.linalg.solve(A, b)
    found = optimum(problem, method=method)
    assert found.converged
    assert np.abs(found.x.ravel() - exact).max() <= 2e-12 * np.abs(exact).max()
    assert np.linalg.norm(found.x.ravel() - exact) <= found.error + 1e-13 * np.linalg.norm(exact)


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("feasible", SETS)
@pytest.mark.parametrize("costs", COSTS)
def test_every_kind_agrees_with_clarabel(costs, feasible, n):
    arguments = (3, n, 4, costs, feasible)
    problem, answer = random_problem(*arguments), oracle_optimum(*arguments)
    found = optimum(problem)
    assert found.converged
    t, v = np.array(everything(problem)).T
    assert problem.feasible.violation(t, v, found.x.reshape(-1, n)).max() <= 1e-15
    assert np.abs(found.x - answer).max() <= clarabel_error(problem)
    assert found.cost <= problem.cost(answer) + 1e-7


@pytest.mark.parametrize("seed", range(4))
@pytest.mark.parametrize("feasible", ["everywhere", "box", "ball"])
def test_certificates_hold_against_long_doubles(feasible, seed):
    problem = random_problem(seed, 1 + seed % 3, feasible=feasible)
    for tolerance in (1e-3, 1e-7, 1e-12):
        method = "cg" if feasible == "everywhere" else "descent"
        found = optimum(problem, tolerance=tolerance, method=method)
        best = reference(problem, found.x)
        wrong = float(np.linalg.norm((found.x - best).ravel()))
        excess = cost_in_long_doubles(problem, found.x) - cost_in_long_doubles(problem, best)
        assert wrong <= found.error <= 1e3 * tolerance * np.linalg.norm(found.x) + 1e-12
        assert excess <= found.gap + 1e-18 * abs(found.cost)


@pytest.mark.parametrize("feasible", ["box", "ball"])
def test_the_barrier_finds_what_descent_finds_and_its_gap_is_true(feasible):
    problem = random_problem(5, 2, feasible=feasible)
    best, found = optimum(problem), optimum(problem, method="barrier")
    assert found.converged
    assert np.abs(found.x - best.x).max() <= 1e-9
    assert np.linalg.norm(found.x - best.x) <= found.error <= 1e-5
    assert found.cost - best.cost <= found.gap + 1e-13 * best.cost


def test_an_agent_on_its_own_and_one_step():
    alone = Problem(Network.from_edges(1, []), 1, Quadratic(2 * np.eye(1), 3.0))
    assert optimum(alone).x.ravel() == pytest.approx([3.0], abs=1e-15)
    assert optimum(dataclasses.replace(alone, H=7), method="cg").x.ravel() == pytest.approx(3.0)


@pytest.mark.parametrize("H", [1, 2, 3, 6])
def test_steady_costs_stand_for_all_steps(H):
    rng = np.random.default_rng(H)
    varying = random_problem(8, 2, H)
    first = [
        Quadratic(part.matrix[0], rng.normal(size=(H, part.matrix.shape[1], part.size)))
        for part in (varying.node, varying.temporal, varying.spatial)
    ]
    problem = Problem(varying.network, H, *first, x_0=varying.x_0)
    assert problem.steady
    A, b = dense_system(problem)
    found = optimum(problem, method="cg")
    assert np.abs(found.x.ravel() - np.linalg.solve(A, b)).max() <= 1e-11


@pytest.mark.parametrize("window", [(1, 4), (2, 3), (4, 4), (1, 1)])
def test_whole_is_what_a_search_finds(window):
    problem = random_problem(1, 2, 4)
    free = [(0, t, v) for t, v in everything(problem) if window[0] <= t <= window[1]]
    fast, slow = whole(problem, *window), Terms.of(problem, np.array(free))
    assert np.array_equal(fast.free, slow.free)
    assert np.array_equal(fast.fixed, slow.fixed)
    rng = np.random.default_rng(0)
    x, fixed = rng.normal(size=(len(fast.free), 2)), rng.normal(size=(len(fast.fixed), 2))
    assert fast.value(x, fixed) == pytest.approx(slow.value(x, fixed), rel=1e-13)
    assert fast.gradient(x, fixed) == pytest.approx(slow.gradient(x, fixed), rel=1e-12, abs=1e-12)
    for a, b in zip(fast.scale, slow.scale, strict=True):
        assert a == pytest.approx(b, rel=1e-14)


def test_a_method_that_does_not_apply_says_so():
    with pytest.raises(InputError, match="method = cg"):
        optimum(random_problem(1, feasible="box"), method="cg")
    with pytest.raises(InputError, match="no projection"):
        optimum(random_problem(1, feasible="formulas"), method="descent")
    thin = random_problem(1)
    thin = dataclasses.replace(thin, feasible=Box(0.0, [[[0.0]], [[1.0]], [[1.0]], [[1.0]]]))
    with pytest.raises(InputError, match="interior is empty"):
        optimum(thin, method="barrier")


@pytest.mark.slow
@pytest.mark.parametrize("feasible", [None, Box(-0.5, 0.5)])
def test_a_million_actions(feasible):
    L, H = 100, 100
    i, j = np.divmod(np.arange(L * L), L)
    right, down = i * L + (j + 1) % L, (i + 1) % L * L + j
    edges = np.concatenate([np.stack([i * L + j, other], axis=1) for other in (right, down)])
    couple = np.array([[1.0, -1.0], [-1.0, 1.0]])
    targets = np.random.default_rng(0).normal(size=(H, L * L, 1))
    problem = Problem(
        Network.from_edges(L * L, edges),
        H,
        Quadratic(np.eye(1), targets),
        Quadratic(couple),
        Quadratic(couple / 2),
        **({} if feasible is None else {"feasible": feasible}),
    )
    found = optimum(problem)
    assert found.converged
    assert found.error <= 1e-12 * np.linalg.norm(found.x)
