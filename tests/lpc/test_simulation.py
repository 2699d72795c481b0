"""Whole simulations: costs, ratio, certificates, checkpoints, resumption after a kill."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest
from mpmath import mp

from nearsight.bounds import Parameters
from nearsight.graphs import InputError, Network, parse_graph
from nearsight.lpc import Controller, Problem, instance, simulate
from nearsight.lpc.checkpoint import Checkpoint, identity
from nearsight.lpc.costs import Mixture, Quadratic, Softplus
from nearsight.lpc.excess import excess, measured_excess

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


def quadratic_path(shift, spread):
    rng, pair = np.random.default_rng(1), Quadratic([[0.5, -0.5], [-0.5, 0.5]])
    aim = shift + spread * rng.normal(size=(4, 3, 1))
    start = shift + spread * rng.normal(size=(3, 1))
    return Problem(parse_graph("path:3"), 4, Quadratic([[1.0]], aim), pair, pair, x_0=start)


def exact_cost(problem, x):
    """The cost of scalar actions of `quadratic_path`, in 60 digits."""
    number = np.vectorize(mp.mpf, otypes=[object])
    y = number(np.concatenate([problem.x_0[None], x])[..., 0])
    total = ((y[1:] - number(problem.node.centre[..., 0])) ** 2).sum() / 2
    return total + ((y[1:] - y[:-1]) ** 2).sum() / 4 + ((y[1:, 1:] - y[1:, :-1]) ** 2).sum() / 4


def exact_optimum(problem):
    """The least of these costs, in 60 digits."""
    H, N = 4, 3
    path = mp.matrix([[1, -1, 0], [-1, 2, -1], [0, -1, 1]]) / 2
    A, b = mp.zeros(H * N), mp.zeros(H * N, 1)
    for t in range(H):
        for v in range(N):
            A[t * N + v, t * N + v] += 2 if t < H - 1 else 1.5
            b[t * N + v] = mp.mpf(problem.node.centre[t, v, 0])
            if t:
                A[t * N + v, t * N - N + v] = A[t * N - N + v, t * N + v] = -0.5
            else:
                b[v] += mp.mpf(problem.x_0[v, 0]) / 2
            for u in range(N):
                A[t * N + v, t * N + u] += path[v, u]
    x = mp.lu_solve(A, b)
    return exact_cost(problem, np.array(list(x), dtype=object).reshape(H, N, 1))


@pytest.mark.parametrize(
    ("shift", "spread"),
    [(0, 1), (1e3, 1), (1e8, 1), (1e8, 1e-2), (1e8, 1e-4), (1e8, 1e-6), (1, 1e-8), (1e6, 1e-5)],
)
def test_the_interval_holds_in_spite_of_rounding(shift, spread):
    with mp.workdps(60):
        best = exact_optimum(problem := quadratic_path(shift, spread))
        for k, r in ((2, 1), (4, 2)):
            run = simulate(problem, k, r)
            lower, upper = run.interval
            assert lower <= exact_cost(problem, run.x) / best - 1 <= upper
            if shift <= 1e3 and spread == 1:
                assert upper - lower <= 1e-8 * lower


def test_sharp_bends_are_not_overlooked():
    rng = np.random.default_rng(0)
    aim = rng.normal(size=(6, 2, 1))
    bend = Softplus([[1000.0]], 1000 * aim, 0.03, 1.0, rng.normal(size=(6, 2, 1)))
    node = Mixture([bend, Quadratic([[1e-9]], offset=1e6)], [1.0, 1.0])
    problem = Problem(parse_graph("path:2"), 6, node)
    x, y = rng.normal(size=(2, 6, 2, 1))
    with mp.workdps(50):
        number = np.vectorize(mp.mpf, otypes=[object])

        def exact(z):
            z = number(z)
            bent = np.vectorize(lambda w: mp.log1p(mp.exp(w)))(1000 * z - number(bend.shifts))
            bowl = (z - number(bend.centre)) ** 2 / 2 + mp.mpf(1e-9) * z**2 / 2
            return (bowl + mp.mpf(0.03) * bent).sum()

        true = exact(x) - exact(y)
        found = measured_excess(problem, x, y)
        assert abs(found.value - true) <= found.error <= 1e-8 * abs(true)


@pytest.mark.parametrize("scale", [1e-160, 1e-170])
def test_a_ratio_of_vanished_numbers_is_not_determined(scale):
    run = simulate(quadratic_path(0.0, scale), 2, 1)
    assert not run.determined
    assert run.interval == (0.0, float("inf"))
