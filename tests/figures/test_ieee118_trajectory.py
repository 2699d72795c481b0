"""Deviations and ratios in the picture of trajectories, from actions computed and costed again."""

import numpy as np
import pytest
from scipy import optimize

import nearsight as ns
from nearsight.figures import picture_named
from nearsight.graphs import parse_graph

COSTS = {"mu": 1.0, "l_f": 2.0, "l_T": 1.5, "l_S": 0.7}


@pytest.fixture(scope="module")
def drawn():
    picture = picture_named("ieee118-trajectory")
    typed = {"graph": parse_graph("grid:2x3"), **COSTS, "horizon": 4, "k": 3, "r": 2, "seed": 5}
    subject = picture.subject.with_typed(typed, picture.takes)
    return picture.compute(subject, lambda text: None), subject


@pytest.fixture(scope="module")
def problem(drawn):
    _, subject = drawn
    return ns.random_problem(graph=subject.network, **COSTS, horizon=4, box=(-1, 1), seed=5)


def test_the_optimum_is_that_of_a_general_solver(drawn, problem):
    table, _ = drawn
    shape = (4, 6, 1)

    def cost(x):
        return sum(part.sum() for part in problem.costs(x.reshape(shape)).values())

    best = optimize.minimize(cost, np.zeros(24), bounds=[(-1, 1)] * 24, options={"ftol": 1e-15})
    agents = table.where(kind="action").distinct("agent")
    assert len(agents) == 2
    for u in agents:
        rows = table.where(kind="action", agent=u)
        assert rows.numbers("optimum") == pytest.approx(best.x.reshape(shape)[:, u, 0], abs=1e-4)
        assert np.abs(rows.numbers("long")).max() <= 1
    for row in table.where(kind="run").records():
        run = ns.simulate(problem, k=row["k"], r=row["r"])
        assert row["ratio"] == pytest.approx(cost(run.x) / best.fun - 1, rel=1e-3)
        assert row["ratio"] <= row["promised"]


def test_deviations_of_agents_and_steps_are_those_of_the_trajectories(drawn, problem):
    table, _ = drawn
    off = {
        name: np.abs(run.x - run.optimum.x)[:, :, 0]
        for name, k, r in (("short", 2, 1), ("long", 3, 2))
        for run in [ns.simulate(problem, k=k, r=r)]
    }
    for name, values in off.items():
        assert table.where(kind="agent").numbers(name) == pytest.approx(values.max(axis=0))
        assert table.where(kind="step").numbers(name) == pytest.approx(values.max(axis=1))
    chosen = table.where(kind="action").distinct("agent")
    assert chosen[0] == off["short"].max(axis=0).argmax()
    rest = np.delete(np.arange(6), chosen[0])
    assert chosen[1] == rest[off["long"].max(axis=0)[rest].argmax()]


def test_what_is_promised_is_the_certificate(drawn):
    table, subject = drawn
    for row in table.where(kind="run").records():
        arguments = {**COSTS, "graph": subject.network, "k": row["k"], "r": row["r"]}
        found = ns.bound(**arguments, label="nearsight:sharp-cr")[0]
        assert (found.tier, found.guarantee, found.kind) == ("sharp", True, "upper")
        assert row["promised"] == found.values["cr_minus_one"]
