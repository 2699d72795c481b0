"""The search: its class, its gradient, its values by hand, its files, and what it catches."""

from itertools import pairwise

import numpy as np
import pytest

from nearsight.bounds import Parameters
from nearsight.bounds.decay import slice_decay
from nearsight.graphs import InputError, parse_graph
from nearsight.lpc import Problem, Quadratic, load_problem
from nearsight.lpc.constants import constants
from nearsight.lpc.global_problem import GlobalProblem
from nearsight.lpc.local import LocalProblem
from nearsight.perturbation.found import replay
from nearsight.perturbation.search import Climb, search
from nearsight.perturbation.target import Target

MILD = Parameters(1.0, 2.0, 1.0, 0.7)


def blank(graph="ring:5", H=6, n=1):
    return Problem(parse_graph(graph), H, Quadratic(np.eye(n)))


def local(n=1, k=3, r=2, graph="ring:5", t=2):
    return LocalProblem(blank(graph, n=n), t, 0, k, r)


CASES = {
    "bottom": (local(), Target((3, 0), (1, 1))),
    "lateral": (local(), Target((2, 0), (3, 2))),
    "top": (local(), Target((2, 1), (4, 0))),
    "vectors": (local(n=2), Target((2, 0), (3, 2))),
    "slices": (GlobalProblem(blank("ring:3"), 2, 4), Target((3, None), (1, None))),
    "vector slices": (GlobalProblem(blank("ring:3", n=2), 4), Target((6, None), (3, None))),
}
EACH = pytest.mark.parametrize(("window", "target"), CASES.values(), ids=CASES)


def by_hand(problem, free, rows, columns):
    """The norm of a block from loops over all costs: nothing of `Terms`, `Window` or the search."""
    H, N, n = problem.H, problem.N, problem.n
    whole = np.zeros((H + 1, N, n, H + 1, N, n))
    for t in range(1, H + 1):
        for v in range(N):
            whole[t, v, :, t, v] += problem.node.matrix[t - 1, v]
            ends = [(t, v), (t - 1, v)]
            add(whole, ends, problem.temporal.matrix[t - 1, v], n)
        for e, (u, w) in enumerate(problem.edges):
            spatial = problem.spatial.matrix
            add(whole, [(t, u), (t, w)], spatial[t - 1, e], n)
    M = np.block([[whole[(*a, slice(None), *b)] for b in free] for a in free])
    C = np.block([[whole[(*a, slice(None), *b)] for b in columns] for a in free])
    moved = np.linalg.solve(M, -C).reshape(len(free), n, -1)
    picked = [free.index(row) for row in rows]
    return np.linalg.norm(moved[picked].reshape(len(rows) * n, -1), 2)


def add(whole, ends, block, n):
    for i, a in enumerate(ends):
        for j, b in enumerate(ends):
            whole[(*a, slice(None), *b)] += block[i * n : (i + 1) * n, j * n : (j + 1) * n]


def pairs(actions, chosen=None):
    found = [(int(t), int(v)) for t, v in actions]
    if chosen is None:
        return found
    step, agent = chosen
    return [a for a in found if a[0] == step and agent in (None, a[1])]


def within(problem, parameters):
    """Whether the certified constants of a problem are within those of a class."""
    safe = constants(problem).parameters()
    return (
        # a computed eigenvalue of mu I, n > 1, comes with an error
        safe.mu >= parameters.mu * (1 - 1e-14)
        and safe.l_f <= parameters.l_f * (1 + (1e-14 if problem.n > 1 else 0))
        and safe.l_T <= parameters.l_T
        and safe.l_S <= parameters.l_S
    )


@EACH
def test_gradient_against_finite_differences(window, target):
    climb = Climb.of(window, target, MILD)
    theta = climb.couplings.random(np.random.default_rng(5))
    low, high = climb.couplings.bounds
    theta = np.clip(theta, low + 0.01, high - 0.01)
    gradient = climb.descent(theta)[1]
    step = 1e-6
    for j in range(len(theta)):
        move = np.zeros_like(theta)
        move[j] = step
        slope = (climb.descent(theta + move)[0] - climb.descent(theta - move)[0]) / (2 * step)
        assert gradient[j] == pytest.approx(slope, abs=2e-7)


@EACH
def test_what_is_found_replays_and_stays_in_the_class(window, target):
    found = search(window, target, MILD, starts=2, seed=1)
    assert found.measured() == pytest.approx(found.value, rel=1e-10)
    free = pairs(window.terms.free[:, 1:])
    rows, columns = pairs(free, target.free), pairs(window.terms.fixed[:, 1:], target.fixed)
    assert by_hand(found.problem, free, rows, columns) == pytest.approx(found.value, rel=1e-10)
    assert within(found.problem, MILD)
    for tier in ("repaired", "sharp"):
        assert found.ratios.get(tier, 0.0) <= 1 + 1e-9


def test_the_search_gains_on_uniform_differences_and_on_its_starts():
    window, target = CASES["lateral"]
    climb = Climb.of(window, target, MILD)
    rng = np.random.default_rng(0)
    drawn = [climb.value(climb.couplings.random(rng)) for _ in range(50)]
    uniform = climb.value(climb.couplings.differences())
    found = search(window, target, MILD, starts=4)
    assert found.value > 1.2 * max(uniform, *drawn)


@pytest.mark.parametrize("name", ["bottom", "lateral", "top", "vectors"])
def test_random_starts_find_what_structured_ones_find(name):
    window, target = CASES[name]
    told = search(window, target, MILD, starts=0)
    alone = search(window, target, MILD, structured=False, starts=4, seed=11)
    assert alone.value == pytest.approx(told.value, rel=0.03)


def test_full_blocks_do_not_beat_blocks_of_rank_one_here():
    window, target = CASES["lateral"]
    one = search(window, target, MILD, starts=2)
    full = search(window, target, MILD, starts=4, rank=2)
    assert full.value == pytest.approx(one.value, rel=1e-6)


def test_one_free_action_by_calculus():
    # (l/2)(cos phi y - sin phi z)^2 + y^2/2: the largest |dy/dz| is l/(2 sqrt(1 + l))
    window = local(k=2, r=1, graph="path:2")
    parameters = Parameters(1.0, 1.0, 5.0, 0.8)
    for fixed, l in (((1, 0), 5.0), ((3, 0), 5.0), ((2, 1), 0.8)):  # noqa: E741 - the paper's letter
        found = search(window, Target((2, 0), fixed), parameters, starts=2)
        assert found.value == pytest.approx(l / (2 * np.sqrt(1 + l)), rel=1e-12)


def test_a_larger_class_has_larger_values_and_more_starts_do_no_harm():
    window, target = CASES["lateral"]
    values = [
        search(window, target, Parameters(1.0, l_f, l_T, l_S), starts=2).value
        for l_f, l_T, l_S in ((1, 0.5, 0.5), (1, 1, 0.5), (1, 1, 1), (3, 1, 1))
    ]
    assert all(a <= b * (1 + 1e-9) for a, b in pairwise(values))
    few, many = (
        search(window, target, MILD, structured=False, starts=starts).value for starts in (1, 4)
    )
    assert many >= few * (1 - 1e-12)


def test_seeds_reproduce_every_bit_and_differ():
    window, target = CASES["vectors"]
    a, b, c = (
        search(window, target, MILD, structured=False, starts=1, seed=seed) for seed in (7, 7, 8)
    )
    assert a.value == b.value
    assert (a.theta == b.theta).all()
    assert (a.theta != c.theta).any()


def test_progress_and_guesses():
    window, target = CASES["top"]
    calls = []
    found = search(window, target, MILD, starts=2, progress=lambda *call: calls.append(call))
    assert calls == [(j, 4) for j in range(1, 5)]
    again = search(window, target, MILD, starts=0, structured=False, guesses=[found.theta])
    assert again.value >= found.value
    assert again.evaluations < found.evaluations


@pytest.mark.parametrize("name", ["lateral", "slices", "vector slices"])
def test_files_replay(name, tmp_path):
    window, target = CASES[name]
    found = search(window, target, MILD, starts=1)
    found.save(tmp_path / "found.npz")
    again = replay(tmp_path / "found.npz")
    assert again.told == found.value
    assert again.measured == pytest.approx(found.value, rel=1e-10)
    assert again.target == target
    assert again.bounds == dict(found.bounds)
    notes = load_problem(tmp_path / "found.npz").metadata
    if name == "lateral":
        assert notes["window"] == {"kind": "local", "t": 2, "v": 0, "k": 3, "r": 2}
        assert (notes["free"], notes["fixed"]) == ([2, 0], [3, 2])
    else:
        assert notes["window"]["kind"] == "global"
        assert notes["free"][1] is None
    assert notes["constants"] == {"mu": 1.0, "l_f": 2.0, "l_T": 1.0, "l_S": 0.7}


def test_other_files_are_refused(tmp_path):
    from nearsight.lpc import save_problem

    save_problem(blank(), tmp_path / "plain.npz")
    with pytest.raises(InputError, match="search"):
        replay(tmp_path / "plain.npz")


@pytest.mark.parametrize("fixed", [(1, 0), (5, 0), (1, 1), (5, 1)])
def test_one_top_or_bottom_action_obeys_the_bound_on_slices(fixed):
    window = local(k=4)
    for t in (2, 3, 4):
        found = search(window, Target((t, 0), fixed), MILD, starts=1)
        promised = slice_decay(MILD.a_T, abs(t - fixed[0]))
        assert found.value <= promised * (1 + 1e-9)
        if fixed[1] == 0:  # no hop: attained, the spatial couplings cut
            assert found.value >= promised * (1 - 1e-6)


def test_bad_input_is_named():
    window, target = CASES["bottom"]
    with pytest.raises(InputError, match="not free within"):
        search(window, Target((4, 0), (1, 0)), MILD)
    with pytest.raises(InputError, match="not fixed next to"):
        search(window, Target((2, 0), (1, 2)), MILD)
    with pytest.raises(InputError, match="starts = 0"):
        search(window, target, MILD, starts=0, structured=False)
    with pytest.raises(InputError, match="guesses"):
        search(window, target, MILD, guesses=[np.zeros(1)])
    with pytest.raises(InputError, match="one float each"):
        search(window, target, Parameters(1.0, 1.0, np.array([1.0, 2.0]), 0.0))
    with pytest.raises(InputError, match="rank"):
        search(window, target, MILD, rank=3)
    large = GlobalProblem(Problem(parse_graph("ring:400"), 4, Quadratic([[1.0]])), 1)
    with pytest.raises(InputError, match="1600 unknowns"):
        search(large, Target((1, 0), (0, 0)), MILD)
