import numpy as np
import pytest

from nearsight.bounds import Parameters
from nearsight.graphs import InputError, Network, parse_graph
from nearsight.lpc.checks import check_claims, check_class
from nearsight.lpc.constants import constants
from nearsight.lpc.costs import Callables, LogCosh, Mixture, Quadratic, Symbolic
from nearsight.lpc.problem import Problem
from nearsight.lpc.sets import Ball, Box, Constraints

RING = parse_graph("ring:6")
PAIR = np.array([[1.0, -1.0], [-1.0, 1.0]])


def coupled(b=0.25):
    """``b (x - y)^2`` is 4 b-smooth."""
    return Quadratic(2 * b * PAIR)


def test_scalar_problem_is_exact():
    m = np.linspace(1, 2, 12).reshape(2, 6)
    problem = Problem(RING, 2, Quadratic(m[:, :, None, None]), coupled(0.25), coupled(0.5))
    found = constants(problem)
    assert (found.mu.value, found.mu.step, found.mu.member) == (1.0, 1, (0,))
    assert (found.l_f.value, found.l_f.step, found.l_f.member) == (2.0, 2, (5,))
    assert found.mu.error == found.l_f.error == 0
    assert found.l_T.value == pytest.approx(1.0)
    assert found.l_S.value == pytest.approx(2.0)
    assert found.l_S.member == (0, 1)
    assert found.Delta == 2
    assert [found.h(q) for q in range(5)] == [1, 2, 2, 1, 0]
    np.testing.assert_array_equal(found.h(np.arange(5)), [1, 2, 2, 1, 0])
    assert found.certified
    safe = found.parameters()
    assert (safe.mu, safe.l_f) == (1.0, 2.0)
    assert 1.0 <= safe.l_T <= 1 + 1e-13
    assert 2.0 <= safe.l_S <= 2 + 1e-13


def test_extremes_are_those_of_all_blocks():
    rng = np.random.default_rng(0)
    half = rng.normal(size=(3, 6, 4, 4))
    blocks = half @ half.swapaxes(-1, -2)
    node = np.eye(2) + blocks[..., :2, :2]
    found = constants(Problem(RING, 3, Quadratic(node), Quadratic(blocks), Quadratic(blocks / 2)))
    for extreme, matrices, pick in (
        (found.mu, node, np.min),
        (found.l_f, node, np.max),
        (found.l_T, blocks, np.max),
        (found.l_S, blocks / 2, np.max),
    ):
        true = pick(
            [np.linalg.svd(P, compute_uv=False) for P in matrices.reshape(18, *matrices.shape[2:])]
        )
        assert abs(extreme.value - true) <= 2 * extreme.error
        assert extreme.below < extreme.value < extreme.above
        assert extreme.source == "exact"
    safe = found.parameters()
    assert safe.mu < found.mu.value
    assert safe.l_T > found.l_T.value


def test_without_edges_there_is_no_spatial_cost():
    lonely = Network.from_edges(2, np.zeros((0, 2), dtype=int))
    problem = Problem(lonely, 2, Quadratic([[1.0]]), None, Quadratic(np.eye(2)))
    found = constants(problem)
    assert (found.l_S.value, found.l_S.step, found.l_S.member) == (0.0, None, ())
    assert found.l_S.place == "nowhere"
    assert found.l_T.value == 0
    assert set(check_claims(problem)) == {"node", "temporal"}


def mixed(upper=3.0, lower=2.0):
    smooth = Symbolic("x**2 + log(cosh(x - a))", ["x"], {"a": [1, 2, 3, 4, 5, 6]}, lower, upper)
    node = Mixture([smooth, Quadratic([[2.0]])], [[[1] * 6], [[0] * 6]])
    return Problem(RING, 4, node, coupled(), LogCosh([[1.0, 1.0]]), Box(-1.0, 1.0))


def test_claims_are_carried_and_tested():
    found = constants(mixed())
    assert (found.mu.value, found.l_f.value) == (2.0, 3.0)
    assert found.l_f.source == "claimed"
    assert found.l_S.source == "exact"
    assert not found.certified
    seen = check_claims(mixed(), samples=200)
    assert seen["node"].upper == pytest.approx(3.0, abs=1e-3)
    assert seen["node"].lower == pytest.approx(2.0, abs=1e-3)
    assert seen["spatial"].upper == pytest.approx(2.0, abs=1e-2)
    assert seen["node"].least >= 0
    assert check_claims(mixed(), seed=5) == check_claims(mixed(), seed=5)


@pytest.mark.parametrize("feasible", [Ball(0.0, 1.0), Constraints(["x**2 - 1"], ["x"])])
def test_claims_are_tested_with_any_sets(feasible):
    node = Symbolic("x**2 + log(cosh(x))", ["x"], {}, 2, 3)
    assert check_claims(Problem(RING, 2, node, feasible=feasible))["node"].upper > 2.99


def test_a_narrow_bend_is_found_by_following_it():
    # the bend is 0.01 wide and lies at 30; the minimum leads there
    node = Symbolic("0.001*x**2 + 0.01*log(cosh(100*(x - 30)))", ["x"], {}, 0.002, 99)
    with pytest.raises(InputError, match="above the upper bound 99"):
        check_claims(Problem(RING, 3, node_unchecked(node)))


def node_unchecked(cost):
    """Return the same cost without the samples that `Problem` takes."""

    class Unchecked(Callables):
        def check(self, H, count, size, name):
            pass

    bounds = cost.curvature()
    return Unchecked(cost.size, cost.value, cost.gradient, cost.hessian, bounds.lower, bounds.upper)


@pytest.mark.parametrize(
    ("text", "lower", "upper", "message"),
    [
        ("x**2 + log(cosh(x))", 2, 2.5, "above the upper bound 2.5"),
        ("x**2 + log(cosh(x))", 2.5, 3, "below the lower bound 2.5"),
        ("x**2 + sin(x)*2 + 2", 1, 4, "not convex|below the lower"),
        ("x**2 + log(cosh(x)) - 1e-3", 2, 3, "nonnegative"),
        ("x**2 + log(cosh(x - 100)) - 100", 2, 3, "nonnegative"),
        ("x**2 + exp(x)", 2, 1e6, "not finite|above the upper"),
    ],
)
def test_claims_are_refuted_with_the_point(text, lower, upper, message):
    cost = Symbolic(text, ["x"], {}, lower, upper)
    problem = Problem(RING, 2, node_unchecked(cost))
    with pytest.raises(
        InputError, match=rf"node cost at step \d, agent \d, point w = .*({message})"
    ):
        check_claims(problem)
    with pytest.raises(InputError):
        Problem(RING, 2, cost)


def test_an_edge_is_named_as_such():
    cost = node_unchecked(Symbolic("log(cosh(x - y))", ["x", "y"], {}, 0, 1))
    problem = Problem(RING, 2, Quadratic([[1.0]]), spatial=cost)
    with pytest.raises(InputError, match=r"spatial cost at step \d, edge \d, .* bound 1"):
        check_claims(problem)


def test_exact_but_negative_costs_are_found():
    problem = Problem(RING, 2, Symbolic("(x - 3)**2 - 0.5", ["x"]))
    with pytest.raises(InputError, match=r"the cost is -0\.5; costs are nonnegative"):
        check_claims(problem)
    with pytest.raises(InputError, match="samples = 0"):
        check_claims(problem, samples=0)


def test_class_is_compared():
    problem = Problem(RING, 2, Quadratic([[[1.0]], [[2.0]]] * 3), coupled(0.25), coupled(0.5))
    assert check_class(problem, Parameters(1.0, 2.0, 1.0, 2.0)).l_f.value == 2.0
    check_class(problem, Parameters(0.5, 3.0, 2.0, 2.5))
    for typed, message in (
        (
            (1.1, 2, 1, 2),
            "mu = 1.1.*: the strong convexity of the node cost at step 1, agent 0 is 1",
        ),
        (
            (1, 1.9, 1, 2),
            "l_f = 1.8.*: the smoothness of the node cost at step 1, agent 1 is 2; l_f >",
        ),
        ((1, 2, 0.9, 2), "l_T = 0.9"),
        ((1, 2, 1, 1.9), r"l_S = 1.8.* spatial cost at step 1, edge \(0, 1\)"),
    ):
        with pytest.raises(InputError, match=message) as caught:
            check_class(problem, Parameters(*typed))
        assert caught.value.argument == message[: message.index(" ")]
    with pytest.raises(InputError, match="is said to be 3"):
        check_class(mixed(), Parameters(2, 2.9, 1, 2))
