"""What an adversary found, each with the instance that showed it."""

import numpy as np
import pytest

from nearsight.bounds import Parameters
from nearsight.graphs import InputError, Network, parse_graph
from nearsight.lpc import (
    Box,
    Controller,
    Problem,
    Quadratic,
    instance,
    load_problem,
    optimum,
    promise,
    save_problem,
    simulate,
)
from nearsight.lpc.costs import Callables, Symbolic
from nearsight.lpc.identity import digest

RING = parse_graph("ring:5")
PAIR = Quadratic([[0.5, -0.5], [-0.5, 0.5]])


def test_a_negative_cost_gets_no_promise():
    # its least value is below 0, which lowers the optimum and not what LPC strays
    theta = 3 * np.random.default_rng(0).normal(size=(6, 5))
    plain = Problem(RING, 6, Quadratic([[1.0]], theta[:, :, None]), PAIR, PAIR)
    c = 0.999 * optimum(plain).cost / 30
    lowered = Symbolic("(x-a)**2/2 - c", ["x"], {"a": theta, "c": c})
    problem = Problem(RING, 6, lowered, PAIR, PAIR)
    with pytest.raises(InputError, match="negative"):
        promise(problem, 4, 2)


def test_formulas_as_couplings_of_formulas():
    # minimisers of node costs are problems without a single pair
    formula = Symbolic("(x-y)**2/4", ["x", "y"])
    node = Symbolic("(x-a)**2/2", ["x"], {"a": np.arange(5.0)})
    found = simulate(Problem(RING, 4, node, formula, formula), 3, 2, tolerance=1e-12)
    plain = Problem(RING, 4, Quadratic([[1.0]], np.arange(5.0)[:, None]), PAIR, PAIR)
    np.testing.assert_allclose(found.x, simulate(plain, 3, 2).x, rtol=0, atol=1e-10)


@pytest.mark.parametrize("box", [Box(0, 1), Box(0, 0)])
def test_solutions_that_are_zero_are_found_at_once(box):
    theta = -1 - np.random.default_rng(0).random((6, 50, 1))
    network = parse_graph("ring:50")
    controller = Controller(Problem(network, 6, Quadratic([[1.0]], theta), PAIR, PAIR, box), 4, 3)
    before, looks = controller.problem.x_0, []
    from nearsight.lpc import splitting

    limit, splitting.LIMIT = splitting.LIMIT, 500
    try:
        for t in (1, 2, 3):
            before = controller.step(t, before)
            looks.append(before)
            assert controller.error.max() <= 1e-8
    finally:
        splitting.LIMIT = limit
    assert not np.any(looks)


def test_actions_that_are_not_finite_are_refused():
    controller = Controller(instance(RING, 4, Parameters(1, 1, 1, 1), box=(-1, 1)), 3, 2)
    for value in (np.nan, np.inf, 1j):
        with pytest.raises(InputError, match="before"):
            controller.step(1, np.full((5, 1), value))


@pytest.mark.parametrize(
    "change",
    [
        {"k": 3.0},
        {"k": np.nan},
        {"k": None},
        {"k": np.True_},
        {"r": 1.5},
        {"workers": 1.5},
        {"workers": "2"},
    ],
)
def test_numbers_of_another_type_are_refused(change):
    problem = instance(RING, 4, Parameters(1, 1, 1, 1))
    with pytest.raises(InputError, match=next(iter(change))):
        Controller(**({"problem": problem, "k": 2, "r": 1} | change))


@pytest.mark.parametrize("H", [2.0, np.nan, None, "3", 0])
def test_horizons_of_another_type_are_refused(H):
    with pytest.raises(InputError, match="H = "):
        Problem(RING, H, Quadratic([[1.0]]))


def test_parts_of_another_type_are_refused():
    with pytest.raises(InputError, match="network: a str where a Network"):
        Problem("ring:5", 3, Quadratic([[1.0]]))
    with pytest.raises(InputError, match="node: a int where a Cost"):
        Problem(RING, 3, 3)


def test_one_number_of_one_agent_is_another_problem():
    # a sum over agents does not see it beside 1e25
    theta = 0.3 * np.random.default_rng(7).normal(size=(5, 5, 1))

    def made(q):
        weights = np.array([1e25, q, 1, 1, 1.0])[:, None, None]
        return Problem(RING, 5, Quadratic(weights, theta), PAIR, PAIR, x_0=1.0)

    assert digest(made(1.0)) == digest(made(1.0))
    assert digest(made(1.0)) != digest(made(2.0))


def test_python_functions_are_told_apart_by_their_values():
    def made(c):
        node = Callables(
            1,
            lambda t, i, w: ((w[:, 0] - c * i) ** 2) / 2,
            lambda t, i, w: w - c * i[:, None],
            lambda t, i, w: np.ones((len(w), 1, 1)),
            1.0,
            1.0,
        )
        return Problem(RING, 3, node, PAIR, PAIR)

    assert digest(made(1.0)) == digest(made(1.0))
    assert digest(made(1.0)) != digest(made(1.5))


def test_damaged_steps_of_a_checkpoint_are_computed_again(tmp_path):
    problem, file = instance(RING, 6, Parameters(1, 2, 1, 0.5), seed=2), tmp_path / "steps"
    whole = simulate(problem, 3, 2, checkpoint=file)
    full = file.read_bytes()
    start, row = full.index(b"\n") + 1, 8 * 7
    for damage in (
        full[: start + 2 * row] + bytes(row) + full[start + 3 * row :],  # zeros in the middle
        full[: start + 3 * row + 5] + b"\xff" + full[start + 3 * row + 6 :],  # a flipped byte
        full[:start] + bytes(6 * row),  # nothing but zeros
        full[: start - 20],  # torn within the first line
        full[:3],
    ):
        file.write_bytes(damage)
        again = simulate(problem, 3, 2, checkpoint=file)
        np.testing.assert_array_equal(again.x, whole.x)
        assert file.read_bytes() == full


def test_a_file_cannot_vouch_for_symmetry(tmp_path):
    # two components that are regular alike; growth measured from one vertex would be false
    edges = [(0, 1), (1, 2), (0, 2), *((3 + j, 3 + (j + 1) % 9) for j in range(9))]
    liar = Network.from_edges(12, edges, transitive=True)
    problem = instance(liar, 3, Parameters(1, 1, 1, 0.5))
    save_problem(problem, tmp_path / "p.npz")
    assert not load_problem(tmp_path / "p.npz").problem.network.transitive


def test_trajectories_of_another_shape_have_no_cost():
    problem = instance(RING, 3, Parameters(1, 1, 1, 1))
    for shape in ((4, 5, 1), (2, 5, 1), (3, 5)):
        with pytest.raises(InputError, match="shape"):
            problem.cost(np.zeros(shape))
