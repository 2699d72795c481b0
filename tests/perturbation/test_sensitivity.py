"""Sensitivities against closed forms, extended precision, and the brute force."""

import mpmath
import numpy as np
import pytest

from nearsight.bounds import Parameters
from nearsight.bounds.decay import gamma_T
from nearsight.graphs import InputError, Network, parse_graph
from nearsight.lpc import Problem, Quadratic, instance
from nearsight.lpc.costs import Symbolic
from nearsight.lpc.global_problem import GlobalProblem
from nearsight.lpc.local import LocalProblem
from nearsight.lpc.sets import Ball, Constraints
from nearsight.perturbation import moved, sensitivity

from ..lpc.brute import oracle, problem_of


def zeros(window):
    n = window.problem.n
    return np.zeros((len(window.bottom), n)), np.zeros((len(window.boundary), n))


def normal(window, seed, scale=1.0):
    rng, n = np.random.default_rng(seed), window.problem.n
    return tuple(
        scale * rng.normal(size=(len(pairs), n)) for pairs in (window.bottom, window.boundary)
    )


@pytest.mark.parametrize("a", [0.05, 1.0, 20.0])
def test_long_uniform_chain_decays_as_gamma(a):
    # between two far ends the sensitivity at distance d is gamma_T^d
    problem = instance(parse_graph("path:1"), 1200, Parameters(1, 1, a, 0))
    window = GlobalProblem(problem, 1, 1200)
    found = sensitivity(window, *zeros(window)).norms[:40, 0]
    np.testing.assert_allclose(found, gamma_T(a) ** np.arange(1, 41), rtol=1e-10)


def test_the_brute_force_has_the_same_map():
    network = parse_graph("grid:4x3")
    rng = np.random.default_rng(1)
    made = oracle.random_instance(rng, oracle.Graph.of(network), 4, 2.0, 1.0, l_f=2.0, n=2)
    problem = problem_of(made, network, rng.normal(size=made.rows[1].shape[1]))
    window = LocalProblem(problem, 1, 5, 4, 2)
    found = sensitivity(window, *normal(window, 2))
    theirs = oracle.sensitivity(made, 5, 4, 2)
    rows = [theirs.free.index(tuple(map(int, pair))) for pair in found.free]
    columns = [theirs.boundary.index(tuple(map(int, pair))) for pair in found.fixed]
    np.testing.assert_allclose(found.norms, theirs.size[rows][:, columns], rtol=1e-10, atol=1e-14)
    words = np.array(["top", "bottom", "lateral"])[found.part]
    assert (words == theirs.part[columns]).all()


SMOOTH = [
    (style, box) for style in ("blocks", "logcosh", "softplus") for box in (None, (-0.6, 0.5))
]


@pytest.mark.parametrize(("style", "box"), SMOOTH)
def test_derivatives_are_those_of_finite_differences(style, box):
    problem = instance(
        parse_graph("grid:4x4"), 5, Parameters(1, 2, 1, 1), style=style, n=2, box=box, seed=3
    )
    window = LocalProblem(problem, 2, 5, 3, 2)
    at, toward = normal(window, 4), normal(window, 5)
    found = sensitivity(window, *at)
    assert found.smooth
    assert (found.binding > 0) == (box is not None)
    h, ends = 1e-5, []
    for sign in (1, -1):
        values = (p + sign * h * q for p, q in zip(at, toward, strict=True))
        ends.append(window.solved(*values, tolerance=1e-14).x)
    slope = (ends[0] - ends[1]) / (2 * h)
    expected = np.einsum("finj,nj->fi", found.derivative, window.fixed(*toward))
    np.testing.assert_allclose(expected, slope, rtol=0, atol=2e-8)


def test_curved_constraints_bend_the_solution():
    # one agent, one step: minimise |y - theta|^2/2 + (b/4)|y - x_0|^2 over a disc; the solution
    # is the projection of a point q, and the derivative of q/|q| is known
    b = 0.8
    theta = np.array([3.0, 1.0])
    temporal = b / 2 * np.kron([[1, -1], [-1, 1]], np.eye(2))
    ball = Ball([0.0, 0.0], 1.0)
    written = Constraints(["y1**2 + y2**2 - 1"], ["y1", "y2"])
    x_0 = np.array([[-0.5, 2.0]])
    q = (theta + b / 2 * x_0[0]) / (1 + b / 2)
    size = np.linalg.norm(q)
    expected = (np.eye(2) - np.outer(q, q) / size**2) / size * (b / 2) / (1 + b / 2)
    for sets in (ball, written):
        problem = Problem(
            parse_graph("path:1"), 1, Quadratic(np.eye(2), theta), Quadratic(temporal), None, sets
        )
        window = GlobalProblem(problem, 1)
        found = sensitivity(window, x_0, np.zeros((0, 2)))
        assert (found.binding, found.smooth) == (1, True)
        np.testing.assert_allclose(found.derivative[0, :, 0, :], expected, rtol=0, atol=1e-7)


def test_a_corner_is_no_smooth_point():
    # the minimiser of the node cost lies exactly on the bound: it binds with multiplier 0
    problem = Problem(
        parse_graph("path:1"),
        1,
        Quadratic([[1.0]], [1.0]),
        Quadratic([[0.5, -0.5], [-0.5, 0.5]]),
        feasible=Constraints(["y - 1"], ["y"]),
        x_0=1.0,
    )
    found = sensitivity(GlobalProblem(problem, 1), np.ones((1, 1)), np.zeros((0, 1)))
    assert not found.smooth


def test_finite_differences_in_extended_precision():
    # a smooth chain of 13 steps, solved by Newton's method with 60 digits: derivatives from 1
    # down to 1e-12 agree to a relative 1e-8
    H, a = 13, 0.2
    node = Symbolic("(y - c)**2 / 2 + log(cosh(y)) / 2", ["y"], {"c": 1.5}, 1.0, 1.5)
    pair = Symbolic("(x - z)**2 * b / 4", ["x", "z"], {"b": a}, 0.0, a)
    problem = Problem(parse_graph("path:1"), H, node, pair)
    window = GlobalProblem(problem, 1)
    found = sensitivity(window, np.array([[0.7]]), np.zeros((0, 1)), tolerance=1e-15)
    with mpmath.workdps(60):
        h = mpmath.mpf(10) ** -20

        def solution(start):
            x = [mpmath.mpf(1)] * H
            for _ in range(30):
                g, d = [], []
                for t in range(H):
                    before = start if t == 0 else x[t - 1]
                    value = x[t] - mpmath.mpf(1.5) + mpmath.tanh(x[t]) / 2
                    value += mpmath.mpf(a) / 2 * (x[t] - before)
                    bend = 1 + mpmath.sech(x[t]) ** 2 / 2 + mpmath.mpf(a) / 2
                    if t < H - 1:
                        value += mpmath.mpf(a) / 2 * (x[t] - x[t + 1])
                        bend += mpmath.mpf(a) / 2
                    g.append(value)
                    d.append(bend)
                off = -mpmath.mpf(a) / 2
                M = mpmath.matrix(H, H)
                for t in range(H):
                    M[t, t] = d[t]
                    if t:
                        M[t, t - 1] = M[t - 1, t] = off
                step = mpmath.lu_solve(M, mpmath.matrix(g))
                x = [x[t] - step[t] for t in range(H)]
            return x

        high, low = (solution(mpmath.mpf(0.7) + s * h) for s in (1, -1))
        slopes = [float((p - q) / (2 * h)) for p, q in zip(high, low, strict=True)]
    assert slopes[-1] < 1e-12
    np.testing.assert_allclose(found.derivative[:, 0, 0, 0], slopes, rtol=1e-8)


@pytest.mark.parametrize("style", ["blocks", "softplus"])
def test_finite_perturbations(style):
    problem = instance(parse_graph("ring:8"), 4, Parameters(1, 2, 1, 1), style=style, seed=6)
    window = LocalProblem(problem, 1, 0, 4, 2)
    before, after = normal(window, 7, 3.0), normal(window, 8, 3.0)
    found = moved(window, before, after)
    exact = np.abs(window.solve(*after) - window.solve(*before))[:, 0]
    np.testing.assert_allclose(found.distance, exact, rtol=0, atol=1e-9)
    assert found.noise < 1e-8
    if style == "blocks":  # the derivative is the answer
        step = window.fixed(*after) - window.fixed(*before)
        derivative = sensitivity(window, *before).derivative
        linear = window.ordered(np.einsum("finj,nj->fi", derivative, step))
        np.testing.assert_allclose(found.distance, np.abs(linear[:, 0]), rtol=0, atol=1e-9)


def test_nothing_free_is_refused():
    problem = instance(parse_graph("ring:5"), 3, Parameters(1, 1, 1, 1))
    window = LocalProblem(problem, 1, 0, 1, 2)
    with pytest.raises(InputError, match="nothing is free"):
        sensitivity(window, *zeros(window))


def test_steps_beyond_the_horizon_have_no_part():
    problem = instance(parse_graph("ring:6"), 3, Parameters(1, 1, 1, 1), seed=9)
    window = LocalProblem(problem, 2, 0, 6, 1)
    found = sensitivity(window, *normal(window, 1))
    assert found.free[:, 0].max() == 3
    assert not (found.part == 0).any()  # there is no top: the window ends beyond the horizon


def test_an_isolated_agent():
    problem = instance(Network.from_edges(2, []), 3, Parameters(1, 1, 1, 1), seed=9)
    window = LocalProblem(problem, 1, 0, 3, 1)
    found = sensitivity(window, *normal(window, 1))
    assert set(found.part) == {0, 1}
