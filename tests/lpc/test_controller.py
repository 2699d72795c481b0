"""LPC against the brute force, other solvers, and what its definition says outright."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nearsight.bounds import Parameters
from nearsight.graphs import InputError, Network, parse_graph
from nearsight.lpc import Box, Controller, Problem, Quadratic, instance, optimum
from nearsight.lpc.local import LocalProblem

from .brute import oracle, played, problem_of
from .support import random_problem

SIGHTS = [(2, 1), (3, 2), (4, 1), (3, 4), (9, 9)]


def drawn(seed, spec, H, n, style="any", l_f=2.0):
    network = parse_graph(spec, seed=3)
    rng = np.random.default_rng(seed)
    made = oracle.random_instance(
        rng, oracle.Graph.of(network), H, 2.0, 1.5, l_f=l_f, n=n, style=style
    )
    return network, made, rng.normal(size=made.rows[1].shape[1])


@pytest.mark.parametrize(("k", "r"), SIGHTS)
@pytest.mark.parametrize(("spec", "n"), [("ring:6", 1), ("star:5", 2), ("erdos-renyi:7x0.3", 1)])
def test_policy_is_the_brute_force(spec, n, k, r):
    network, made, omega = drawn(1, spec, 5, n)
    problem = problem_of(made, network, omega)
    expected = (made.lpc(k, r) @ omega).reshape(5, -1, n)
    np.testing.assert_allclose(played(Controller(problem, k, r)), expected, rtol=0, atol=1e-13)


@given(
    st.integers(0, 2**32 - 1),
    st.integers(2, 8),
    st.integers(1, 6),
    st.integers(2, 8),
    st.integers(1, 5),
    st.integers(1, 2),
)
def test_policy_on_any_small_graph(seed, N, H, k, r, n):
    rng = np.random.default_rng(seed)
    graph = oracle.connected_graph(N, rng.integers(0, 99, N - 1), rng.integers(0, 99, 3))
    network = Network.from_edges(N, graph.edges)
    made = oracle.random_instance(rng, graph, H, 3.0, 0.7, l_f=1.5, n=n, style="any")
    omega = rng.normal(size=made.rows[1].shape[1])
    expected = (made.lpc(k, r) @ omega).reshape(H, N, n)
    found = played(Controller(problem_of(made, network, omega), k, r))
    np.testing.assert_allclose(found, expected, rtol=0, atol=1e-12)


@pytest.mark.parametrize("box", [0.1, 0.5, 5.0])
@pytest.mark.parametrize(("k", "r"), SIGHTS)
@pytest.mark.parametrize(("spec", "n"), [("ring:6", 1), ("star:5", 2), ("grid:3x3", 1)])
def test_boxes_are_the_brute_force(spec, n, k, r, box):
    network, made, omega = drawn(2, spec, 4, n)
    size = 4 * network.vertices * n
    sets = oracle.everywhere(made, 1)
    sets = type(sets)(n, sets.centre, np.full((size, 1), box), sets.disc)
    expected = oracle.play(made, omega[:, None], sets, k, r).lpc.reshape(4, -1, n)
    problem = problem_of(made, network, omega, box)
    for method in ("auto", "descent"):
        controller = Controller(problem, k, r, method=method, tolerance=1e-11)
        assert controller.method == ("splitting" if method == "auto" else method)
        np.testing.assert_allclose(played(controller), expected, rtol=0, atol=2e-10)


@pytest.mark.parametrize("costs", ["quadratic", "log_cosh", "softplus"])
@pytest.mark.parametrize("feasible", ["everywhere", "box", "ball", "formulas"])
def test_every_kind_agrees_with_single_local_problems(costs, feasible):
    # agent by agent, in the simplest possible loop over objects that are tested on their own
    problem = random_problem(5, n=2, costs=costs, feasible=feasible, graph="dense")
    k, r = 3, 2
    controller = Controller(problem, k, r, tolerance=1e-10)
    before = problem.x_0
    for t in range(1, problem.H + 1):
        found = controller.step(t, before)
        for v in range(problem.N):
            local = LocalProblem(problem, t, v, k, r)
            expected = local.action(local.solve(*local.default_boundary(before)))
            np.testing.assert_allclose(found[v], expected, rtol=0, atol=1e-7)
        before = found


@pytest.mark.parametrize("method", ["auto", "direct", "descent", "barrier"])
def test_one_answer_whatever_the_method_and_the_number_of_threads(method):
    problem = instance(parse_graph("grid:5x5"), 6, Parameters(1, 2, 1, 0.5), seed=1)
    reference = played(Controller(problem, 3, 2))
    one = played(Controller(problem, 3, 2, method=method, workers=1, tolerance=1e-12))
    two = played(Controller(problem, 3, 2, method=method, workers=2, tolerance=1e-12))
    np.testing.assert_array_equal(one, two)
    np.testing.assert_allclose(one, reference, rtol=0, atol=1e-11)


@pytest.mark.parametrize(("k", "r"), [(1, 5), (7, 0), (1, 0)])
@pytest.mark.parametrize("box", [None, (-0.3, 0.4)])
def test_nothing_seen_plays_the_node_minimiser(k, r, box):
    problem = instance(parse_graph("ring:7"), 5, Parameters(1, 3, 1, 1), seed=2, box=box)
    theta = np.broadcast_to(problem.node.centre, (5, 7, 1))
    expected = theta if box is None else np.clip(theta, *box)
    np.testing.assert_array_equal(played(Controller(problem, k, r)), expected)


@pytest.mark.parametrize("box", [None, (-0.3, 0.4)])
def test_all_seeing_lpc_is_the_optimum(box):
    network = parse_graph("tree:2x3")
    problem = instance(network, 6, Parameters(1, 3, 2, 1), seed=3, box=box)
    # diameter 6, and a boundary that touches nothing free
    found = played(Controller(problem, 7, 7, tolerance=1e-11))
    np.testing.assert_allclose(found, optimum(problem).x, rtol=0, atol=1e-9)


def test_balls_too_large_for_dense_matrices():
    # a hub whose local problem has 4 * 151 free numbers, beside leaves that see the same
    problem = instance(parse_graph("star:151"), 5, Parameters(1, 1, 1, 0.01), seed=4)
    boxed = Problem(
        problem.network, 5, problem.node, problem.temporal, problem.spatial, Box(-9, 9), problem.x_0
    )
    free = played(Controller(problem, 5, 2))
    np.testing.assert_allclose(played(Controller(boxed, 5, 2)), free, rtol=0, atol=1e-8)
    direct = played(Controller(problem, 5, 2, method="direct"))
    np.testing.assert_allclose(free, direct, rtol=0, atol=1e-12)


@pytest.mark.parametrize("spec", ["path:1", "path:2"])
@pytest.mark.parametrize("H", [1, 2])
def test_the_smallest_problems(spec, H):
    problem = instance(parse_graph(spec), H, Parameters(1, 1, 1, 1), seed=5)
    found = played(Controller(problem, 4, 3))
    np.testing.assert_allclose(found, optimum(problem).x, rtol=0, atol=1e-12)


def test_isolated_agents_and_separate_components():
    network = Network.from_edges(6, [(0, 1), (2, 3)])
    whole = instance(network, 4, Parameters(1, 2, 1, 1), seed=6)
    found = played(Controller(whole, 3, 2))
    alone = Problem(
        parse_graph("path:1"),
        4,
        Quadratic(whole.node.matrix[:, -1:], whole.node.centre[:, -1:]),
        Quadratic(whole.temporal.matrix[:, -1:]),
        x_0=whole.x_0[-1:],
    )
    np.testing.assert_allclose(found[:, 5:], played(Controller(alone, 3, 2)), atol=1e-14)


REFERENCE = {
    (1.0, 1.0, 2, 1): "3.1653e-01",
    (1.0, 1.0, 3, 2): "6.9643e-03",
    (1.0, 1.0, 4, 3): "3.9760e-04",
    (0.1, 0.1, 3, 2): "1.6145e-06",
}


@pytest.mark.parametrize(("case", "digits"), REFERENCE.items())
def test_worst_cases_of_the_ring_come_out(case, digits):
    # the trajectory as a linear map of (x_0, targets), column by column through the controller;
    # the oracle's quadratic forms turn it into the worst ratio
    a, x, k, r = case
    network, N, H = parse_graph("ring:13"), 13, 12
    made = oracle.uniform(oracle.Graph.of(network), H, a, x / 2)
    columns = [
        played(Controller(problem_of(made, network, unit), k, r)).ravel()
        for unit in np.eye((H + 1) * N)
    ]
    root, basis = made.range
    off = root @ (np.array(columns).T - made.optimum) @ basis
    assert f"{np.linalg.norm(off, 2) ** 2:.4e}" == digits


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"k": 0}, "k = 0: an integer >= 1"),
        ({"k": 2.5}, "k = 2.5: an integer >= 1"),
        ({"r": -1}, "r = -1: an integer >= 0"),
        ({"method": "magic"}, "method = 'magic': one of"),
        ({"tolerance": 0.0}, "tolerance = 0.0: from"),
        ({"workers": -1}, "workers = -1: an integer >= 0"),
    ],
)
def test_bad_arguments_are_named(change, words):
    problem = instance(parse_graph("ring:5"), 3, Parameters(1, 1, 1, 1))
    with pytest.raises(InputError, match=words):
        Controller(**({"problem": problem, "k": 2, "r": 1} | change))


def test_methods_that_do_not_apply_say_so():
    boxed = instance(parse_graph("ring:5"), 3, Parameters(1, 1, 1, 1), box=(-1, 1))
    with pytest.raises(InputError, match="policy: costs are not all quadratic, or there are"):
        Controller(boxed, 2, 1, method="policy")
    bent = instance(parse_graph("ring:5"), 3, Parameters(1, 2, 1, 1), style="logcosh")
    with pytest.raises(InputError, match="splitting: quadratic costs and sets"):
        Controller(bent, 2, 1, method="splitting")


def test_steps_and_shapes_are_checked():
    controller = Controller(instance(parse_graph("ring:5"), 3, Parameters(1, 1, 1, 1)), 2, 1)
    with pytest.raises(InputError, match=r"t = 4: an integer from 1 to 3"):
        controller.step(4, np.zeros((5, 1)))
    with pytest.raises(InputError, match=r"shape \(5,\); real numbers of shape \(5, 1\)"):
        controller.step(1, np.zeros(5))
