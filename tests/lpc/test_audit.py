"""Locality, bit by bit, for every engine; and that the audit can fail."""

from dataclasses import replace

import numpy as np
import pytest

from nearsight.bounds import Parameters
from nearsight.graphs import parse_graph
from nearsight.lpc import Controller, audit, instance
from nearsight.lpc.audit import Audit

from .support import random_problem

P = Parameters(1, 2, 1, 0.5)


def agents(problem, count, seed):
    rng = np.random.default_rng(seed)
    steps, members = rng.integers(1, problem.H + 1, count), rng.integers(problem.N, size=count)
    return zip(steps, members, strict=True)


@pytest.mark.parametrize("varying", [False, True])
@pytest.mark.parametrize("method", ["auto", "direct", "descent", "barrier"])
@pytest.mark.parametrize("spec", ["grid:7x7", "erdos-renyi:40x0.06", "star:12"])
def test_unconstrained_quadratics(spec, method, varying):
    problem = instance(parse_graph(spec), 6, P, style="blocks", varying=varying, seed=1)
    controller, others = Controller(problem, 3, 2, method=method), 0
    for t, v in agents(problem, 4, 2):
        found = audit(controller, int(t), int(v), seed=int(v))
        assert found.local, (t, v, found.action - found.altered)
        others += found.others
    assert others > 0 or spec == "star:12"  # at radius 2 of a star everyone knows everyone


@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize("method", ["auto", "descent"])
def test_boxes(method, n):
    problem = instance(parse_graph("grid:7x7"), 6, P, n=n, box=(-0.4, 0.3), seed=3)
    controller, others = Controller(problem, 3, 2, method=method), 0
    for t, v in agents(problem, 6, 4):
        found = audit(controller, int(t), int(v), seed=int(v))
        assert found.local, (t, v, found.action - found.altered)
        others += found.others
    assert others > 0


@pytest.mark.parametrize("costs", ["quadratic", "log_cosh", "softplus"])
@pytest.mark.parametrize("feasible", ["everywhere", "ball", "formulas"])
def test_other_kinds(costs, feasible):
    problem = random_problem(7, n=2, H=4, costs=costs, feasible=feasible, graph="tree")
    controller = Controller(problem, 2, 1)
    for t, v in agents(problem, 4, 8):
        assert audit(controller, int(t), int(v), seed=int(v)).local


def test_a_wider_view_than_declared_is_caught():
    # the audit of a controller that sees one hop, or one step, more than it says
    class Cheat(Controller):
        def step(self, t, before):
            return Controller(self.problem, self.k + self.more[0], self.r + self.more[1]).step(
                t, before
            )

    problem = instance(parse_graph("ring:9"), 5, P, seed=5)
    for more in ((1, 0), (0, 1)):
        Cheat.more = more
        assert not audit(Cheat(problem, 2, 1), 2, 4, seed=6).local
    Cheat.more = (0, 0)
    assert audit(Cheat(problem, 2, 1), 2, 4, seed=6).local


def test_a_single_bit_counts():
    one = np.array([1.0])
    same = Audit(1, 0, one, one.copy(), 3)
    assert same.local
    assert not replace(same, altered=np.nextafter(one, 2)).local
