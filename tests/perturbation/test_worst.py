"""A false bound is caught without being told where; true ones are not."""

import numpy as np
import pytest

from nearsight.bounds import Parameters
from nearsight.graphs import InputError, Network, parse_graph
from nearsight.lpc import Problem, Quadratic
from nearsight.lpc.constants import constants
from nearsight.lpc.global_problem import GlobalProblem
from nearsight.lpc.local import LocalProblem
from nearsight.perturbation.found import replay
from nearsight.perturbation.search import search
from nearsight.perturbation.target import Target
from nearsight.perturbation.worst import worst


def local(k=3, r=2, graph="ring:5"):
    problem = Problem(parse_graph(graph), 6, Quadratic([[1.0]]))
    return LocalProblem(problem, 2, 0, k, r)


@pytest.mark.parametrize(("l_S", "graph"), [(1e-4, "ring:5"), (1e-2, "ring:5"), (1e-3, "star:3")])
def test_the_stated_local_bound_is_caught_without_being_told_where(l_S, graph, tmp_path):
    parameters = Parameters(1.0, 1.0, 1.0, l_S)
    found = worst(local(graph=graph), parameters, starts=1, refine=2)
    window = found.found.window
    assert len(found.looks) == len(window.terms.free) * len(window.terms.fixed)
    # one step, no hop: a/(2 sqrt(1+a)) beside 2 sqrt(Delta l_S l_T) rho_T
    degree = window.problem.network.max_degree
    rho_T = np.sqrt((np.sqrt(3) - 1) / (np.sqrt(3) + 1))
    assert found.ratio >= 0.999 * np.sqrt(1 / 8) / (2 * np.sqrt(degree * l_S) * rho_T)
    assert found.ratio > 1.5
    for tier in ("repaired", "sharp"):
        assert found.largest(tier).ratio(tier) <= 1 + 1e-9
    assert constants(found.found.problem).parameters().l_T <= 1.0
    assert constants(found.found.problem).parameters().l_S <= l_S
    found.found.save(tmp_path / "worst.npz")
    again = replay(tmp_path / "worst.npz")
    assert again.measured > 1.5 * again.bounds["stated"]


def test_without_spatial_coupling_the_stated_bound_is_zero_and_the_sensitivity_is_not():
    found = worst(local(r=1), Parameters(1.0, 1.0, 1.0, 0.0), starts=1, refine=1)
    assert found.ratio == np.inf
    assert found.found.value == pytest.approx(np.sqrt(1 / 8), rel=1e-12)
    still = search(local(r=1), Target((2, 0), (1, 0)), Parameters(1.0, 1.0, 0.0, 1.0), starts=1)
    assert still.value == 0
    assert still.ratios["sharp"] == 0


def test_a_worst_case_among_slices_is_the_stated_global_bound():
    window = GlobalProblem(Problem(parse_graph("path:2"), 4, Quadratic([[1.0]])), 1, 4)
    found = worst(window, Parameters(1.0, 1.0, 0.1, 0.1), starts=1, refine=2)
    assert found.ratio > 2
    assert found.found.ratios["sharp"] == pytest.approx(1, rel=1e-9)
    assert found.largest("sharp").ratio("sharp") <= 1 + 1e-9


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(3))
@pytest.mark.parametrize("n", [1, 2])
def test_true_bounds_survive_on_random_trees(seed, n):
    rng = np.random.default_rng(seed)
    edges = [(int(rng.integers(v)), v) for v in range(1, 6)]
    problem = Problem(Network.from_edges(6, edges), 5, Quadratic(np.eye(n)))
    strengths = np.exp(rng.uniform(-3, 3, 2))
    parameters = Parameters(1.0, float(1 + rng.exponential()), *map(float, strengths))
    found = worst(LocalProblem(problem, 1, 0, 3, 2), parameters, tier="sharp", starts=1)
    for tier in ("repaired", "sharp"):
        assert found.largest(tier).ratio(tier) <= 1 + 1e-9
    assert found.found.measured() == pytest.approx(found.found.value, rel=1e-10)


def test_bad_input_is_named():
    parameters = Parameters(1.0, 1.0, 1.0, 1.0)
    with pytest.raises(InputError, match="nothing fixed touches"):
        worst(local(k=1), parameters)
    with pytest.raises(InputError, match="refine"):
        worst(local(), parameters, refine=0)
    with pytest.raises(InputError, match="tier"):
        worst(local(k=2, r=1), parameters, tier="nonsense")
