import time

import networkx as nx
import numpy as np
import pytest
import scipy
from hypothesis import given, settings
from hypothesis import strategies as st

import nearsight as ns
from nearsight.bounds import Setting, bounds_for
from nearsight.lowerbounds.deviation import Deviation
from nearsight.lowerbounds.energy import Energy
from nearsight.lowerbounds.inverse import solver
from nearsight.lowerbounds.pencil import Pencil
from nearsight.lowerbounds.worst_case import worst_case
from nearsight.lpc import Controller, instance
from nearsight.lpc.costs import LogCosh, Quadratic

from ..lpc.brute import oracle, played, problem_of

STYLES = ("attraction", "repulsion", "blocks", "tilted")
TINY = np.finfo(float).eps


def drawn(spec, H, a, x, l_f=1.0, **options):
    network = spec if isinstance(spec, ns.Network) else ns.parse_graph(spec, 1)
    parameters = ns.Parameters(1.0, l_f, a, x / max(network.max_degree, 1))
    return instance(network, H, parameters, **options)


def two_rings():
    return ns.Network.from_networkx(nx.disjoint_union(nx.cycle_graph(4), nx.empty_graph(2)))


REFERENCE = [
    (1, 2, 1, 3.1653e-1),
    (1, 3, 2, 6.9643e-3),
    (1, 4, 3, 3.9760e-4),
    (0.1, 3, 2, 1.6145e-6),
]


@pytest.mark.parametrize(("a", "k", "r", "known"), REFERENCE)
def test_values_of_the_theory_notes(a, k, r, known):
    found = worst_case(drawn("ring:13", 12, a, a), k, r)
    assert found.cr_minus_one == pytest.approx(known, rel=1e-4)
    assert found.method == "dense"
    assert found.residual <= 1e-12 * known


def brute(instance, k, r):
    """The brute force, which has no k = 1 or r = 0: LPC then plays the targets."""
    if k > 1 and r > 0:
        return instance.worst(k, r)[0]
    root, basis = instance.range
    off = root @ (instance.targets - instance.optimum) @ basis
    return np.linalg.norm(off, 2) ** 2


NETWORKS = ["path:1", "path:4", "ring:5", "star:5", two_rings()]


@pytest.mark.parametrize("spec", NETWORKS, ids=str)
@pytest.mark.parametrize("style", oracle.STYLES)
@pytest.mark.parametrize("n", [1, 2])
def test_brute_force_over_all_data(spec, style, n):
    # the data of the oracle: targets, x_0 and a shift for every row of a coupling
    network = ns.parse_graph(spec) if isinstance(spec, str) else spec
    rng = np.random.default_rng(len(style) + n)
    graph = oracle.Graph.of(network)
    hard = oracle.random_instance(rng, graph, 3, 1.3, 0.6, l_f=2.0, n=n, style=style, shifts=True)
    data = np.zeros(4 * network.vertices * n)
    for k, r in [(1, 3), (3, 0), (2, 1), (3, 2), (2, 5), (7, 1), (7, 7)]:
        found = worst_case(problem_of(hard, network, data), k, r)
        assert found.cr_minus_one == pytest.approx(brute(hard, k, r), rel=1e-8, abs=1e-22)


@pytest.mark.parametrize("style", STYLES)
@pytest.mark.parametrize("n", [1, 2])
@pytest.mark.parametrize(("k", "r"), [(1, 2), (3, 0), (2, 1), (3, 2), (9, 1)])
def test_the_worst_instance_has_its_ratio_when_it_is_played(style, n, k, r):
    problem = drawn("erdos-renyi:7x0.3", 4, 2.0, 1.0, 3.0, style=style, n=n, varying=n > 1, seed=4)
    found = worst_case(problem, k, r)
    run = ns.simulate(found.problem, k=k, r=r)
    assert run.ratio_minus_one == pytest.approx(found.cr_minus_one, rel=1e-9)
    assert run.optimum.cost == pytest.approx(1.0, rel=1e-12)


@pytest.mark.parametrize("style", STYLES)
def test_no_random_data_are_worse(style):
    problem = drawn("star:6", 4, 1.0, 2.0, 2.0, style=style, seed=2)
    found = worst_case(problem, 3, 1)
    rng = np.random.default_rng(0)
    for _ in range(20):
        theta, x_0 = rng.normal(size=(4, 6, 1)), rng.normal(size=(6, 1))
        centre = rng.normal(size=(4, 6, 2))
        other = ns.Problem(
            problem.network,
            4,
            Quadratic(problem.node.matrix, theta),
            Quadratic(problem.temporal.matrix, centre),
            Quadratic(problem.spatial.matrix, centre[:, :5]),
            x_0=x_0,
        )
        assert ns.simulate(other, k=3, r=1).ratio_minus_one <= found.cr_minus_one


@pytest.mark.parametrize(
    ("spec", "H", "style", "n"),
    [
        ("ring:13", 12, "attraction", 1),
        ("torus:4x5", 5, "blocks", 2),
        ("erdos-renyi:20x0.15", 8, "repulsion", 1),
        ("star:9", 6, "tilted", 2),
    ],
)
def test_the_iteration_finds_the_same(spec, H, style, n):
    problem = drawn(spec, H, 1.0, 4.0, 2.0, style=style, n=n, varying=n > 1, seed=3)
    dense = worst_case(problem, 3, 2, method="dense")
    found = worst_case(problem, 3, 2, method="lanczos", seed=5)
    assert found.cr_minus_one == pytest.approx(dense.cr_minus_one, rel=1e-8)
    assert found.method == "lanczos"
    again = worst_case(problem, 3, 2, method="lanczos", seed=5)
    assert found.cr_minus_one == again.cr_minus_one


def extended(problem, k, r):
    """CR - 1 in 60 digits, by dense linear algebra on the oracle's definition."""
    import mpmath as mp

    energy = Energy.of(problem)
    M, Q = (mp.matrix(m.toarray().tolist()) for m in (energy.hessian, energy.node))
    graph = oracle.Graph.of(problem.network)
    H, N, size = problem.H, problem.N, energy.size
    T = mp.zeros(size)
    for row in range(size):
        t, v = divmod(row, N)
        near = np.flatnonzero(graph.distance[v] <= r - 1)
        free = [s * N + u for s in range(t, min(t + k - 1, H)) for u in near]
        F = mp.matrix([[M[i, j] for j in free] for i in free])
        unit = mp.matrix([int(i == row) for i in free])
        w = mp.lu_solve(F, unit)
        for j in set(range(size)) - set(free):
            c = -mp.fsum(w[i] * M[f, j] for i, f in enumerate(free))
            if j // N < t:
                T[row, :] += c * T[j, :]
            else:
                T[row, j] += c
    R = mp.cholesky(M)
    form = R.T * T * (mp.inverse(Q) - mp.inverse(M)) * T.T * R
    return max(mp.eigsy((form + form.T) / 2, eigvals_only=True))


@pytest.mark.parametrize(
    ("spec", "H", "k", "r", "a", "x", "style", "below"),
    [
        ("path:1", 22, 18, 1, 1.0, 0.0, "attraction", 1e-19),
        ("path:11", 2, 4, 9, 0.1, 1.0, "attraction", 1e-15),
        ("path:9", 2, 3, 8, 1.0, 0.3, "tilted", 1e-20),
    ],
)
def test_tiny_ratios_are_accurate(spec, H, k, r, a, x, style, below):
    import mpmath as mp

    problem = drawn(spec, H, a, x, 1.5, style=style, seed=1)
    with mp.workdps(60):
        exact = float(extended(problem, k, r))
    assert 0 < exact < below
    for method in ("dense", "lanczos"):
        found = worst_case(problem, k, r, method=method).cr_minus_one
        assert found == pytest.approx(exact, rel=1e-12)


@pytest.mark.parametrize(
    ("spec", "style"), [("star:5", "attraction"), ("star:5", "repulsion"), ("path:1", "tilted")]
)
def test_where_the_optimum_costs_nothing_neither_does_lpc(spec, style):
    # xi = (x_0, x*) that the couplings do not feel, with the targets at x*
    problem = drawn(spec, 3, 1.0, 1.0, 1.0, style=style, seed=6)
    N = problem.N
    L, data = np.zeros((4 * N, 4 * N)), np.zeros((1, 2))
    for t in range(1, 4):
        pairs = [(problem.temporal, v, (t * N + v, t * N + v - N)) for v in range(N)]
        pairs += [(problem.spatial, e, t * N + ends) for e, ends in enumerate(problem.edges)]
        for cost, i, ends in pairs:
            L[np.ix_(ends, ends)] += cost.hessian(np.array([t]), np.array([i]), data)[0]
    values, vectors = np.linalg.eigh(L)
    kernel = vectors[:, values < 1e-12].T
    assert len(kernel)
    for xi in kernel:
        node = Quadratic(problem.node.matrix, xi[N:].reshape(3, N, 1))
        here = ns.Problem(
            problem.network, 3, node, problem.temporal, problem.spatial, x_0=xi[:N, None]
        )
        assert here.cost(played(Controller(here, 2, 1))) <= 100 * TINY**2


@pytest.mark.parametrize(
    ("spec", "a", "x", "k", "r", "reason"),
    [
        ("ring:5", 0.0, 0.0, 1, 0, "nothing is coupled"),
        ("path:1", 0.0, 1.0, 3, 1, "nothing is coupled"),
        ("ring:5", 1.0, 1.0, 6, 3, "reach everything"),
        ("ring:5", 0.0, 1.0, 2, 3, "reach everything"),
        ("ring:5", 1.0, 0.0, 6, 1, "reach everything"),
    ],
)
@pytest.mark.parametrize("method", ["dense", "lanczos"])
def test_ratios_that_are_one(spec, a, x, k, r, reason, method):
    found = worst_case(drawn(spec, 5, a, x), k, r, method=method)
    assert (found.cr_minus_one, found.residual, found.method) == (0.0, 0.0, "exact")
    assert reason in found.reason
    assert ns.simulate(found.problem, k=k, r=r).ratio_minus_one <= 1e-28


@pytest.mark.parametrize(("k", "r"), [(2, 1), (9, 1), (1, 0)])
@pytest.mark.parametrize(("a", "x"), [(1.0, 1.0), (0.0, 1.0), (1.0, 0.0)])
def test_a_single_step(a, x, k, r):
    graph = oracle.Graph.of(ns.parse_graph("star:5"))
    found = worst_case(drawn("star:5", 1, a, x), k, r).cr_minus_one
    assert found == pytest.approx(
        brute(oracle.uniform(graph, 1, a, x / 4), k, r), rel=1e-9, abs=1e-24
    )


@pytest.mark.parametrize("method", ["dense", "lanczos"])
def test_one_agent_without_look_ahead(method):
    # H = 1, k = 1: plays theta, the optimum is theta/(1 + a/2), all by hand
    found = worst_case(drawn("path:1", 1, 3.0, 0.0), 1, 0, method=method)
    assert found.cr_minus_one == pytest.approx(1.5, rel=1e-14)


def test_a_separate_part_changes_nothing_but_the_maximum():
    both, ring = drawn(two_rings(), 5, 1.0, 1.0), drawn("ring:4", 5, 1.0, 1.0)
    assert worst_case(both, 2, 1).cr_minus_one == pytest.approx(
        worst_case(ring, 2, 1).cr_minus_one, rel=1e-12
    )


@pytest.mark.parametrize(("style", "n"), [("tilted", 1), ("blocks", 2)])
def test_deviation_and_its_adjoint(style, n):
    problem = drawn("star:5", 4, 1.0, 1.0, 2.0, style=style, n=n, varying=True, seed=1)
    T = Deviation.of(Energy.of(problem).problem, 3, 1)
    rng = np.random.default_rng(0)
    D, y = rng.normal(size=(2, 20 * n, 3))
    assert np.sum(T.apply(D) * y) == pytest.approx(np.sum(D * T.adjoint(y)), rel=1e-12)
    # D from targets around an optimum at 0: LPC then deviates from 0
    pencil = Pencil.of(problem, 3, 1)
    star = pencil.solve(rng.normal(size=20 * n))
    x = played(Controller(pencil.energy.instance(star), 3, 1)).ravel()
    assert x - star == pytest.approx(T.apply(pencil.energy.gap(star)), abs=1e-12)


@pytest.mark.parametrize(("a", "x", "l_f"), [(0.0, 0.0, 1.0), (1.0, 20.0, 1.0), (0.1, 50.0, 9.0)])
def test_the_iteration_solves_like_the_factorisation(a, x, l_f):
    energy = Energy.of(drawn("torus:4x5", 4, a, x, l_f, style="tilted", varying=True))
    b = np.random.default_rng(0).normal(size=(energy.size, 2))
    exact = solver(energy, direct=True)(b)
    assert solver(energy, direct=False)(b) == pytest.approx(exact, rel=1e-12, abs=1e-12)


def test_what_is_not_quadratic_or_out_of_range_is_refused():
    problem = drawn("ring:5", 3, 1.0, 1.0)
    bent = LogCosh(np.eye(1), 0.0, 1.0, 1.0, 0.0)
    for other in (
        drawn("ring:5", 3, 1.0, 1.0, box=(-1.0, 1.0)),
        ns.Problem(problem.network, 3, bent, problem.temporal, problem.spatial),
    ):
        with pytest.raises(ns.InputError, match="quadratic costs without constraints"):
            worst_case(other, 2, 1)
    for wrong in ({"k": 0}, {"r": -1}, {"method": "guess"}, {"tolerance": 0.0}, {"workers": -1}):
        with pytest.raises(ns.InputError, match=next(iter(wrong))):
            worst_case(problem, **{"k": 2, "r": 1, **wrong})


def test_progress_speaks_of_policies_and_iterations():
    said = []
    problem = drawn("ring:5", 3, 1.0, 1.0, varying=True)
    worst_case(problem, 2, 1, method="lanczos", progress=said.append)
    assert said[0] == "policy of step 1/3"
    assert said[-1].startswith("worst case, iteration")


@st.composite
def cases(draw):
    size = draw(st.integers(1, 7))
    parents = [draw(st.integers(-1, v - 1)) for v in range(size)]  # -1: a part of its own
    extra = draw(
        st.lists(st.tuples(st.integers(0, size - 1), st.integers(0, size - 1)), max_size=4)
    )
    edges = {(p, v) for v, p in enumerate(parents) if p >= 0}
    edges |= {(min(e), max(e)) for e in extra if e[0] != e[1]}
    network = ns.Network.from_edges(size, np.array(sorted(edges), dtype=int).reshape(-1, 2))
    strength = st.sampled_from([0.0, 0.03, 0.3, 1.0, 4.0])
    style = draw(st.sampled_from(STYLES))
    problem = drawn(
        network,
        draw(st.integers(1, 5)),
        draw(strength),
        draw(strength),
        draw(st.sampled_from([1.0, 3.0])),
        style=style,
        n=draw(st.integers(1, 2)),
        varying=draw(st.booleans()),
        seed=draw(st.integers(0, 99)),
    )
    return problem, draw(st.integers(2, 6)), draw(st.integers(1, 4))


@settings(max_examples=40)
@given(cases())
def test_no_worst_case_exceeds_its_certificate(case):
    problem, k, r = case
    p = ns.lpc.promise(problem, k, r)
    growth = ns.network_growth(problem.network)
    setting = Setting(p.constants.parameters(), growth, k, r, unconstrained=True)
    found = worst_case(problem, k, r)
    for bound in bounds_for("nearsight:sharp-cr"):
        promised = bound.evaluate(setting).values["cr_minus_one"]
        if promised is not None:
            assert found.cr_minus_one <= promised * (1 + 1e-12)


@pytest.mark.parametrize("unit", [1e-250, 1e-6, 1e6, 1e250])
def test_the_unit_of_costs_does_not_matter(unit):
    given = ns.Parameters(unit, 2 * unit, unit, 0.5 * unit)
    one = ns.Parameters(1.0, 2.0, 1.0, 0.5)
    ring = ns.parse_graph("ring:6")
    found, known = (
        worst_case(instance(ring, 4, p, style="tilted"), 3, 2).cr_minus_one for p in (given, one)
    )
    assert found == pytest.approx(known, rel=1e-12)


def test_couplings_weaker_than_any_square():
    # k = 1: LPC plays theta, D = (a/2) L y, and |D|^2/(y'(a/2) L y) is largest at the top of L
    a, H = 1e-160, 4
    L = np.diag([2.0] * (H - 1) + [1.0]) - np.eye(H, k=1) - np.eye(H, k=-1)
    exact = a / 2 * np.linalg.eigvalsh(L)[-1]
    found = worst_case(drawn("path:1", H, a, 0.0), 1, 0)
    assert found.cr_minus_one == pytest.approx(exact, rel=1e-12)
    far = worst_case(drawn("ring:6", 5, a, a), 3, 2)
    assert (far.cr_minus_one, far.method) == (0.0, "exact")
    assert far.residual > 0
    assert "below 1e-290" in far.reason


@pytest.mark.filterwarnings("error")
def test_couplings_beyond_all_numbers():
    with pytest.raises(ns.NearsightError, match="overflow"):
        worst_case(drawn("ring:6", 5, 1e300, 1e300), 3, 2)


def by_waves(N, H, a, a_S, k, r):
    """CR - 1 on the ring of N, wave by wave: ``x_0 = 0``, theta_t = cos(2 pi m v/N) u_t."""
    chain = np.diag([2.0] * (H - 1) + [1.0]) - np.eye(H, k=1) - np.eye(H, k=-1)
    # the local problem of agent 0 at step t, on the places -r..r around it
    places = np.arange(-r, r + 1)
    near = 2 * np.eye(len(places)) - np.eye(len(places), k=1) - np.eye(len(places), k=-1)
    window = np.eye(H * len(places)) + a / 2 * np.kron(chain, np.eye(len(places)))
    window += a_S / 2 * np.kron(np.eye(H), near)
    rows = []
    for t in range(H):
        steps = np.arange(t, min(t + k - 1, H))[:, None] * len(places)
        free = (steps + np.flatnonzero(np.abs(places) <= r - 1)).ravel()
        unit = (free == t * len(places) + r).astype(float)
        weights = np.linalg.solve(window[np.ix_(free, free)], unit)
        row = -weights @ window[free]
        row[free] = weights
        rows.append(row.reshape(H, len(places)))
    found = 0.0
    for m in range(N // 2 + 1):
        angle = 2 * np.pi * m / N
        M = (1 + a_S * (1 - np.cos(angle))) * np.eye(H) + a / 2 * chain
        gain = np.array(rows) @ np.cos(angle * places)
        x = np.zeros((H, H))
        for t in range(H):
            x[t] = gain[t, :t] @ x[:t]
            x[t, t:] += gain[t, t:]
        off = x - np.linalg.inv(M)
        paid, least = off.T @ M @ off, np.eye(H) - np.linalg.inv(M)
        found = max(found, scipy.linalg.eigh(paid, least, eigvals_only=True)[-1])
    return found


@pytest.mark.parametrize(("N", "H", "k", "r"), [(13, 12, 3, 2), (60, 20, 4, 2), (200, 30, 2, 3)])
def test_rings_wave_by_wave(N, H, k, r):
    problem = instance(ns.parse_graph(f"ring:{N}"), H, ns.Parameters(1.0, 1.0, 1.0, 0.5))
    found = worst_case(problem, k, r, method="lanczos")
    assert found.cr_minus_one == pytest.approx(by_waves(N, H, 1.0, 0.5, k, r), rel=1e-8)


@pytest.mark.slow
def test_a_thousand_agents_over_a_hundred_steps_in_a_minute():
    problem = instance(ns.parse_graph("ring:1000"), 100, ns.Parameters(1.0, 1.0, 1.0, 0.5))
    start = time.process_time()
    found = worst_case(problem, 3, 2)
    assert time.process_time() - start < 60
    assert found.method == "lanczos"
    assert found.cr_minus_one == pytest.approx(by_waves(1000, 100, 1.0, 0.5, 3, 2), rel=1e-8)
    run = ns.simulate(found.problem, k=3, r=2)
    assert run.ratio_minus_one == pytest.approx(found.cr_minus_one, rel=1e-9)
