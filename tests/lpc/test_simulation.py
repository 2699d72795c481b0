"""Whole simulations: costs, ratio, certificates, checkpoints, resumption after a kill."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from nearsight.bounds import Parameters
from nearsight.graphs import InputError, Network, parse_graph
from nearsight.lpc import Controller, instance, simulate
from nearsight.lpc.checkpoint import Checkpoint, identity
from nearsight.lpc.excess import excess

from .brute import oracle, problem_of
from .support import random_problem

P = Parameters(1, 2, 1, 0.5)


def by_hand(problem, x):
    """The cost in plain loops, one term at a time."""
    total, before = 0.0, problem.x_0
    one = np.ones(1, dtype=int)
    for t in range(1, problem.H + 1):
        now = x[t - 1]
        for v in range(problem.N):
            total += problem.node.value(t * one, v * one, now[[v]])[0]
            pair = np.concatenate([now[v], before[v]])[None]
            total += problem.temporal.value(t * one, v * one, pair)[0]
        for e, (u, w) in enumerate(problem.edges):
            pair = np.concatenate([now[u], now[w]])[None]
            total += problem.spatial.value(t * one, e * one, pair)[0]
        before = now
    return total


@pytest.mark.parametrize("feasible", ["everywhere", "box", "ball"])
@pytest.mark.parametrize("costs", ["quadratic", "log_cosh"])
def test_costs_and_ratio(costs, feasible):
    problem = random_problem(1, n=2, costs=costs, feasible=feasible)
    run = simulate(problem, 3, 1)
    mine, best = by_hand(problem, run.x), by_hand(problem, run.optimum.x)
    assert run.cost == pytest.approx(mine, rel=1e-13)
    assert run.optimum.cost == pytest.approx(best, rel=1e-13)
    assert run.excess == pytest.approx(mine - best, rel=1e-9)
    lower, upper = run.interval
    assert 0 < lower <= upper < lower + 1e-12
    assert lower == pytest.approx(run.ratio_minus_one) == pytest.approx(run.ratio - 1)
    assert run.violation <= 1e-15
    assert run.action_error < 1e-7


def test_the_ratio_is_that_of_the_brute_force():
    network = parse_graph("ring:6")
    rng = np.random.default_rng(2)
    made = oracle.random_instance(rng, oracle.Graph.of(network), 5, 1.0, 1.0)
    omega = rng.normal(size=made.rows[1].shape[1])
    run = simulate(problem_of(made, network, omega), 3, 2)
    cost = made.cost((made.lpc(3, 2) @ omega)[:, None], omega[:, None])[0]
    best = made.cost((made.optimum @ omega)[:, None], omega[:, None])[0]
    assert run.ratio == pytest.approx(cost / best, rel=1e-12)


def test_nearly_equal_costs_are_not_subtracted():
    # x = x* + e z: the excess of a quadratic is e^2 z'Mz/2, at any e
    for costs, rel in (("quadratic", 1e-12), ("log_cosh", 1e-3)):
        problem = random_problem(3, costs=costs)
        best = simulate(problem, 2, 1).optimum.x
        z = np.random.default_rng(4).normal(size=best.shape)
        scale = excess(problem, best + 1e-5 * z, best) / 1e-10
        assert excess(problem, best + 1e-8 * z, best) == pytest.approx(1e-16 * scale, rel=rel)
        plain = problem.cost(best + 1e-2 * z) - problem.cost(best)
        assert excess(problem, best + 1e-2 * z, best) == pytest.approx(plain, rel=1e-9)


@pytest.mark.parametrize("spec", ["path:1", "isolated"])
def test_networks_without_edges(spec):
    network = parse_graph(spec) if spec == "path:1" else Network.from_edges(3, [])
    run = simulate(instance(network, 4, P, seed=1), 2, 1)
    assert 0 < run.ratio_minus_one < 0.1


def test_nothing_to_pay():
    problem = instance(parse_graph("ring:5"), 3, Parameters(1, 1, 0, 0))
    run = simulate(problem, 2, 1)
    assert (run.cost, run.optimum.cost, run.ratio) == (0, 0, 1)


class Calls:
    """A progress bar that keeps the numbers of the steps it is shown."""

    def __init__(self):
        self.steps = []

    def __call__(self, what, done, total):
        if what == "step":
            self.steps.append(done)


def test_a_checkpoint_is_resumed_bit_for_bit(tmp_path):
    problem = instance(parse_graph("grid:5x5"), 9, P, seed=5, box=(-0.5, 0.5))
    whole, file = simulate(problem, 3, 2), tmp_path / "steps"
    simulate(problem, 3, 2, checkpoint=file)
    full = file.read_bytes()
    header, row = full.index(b"\n") + 1, 8 * 27
    for steps, torn in ((0, 0), (4, 0), (4, 77), (9, 0)):
        file.write_bytes(full[: header + steps * row + torn])
        calls = Calls()
        again = simulate(problem, 3, 2, checkpoint=file, progress=calls)
        np.testing.assert_array_equal(again.x, whole.x)
        assert again.action_error == whole.action_error
        assert calls.steps == list(range(steps + 1, 10))
        assert file.read_bytes() == full


def test_a_checkpoint_of_something_else_is_refused(tmp_path):
    network, file = parse_graph("ring:5"), tmp_path / "steps"
    problem = instance(network, 4, P, seed=1)
    simulate(problem, 3, 2, checkpoint=file)
    before = file.read_bytes()
    with pytest.raises(InputError, match=r"another simulation \(other r\)"):
        simulate(problem, 3, 1, checkpoint=file)
    for other in (
        instance(network, 4, P, seed=2),
        instance(network, 4, Parameters(1, 2, 1, 0.4), seed=1),
        instance(parse_graph("path:5"), 4, P, seed=1),
    ):
        with pytest.raises(InputError, match=r"another simulation \(other problem"):
            simulate(other, 3, 2, checkpoint=file)
    assert file.read_bytes() == before
    file.write_bytes(b"no checkpoint\n")
    with pytest.raises(InputError, match="it is no checkpoint"):
        simulate(problem, 3, 2, checkpoint=file)
    with pytest.raises(InputError, match=r"checkpoint .*absent.*: No such file"):
        simulate(problem, 3, 2, checkpoint=tmp_path / "absent" / "steps")


def test_other_boxes_are_another_problem():
    made = [instance(parse_graph("ring:5"), 4, P, seed=1, box=(-b, b)) for b in (8.0, 9.0)]
    digests = {str(identity(Controller(problem, 2, 1))["problem"]) for problem in made}
    assert len(digests) == 2


SLOW = """
import time
import nearsight as ns
from nearsight.bounds import Parameters

problem = ns.instance(ns.parse_graph("ring:40"), 60, Parameters(1, 2, 1, 0.5), seed=9)
ns.lpc.simulate(problem, 3, 2, checkpoint="steps", progress=lambda *_: time.sleep(0.02))
"""


def test_killed_in_the_middle(tmp_path):
    process = subprocess.Popen([sys.executable, "-c", SLOW], cwd=tmp_path)
    file = tmp_path / "steps"
    deadline = time.monotonic() + 60
    while time.monotonic() < deadline and not (file.exists() and file.stat().st_size > 4000):
        time.sleep(0.01)
    os.kill(process.pid, signal.SIGKILL)
    process.wait()
    problem = instance(parse_graph("ring:40"), 60, P, seed=9)
    checkpoint = Checkpoint(file, Controller(problem, 3, 2))
    checkpoint.close()
    assert 0 < len(checkpoint.done) < 60
    resumed = simulate(problem, 3, 2, checkpoint=file)
    np.testing.assert_array_equal(resumed.x, simulate(problem, 3, 2).x)
