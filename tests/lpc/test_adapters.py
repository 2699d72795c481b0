import builtins

import numpy as np
import pytest

from nearsight.graphs import InputError, NearsightError
from nearsight.lpc.costs import Callables
from nearsight.lpc.local import LocalProblem
from nearsight.lpc.offline import optimum
from nearsight.lpc.problem import Problem
from nearsight.lpc.sets import Functions

from .support import COSTS, SETS, random_problem


@pytest.mark.parametrize("feasible", ["everywhere", "box"])
@pytest.mark.parametrize("n", [1, 2, 3])
def test_osqp_agrees(feasible, n, capfd):
    problem = random_problem(9, n, feasible=feasible)
    found, best = optimum(problem, method="osqp"), optimum(problem)
    assert np.abs(found.x - best.x).max() <= 1e-8
    assert np.linalg.norm(found.x - best.x) <= found.error + best.error
    assert capfd.readouterr() == ("", "")


@pytest.mark.parametrize("feasible", SETS)
@pytest.mark.parametrize("costs", COSTS)
def test_casadi_agrees(costs, feasible, capfd):
    problem = random_problem(9, 2, 3, costs, feasible)
    found, best = optimum(problem, method="casadi"), optimum(problem)
    assert np.abs(found.x - best.x).max() <= 1e-7
    assert capfd.readouterr() == ("", "")


def test_casadi_solves_local_problems():
    problem = random_problem(9, 2, 5, "softplus", "formulas")
    local = LocalProblem(problem, 2, 1, 3, 2)
    y, z = local.default_boundary(problem.x_0)
    found, best = local.solved(y, z, method="casadi"), local.solved(y, z)
    assert found.x == pytest.approx(best.x, abs=1e-7)


def test_python_functions_go_through_all_solvers():
    plain = random_problem(9, 1, 2)
    node = Callables(
        1,
        lambda t, i, w: np.cosh(w[:, 0] - i),
        lambda t, i, w: np.sinh(w - i[:, None]),
        lambda t, i, w: np.cosh(w - i[:, None])[:, :, None],
        1.0,
        1e4,
    )
    disc = Functions(
        1,
        lambda t, v, y: y**2 - 1.5,
        lambda t, v, y: 2 * y[:, :, None],
        lambda t, v, y: np.full((len(y), 1, 1, 1), 2.0),
    )
    problem = Problem.__new__(Problem)  # the claim `upper` only holds near the disc: not probed
    fields = {**vars(plain), "node": node, "feasible": disc}
    for name in ("network", "H", "node", "temporal", "spatial", "feasible", "x_0"):
        object.__setattr__(problem, name, fields[name])
    found, best = optimum(problem, method="casadi"), optimum(problem)
    assert best.method == "barrier"
    assert found.x == pytest.approx(best.x, abs=1e-7)


def test_failures_say_what_to_do():
    problem = random_problem(9, 1, feasible="ball")
    with pytest.raises(InputError, match="over a box"):
        optimum(problem, method="osqp")
    bad = random_problem(9, 1)
    object.__setattr__(bad.feasible, "constraints", lambda t, v, y: _impossible(len(y)))
    with pytest.raises(NearsightError, match="IPOPT"):
        optimum(bad, method="casadi")


def _impossible(m):
    return np.ones((m, 1)), np.zeros((m, 1, 1)), np.zeros((m, 1, 1, 1))


@pytest.mark.parametrize(("method", "extra"), [("osqp", "qp"), ("casadi", "nlp")])
def test_a_missing_library_names_its_extra(method, extra, monkeypatch):
    real = builtins.__import__

    def without(name, globals=None, *rest):
        if name == method and not (globals or {}).get("__name__", "").startswith(method):
            raise ImportError(name)
        return real(name, globals, *rest)

    problem = random_problem(9, 1)
    monkeypatch.setattr(builtins, "__import__", without)
    with pytest.raises(InputError, match=rf"pip install {method} \(the extra {extra}\)"):
        optimum(problem, method=method)
