"""The spatial instance against brute force, extended precision and LPC."""

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.bounds.lower import spatial_excess
from nearsight.graphs import InputError, Network, network_growth, parse_graph, parse_growth
from nearsight.lowerbounds import (
    Spatial,
    conditional_policy,
    infinite_excess,
    realisation,
    team_policy,
)
from nearsight.lowerbounds.infinite import tree_excess
from nearsight.lowerbounds.team import excess
from nearsight.lpc import load_problem, optimum, save_problem, simulate


def exactly(spatial, j):
    """``(B_jj - ((M_SS)^-1)_jj, 1 - B_jj)`` by subtracting, in 60 digits."""
    network = spatial.network
    N = network.vertices
    M = mp.matrix(N, N)
    for i in range(N):
        M[i, i] = 1 + mpf(spatial.a_S) / 2 * int(network.degrees[i])
        for u in network.neighbours(i):
            M[i, int(u)] = -mpf(spatial.a_S) / 2
    (ball,) = spatial.seen(np.array([j]))
    ball = [int(i) for i in ball]
    part = mp.matrix([[M[i, u] for u in ball] for i in ball])
    unit = mp.matrix([int(i == j) for i in ball])
    B = mp.lu_solve(M, mp.matrix([int(i == j) for i in range(N)]))[j]
    return B - mp.lu_solve(part, unit)[ball.index(j)], 1 - B


@pytest.mark.parametrize("spec", ["grid:3x4", "star:6", "regular:3x12", "path:7"])
@pytest.mark.parametrize("a_S", [1e-4, 0.7, 2e5])
@pytest.mark.parametrize("r", [0, 1, 2])
def test_charges_against_extended_precision(spec, a_S, r):
    spatial = Spatial(parse_graph(spec), a_S, r)
    found = spatial.charges()
    with mp.workdps(60):
        for c, j in enumerate(found.agents):
            team, optimal = exactly(spatial, int(j))
            if team > mpf(10) ** -50:
                assert abs(found.team[c] / team - 1) < 1e-12
            else:
                assert found.team[c] == 0
            assert abs(found.optimal[c] / optimal - 1) < 1e-12
    # the chain of inequalities of the paper's proof
    assert np.all(found.deviation <= found.team * (1 + 1e-12))
    assert np.all(found.team <= found.conditional * (1 + 1e-12))


@pytest.mark.parametrize(
    ("N", "d", "x", "r"), [(41, 1, 0.01, 6), (31, 2, 0.8, 3), (401, 1, 400.0, 5), (30, 3, 0.01, 1)]
)
def test_ring_of_blocks_to_twelve_digits(N, d, x, r):
    found = Spatial(parse_graph(f"ring-of-blocks:{N}x{d}"), x / (2 * d), r).cr_minus_one
    assert found == pytest.approx(float(spatial_excess(x / (2 * d), d, r)), rel=1e-12)


def regular_tree(degree, depth):
    graph = nx.Graph()
    rim, count = [0], 1
    for level in range(depth):
        fresh = []
        for v in rim:
            for _ in range(degree - (level > 0)):
                graph.add_edge(v, count)
                fresh.append(count)
                count += 1
        rim = fresh
    return Network.from_networkx(graph)


@pytest.mark.parametrize("a_S", [0.01, 0.5, 3.0])
@pytest.mark.parametrize("r", [0, 1, 3])
def test_infinite_networks_are_limits_of_finite_ones(a_S, r):
    cases = {
        "line": parse_graph("ring:151"),
        "ring-of-blocks:3": parse_graph("ring-of-blocks:91x3"),
        "grid2": parse_graph("torus:61x61"),
    }
    for name, network in cases.items():
        found = infinite_excess(parse_growth(name), a_S, r)
        assert found == pytest.approx(Spatial(network, a_S, r).cr_minus_one, rel=1e-12)
    assert tree_excess(a_S, 2, r) == pytest.approx(
        infinite_excess(parse_growth("line"), a_S, r), rel=1e-13
    )
    rooted = Spatial(regular_tree(3, 11), a_S, r).charges([0]).ratios[0]
    assert infinite_excess(parse_growth("tree:3"), a_S, r) == pytest.approx(rooted, rel=1e-4)


@pytest.mark.parametrize("a_S", [1e-3, 0.5, 1e4])
@pytest.mark.parametrize("r", [0, 1, 2, 7])
def test_trees_in_extended_precision(a_S, r):
    with mp.workdps(80):
        ell, degree = mpf(a_S) / 2, 5
        m, inner = 1 + ell * degree, (degree - 1) * ell**2
        here = m
        for _ in range(r - 1):
            here = m - inner / here
        ball = 1 / (m - degree * ell**2 / here) if r else 1 / m
        B = 1 / (m - degree * ell**2 * 2 / (m + mp.sqrt(m**2 - 4 * inner)))
        assert abs(tree_excess(a_S, degree, r) / ((B - ball) / (1 - B)) - 1) < 1e-13


def test_growths_without_a_graph_have_no_spatial_bound():
    assert infinite_excess(parse_growth("poly:2,1", 4), 1.0, 2) is None


def best_over_all_linear_policies(spatial, variances):
    """Least squares over all entries of K that the radius allows, at once."""
    M = spatial.system.matrix.toarray()
    N = len(M)
    seen = spatial.seen(np.arange(N))
    entries = [(i, j) for j in range(N) for i in seen[j]]
    root, B = np.linalg.cholesky(M).T, np.linalg.inv(M)
    columns = np.zeros((N, N, len(entries)))
    for e, (i, j) in enumerate(entries):
        columns[:, j, e] = root[:, i] * np.sqrt(variances[j])
    target = (-root @ B * np.sqrt(variances)).ravel()
    columns = columns.reshape(N * N, -1)
    weights = np.linalg.lstsq(columns, target, rcond=None)[0]
    return float(((columns @ weights - target) ** 2).sum()), entries, weights


@pytest.mark.parametrize("spec", ["path:6", "star:5", "grid:3x3"])
def test_team_policy_is_the_best_linear_one(spec):
    spatial = Spatial(parse_graph(spec), 3.0, 1)
    N = spatial.network.vertices
    variances = np.random.default_rng(5).uniform(0.2, 2.0, N)
    least, entries, weights = best_over_all_linear_policies(spatial, variances)
    assert least == pytest.approx(float(variances @ spatial.charges().team), rel=1e-10)
    K = team_policy(spatial)
    np.testing.assert_allclose([K[e] for e in entries], weights, atol=1e-9)


def test_no_nonlinear_policy_beats_it():
    # three signs, path of 4, radius 1: every policy is a table over the signs it sees; the best
    # tables solve one linear system, and the path's middle agents see three of four signs
    spatial = Spatial(parse_graph("path:4"), 4.0, 1)
    N = 4
    signs = np.array(np.meshgrid(*[[-1.0, 1.0]] * N)).reshape(N, -1).T
    M, seen = spatial.system.matrix.toarray(), spatial.seen(np.arange(N))
    keys = [{} for _ in range(N)]
    for w in signs:
        for i in range(N):
            key = tuple(w[seen[i]])
            keys[i].setdefault(key, sum(map(len, keys)))
    size = sum(map(len, keys))
    A, b, constant = np.zeros((size, size)), np.zeros(size), 0.0
    for w in signs:
        pick = np.zeros((N, size))
        for i in range(N):
            pick[i, keys[i][tuple(w[seen[i]])]] = 1.0
        A += pick.T @ M @ pick / len(signs)
        b += pick.T @ w / len(signs)
        constant += w @ w / len(signs)
    cost = constant - b @ np.linalg.solve(A, b)
    best = constant - np.trace(np.linalg.inv(M))
    assert cost - best == pytest.approx(float(spatial.charges().team.sum()), rel=1e-10)


@pytest.mark.parametrize("spec", ["path:7", "star:6", "grid:3x4"])
@pytest.mark.parametrize("a_S", [0.1, 30.0])
def test_a_realisation_shows_the_expected_ratio(spec, a_S):
    spatial = Spatial(parse_graph(spec), a_S, 1)
    charged = spatial.charges()
    for policy, more in (
        (team_policy(spatial), charged.team),
        (conditional_policy(spatial), charged.conditional),
    ):
        w = realisation(spatial, policy)
        assert set(np.abs(w)) == {1.0}
        paid, least = excess(spatial, policy, w)
        assert paid >= more.sum() / charged.optimal.sum() * least * (1 - 1e-9)


def test_best_variances_belong_to_one_source():
    charged = Spatial(parse_graph("grid:3x4"), 2.0, 1).charges()
    rng = np.random.default_rng(2)
    for _ in range(20):
        assert charged.ratio(rng.exponential(size=12)) <= charged.ratios[charged.best]
    alone = np.zeros(12)
    alone[charged.best] = 3.0
    assert charged.ratio(alone) == pytest.approx(charged.ratios[charged.best], rel=1e-14)


@pytest.mark.parametrize("spec", ["ring:11", "grid:4x4", "star:5"])
@pytest.mark.parametrize("r", [0, 1])
def test_lpc_pays_the_bound_on_the_saved_instance(spec, r, tmp_path):
    spatial = Spatial(parse_graph(spec), 1.7, r)
    save_problem(spatial.problem(mu=0.3), tmp_path / "worst.npz")
    problem = load_problem(tmp_path / "worst.npz").problem
    run = simulate(problem, 3, r)
    assert run.ratio_minus_one >= spatial.cr_minus_one * (1 - 1e-9)
    w = np.zeros(spatial.network.vertices)
    w[spatial.agent] = 1.0
    np.testing.assert_allclose(optimum(problem).x[0, :, 0], spatial.optimum(w), atol=1e-12)


@settings(max_examples=12)
@given(
    seed=st.integers(0, 10**6),
    a=st.floats(-2, 1).map(lambda e: 10.0**e),
    k=st.integers(2, 6),
    r=st.integers(1, 4),
)
def test_bound_is_below_the_certificate(seed, a, k, r):
    graph = nx.gnp_random_graph(14, 0.2, seed=seed)
    network = Network.from_networkx(graph)
    growth = network_growth(network)
    lower = Spatial(network, a, r).cr_minus_one
    s = Setting(Parameters(1.0, 1.0, 0.3, a), growth, k, r, unconstrained=True)
    for bound in bounds_for("nearsight:sharp-cr"):
        value = bound.evaluate(s).values["cr_minus_one"]
        assert value is None or np.isnan(value) or lower <= value


def test_ten_thousand_agents():
    torus = Spatial(parse_graph("torus:100x100"), 0.25, 3)
    assert torus.cr_minus_one == pytest.approx(
        infinite_excess(parse_growth("grid2"), 0.25, 3), rel=1e-12
    )
    grid = Spatial(parse_graph("grid:30x30"), 0.25, 3)
    every = grid.charges()
    assert grid.cr_minus_one == pytest.approx(every.ratios[every.best], rel=1e-9)
    assert len(grid.found.agents) < 10


@pytest.mark.parametrize(
    "wrong",
    [
        lambda n: Spatial(n, -1.0, 1),
        lambda n: Spatial(n, np.nan, 1),
        lambda n: Spatial(n, 1.0, -1),
        lambda n: Spatial(n, 1.0, 1).charges([9]),
        lambda n: Spatial(n, 1.0, 1).charges().ratio(-1.0),
        lambda n: Spatial(n, 1.0, 1).problem([1.0]),
        lambda n: realisation(Spatial(n, 1.0, 1), np.eye(5), 0.0),
    ],
)
def test_bad_input(wrong):
    with pytest.raises(InputError):
        wrong(parse_graph("path:5"))


def test_without_couplings_or_blindness_there_is_no_bound():
    assert Spatial(parse_graph("path:5"), 0.0, 1).cr_minus_one == 0
    assert Spatial(parse_graph("path:5"), 1.0, 4).cr_minus_one == 0
