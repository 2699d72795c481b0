import numpy as np
import pytest

from nearsight.graphs import InputError
from nearsight.lpc.global_problem import GlobalProblem
from nearsight.lpc.local import LocalProblem
from nearsight.lpc.minimisers import node_minimisers
from nearsight.lpc.offline import optimum

from .support import COSTS, SETS, clarabel_error, oracle, random_problem


def values(window, y, z):
    """The given actions as a dict (t, v) -> action."""
    rows = np.concatenate([window.bottom, window.boundary])
    given = np.concatenate([y, z])
    return {(int(t), int(v)): w for (t, v), w in zip(rows, given, strict=True)}


def random_boundary(window, seed):
    rng = np.random.default_rng(seed)
    n = window.problem.n
    return rng.normal(size=(len(window.bottom), n)), rng.normal(size=(len(window.boundary), n))


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("feasible", SETS)
@pytest.mark.parametrize("costs", COSTS)
def test_psi_agrees_with_clarabel_for_any_boundary(costs, feasible, n):
    problem = random_problem(5, n, 6, costs, feasible)
    for t, v, k, r in ((2, 1, 3, 1), (1, 4, 3, 2)):
        local = LocalProblem(problem, t, v, k, r)
        y, z = random_boundary(local, 3)
        free = [(int(s), int(u)) for s, u in local.free]
        answer = oracle(problem, free, values(local, y, z))
        assert local.solve(y, z) == pytest.approx(answer, abs=clarabel_error(problem))
        assert local.solved(y, z).converged.all()


@pytest.mark.parametrize("feasible", SETS)
@pytest.mark.parametrize("graph", ["ring", "tree", "dense"])
def test_with_full_sight_it_is_the_offline_optimum(graph, feasible):
    problem = random_problem(5, 2, 4, feasible=feasible, graph=graph)
    best = optimum(problem)
    local = LocalProblem(problem, 1, 2, problem.H + 2, 4)
    y = problem.x_0[local.bottom[:, 1]]
    _, z = random_boundary(local, 1)  # beyond the horizon, or at agents that are not there
    x = local.solve(y, z)
    inside = local.free[:, 0] <= problem.H
    t, v = local.free[inside].T
    assert np.abs(x[inside] - best.x[t - 1, v]).max() <= 1e-9
    assert not x[~inside].any()
    assert np.array_equal(local.action(x), x[0])


@pytest.mark.parametrize("feasible", SETS)
def test_the_true_boundary_gives_the_offline_optimum_inside(feasible):
    problem = random_problem(5, 2, 6, feasible=feasible)
    best = optimum(problem).x
    path = np.concatenate([problem.x_0[None], best])
    for window in (LocalProblem(problem, 2, 0, 4, 2), GlobalProblem(problem, 2, 4)):
        y, z = (path[rows[:, 0], rows[:, 1]] for rows in (window.bottom, window.boundary))
        x = window.solve(y, z)
        assert np.abs(x - path[window.free[:, 0], window.free[:, 1]]).max() <= 1e-8
    end = GlobalProblem(problem, 3)
    x = end.solve(path[2], np.zeros((0, 2)))
    assert np.abs(x.reshape(4, 5, 2) - best[2:]).max() <= 1e-8


def test_the_default_boundary_is_what_lpc_uses():
    problem = random_problem(5, 2, 4, feasible="box")
    local = LocalProblem(problem, 3, 0, 4, 1)
    x_prev = np.arange(10.0).reshape(5, 2)
    y, z = local.default_boundary(x_prev)
    theta = node_minimisers(problem)
    assert np.array_equal(y, x_prev[local.bottom[:, 1]])
    for (t, v), row in zip(local.boundary, z, strict=True):
        assert np.array_equal(row, theta[t - 1, v] if t <= 4 else [0.0, 0.0])


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("arguments", [(3, 1, 4, 2), (3, 3), (4, 6)])
def test_quadratics_answer_linearly(n, arguments):
    problem = random_problem(6, n, 5)
    window = (LocalProblem if len(arguments) == 4 else GlobalProblem)(problem, *arguments)
    (y, z), (dy, dz) = random_boundary(window, 1), random_boundary(window, 2)
    cross = window.cross @ np.concatenate([dy, dz]).ravel()
    moved = -np.linalg.solve(window.hessian.toarray(), cross).reshape(-1, n)
    assert np.abs(window.solve(y + dy, z + dz) - window.solve(y, z) - moved).max() <= 1e-12


def test_values_that_touch_nothing_have_no_effect():
    problem = random_problem(6, 1, 3)
    local = LocalProblem(problem, 2, 1, 4, 1)
    y, z = random_boundary(local, 1)
    beyond = local.boundary[:, 0] > 3
    other = np.where(beyond[:, None], 1e6, z)
    assert np.array_equal(local.solve(y, z), local.solve(y, other))
    assert not local.cross.toarray()[:, len(y) :][:, beyond].any()


def test_nothing_is_free_without_sight():
    problem = random_problem(6, 1, 3)
    for k, r in ((1, 2), (3, 0)):
        local = LocalProblem(problem, 2, 1, k, r)
        assert local.solve(*random_boundary(local, 1)).shape == (0, 1)


def test_wrong_inputs_are_named():
    problem = random_problem(6, 1, 3)
    local = LocalProblem(problem, 2, 1, 3, 1)
    y, z = random_boundary(local, 1)
    for bad in ((y[1:], z), (y, z.ravel()), (y, z * np.nan), ("far", z)):
        with pytest.raises(InputError, match=r"^[yz]: "):
            local.solve(*bad)
    for arguments in ((0, 1, 2, 1), (4, 1, 2, 1), (1, 9, 2, 1), (1, 1, 0, 1)):
        with pytest.raises(InputError):
            LocalProblem(problem, *arguments)
    for arguments in ((0,), (1, 1)):
        with pytest.raises(InputError):
            GlobalProblem(problem, *arguments)
    with pytest.raises(InputError, match="quadratic"):
        _ = LocalProblem(random_problem(6, 1, 3, "softplus"), 1, 1, 3, 1).hessian
