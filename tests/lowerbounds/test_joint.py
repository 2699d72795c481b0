"""Time and space together, against one linear system over all policies, and LPC."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.graphs import InputError, Network, network_growth, parse_graph
from nearsight.lowerbounds import Joint, Spatial, Temporal, floor
from nearsight.lpc import simulate
from nearsight.lpc.constants import constants

CASES = [
    ("ring:5", 1.0, 0.7, 1, 1, 3),
    ("path:4", 3.0, 2.0, 2, 1, 4),
    ("star:4", 0.2, 5.0, 2, 1, 3),
    ("path:5", 2.0, 2.0, 1, 0, 3),
]


@pytest.mark.parametrize("case", CASES)
def test_team_problem_as_one_linear_system(case):
    spec, a_T, a_S, k, r, H = case
    network = parse_graph(spec)
    N = network.vertices
    whole = Joint(network, a_T, a_S, k, r, H)
    # the Hessian, from the costs
    A = np.zeros((N, N))
    for v in range(N):
        A[v, network.neighbours(v)] = 1
    L = np.diag(A.sum(0)) - A
    T = np.diag([2.0] * (H - 1) + [1.0]) - np.eye(H, k=1) - np.eye(H, k=-1)
    M = np.eye(H * N) + a_T / 2 * np.kron(T, np.eye(N)) + a_S / 2 * np.kron(np.eye(H), L)
    np.testing.assert_allclose(whole.system.matrix.toarray(), M, atol=1e-14)
    # who may know what, by spreading step by step
    reach = np.linalg.matrix_power(A + np.eye(N), r) > 0 if r else np.eye(N, dtype=bool)
    root, B = np.linalg.cholesky(M).T, np.linalg.inv(M)
    found = whole.charges()
    for source in range(H * N):
        tau, j = divmod(source, N)
        knows, support = np.zeros(N, dtype=bool), []
        for t in range(H):
            if tau <= t + k - 1:
                knows = reach @ (knows | (np.arange(N) == j))
            support += [t * N + v for v in np.flatnonzero(knows)]
        columns = root[:, support]
        policy = np.linalg.lstsq(columns, root @ B[:, source], rcond=None)[0]
        left = columns @ policy - root @ B[:, source]
        assert found.team[source] == pytest.approx(left @ left, rel=1e-8, abs=1e-14)
        assert found.optimal[source] == pytest.approx(1 - B[source, source], rel=1e-10)


def test_special_cases():
    network = parse_graph("ring:6")
    alone = Joint(network, 1.5, 0.0, 2, 1, 5)
    assert alone.cr_minus_one(0) == pytest.approx(Temporal(1.5, 2, 5).cr_minus_one, rel=1e-12)
    once = Joint(network, 0.0, 1.5, 2, 1, 1)
    assert once.cr_minus_one(0) == pytest.approx(Spatial(network, 1.5, 1).cr_minus_one, rel=1e-12)
    # fewer agents take part: those of a path of 3 in the ring
    few = Joint(network, 1.0, 1.0, 1, 1, 2, agents=[0, 1, 2])
    path = Joint(parse_graph("path:3"), 1.0, 1.0, 1, 1, 2)
    assert few.cr_minus_one(2) == pytest.approx(path.cr_minus_one(2), rel=1e-12)


@pytest.mark.parametrize("case", CASES)
def test_lpc_pays_the_bound(case):
    spec, a_T, a_S, k, r, H = case
    whole = Joint(parse_graph(spec), a_T, a_S, k, r, H)
    found = whole.charges()
    step, agent = divmod(int(found.agents[found.best]), whole.network.vertices)
    problem = whole.problem(agent, step + 1, mu=2.0)
    run = simulate(problem, k, r)
    assert run.ratio_minus_one >= found.ratios[found.best] * (1 - 1e-9)
    derived = constants(problem)
    assert (derived.l_T.value, derived.l_S.value) == pytest.approx((2 * a_T, 2 * a_S))


@st.composite
def networks(draw):
    """Any graph of at most eight vertices, disconnected ones among them."""
    size = draw(st.integers(1, 8))
    pairs = [(u, v) for v in range(size) for u in range(v)]
    chosen = draw(st.lists(st.sampled_from(pairs), unique=True) if pairs else st.just([]))
    return Network.from_edges(size, np.array(sorted(chosen), dtype=int).reshape(-1, 2))


STRENGTHS = st.sampled_from([0.0, 1e-8, 0.01, 0.1, 0.5, 1.0, 3.0, 10.0, 1e3])


@settings(max_examples=40)
@given(networks(), STRENGTHS, STRENGTHS, st.integers(2, 5), st.integers(1, 3))
def test_all_bounds_are_below_the_certificates(network, a, x, k, r):
    s = Setting(Parameters(2.0, 2.0, 2 * a, 2 * x), network_growth(network), k, r)
    found = floor(s, network, k, r)
    free = Setting(s.parameters, s.growth, k, r, unconstrained=True)
    upper = np.inf
    for bound in bounds_for("nearsight:sharp-cr"):
        value = bound.evaluate(free).values["cr_minus_one"]
        upper = min(upper, np.inf if value is None or np.isnan(value) else value)
    for part in (found.temporal, found.spatial, found.joint):
        assert 0 <= part.cr_minus_one <= upper
    assert found.cr_minus_one == getattr(found, found.best).cr_minus_one


@pytest.mark.parametrize(
    "wrong",
    [
        lambda n: Joint(n, -1.0, 1.0, 1, 1, 2),
        lambda n: Joint(n, 1.0, np.inf, 1, 1, 2),
        lambda n: Joint(n, 1.0, 1.0, 0, 1, 2),
        lambda n: Joint(n, 1.0, 1.0, 1, -1, 2),
        lambda n: Joint(n, 1.0, 1.0, 1, 1, 10**6),
        lambda n: Joint(n, 1.0, 1.0, 1, 1, 2, agents=[7]),
        lambda n: Joint(n, 1.0, 1.0, 1, 1, 2, agents=[0, 1]).cr_minus_one(3),
        lambda n: Joint(n, 1.0, 1.0, 1, 1, 2).problem(0, 3),
    ],
)
def test_bad_input(wrong):
    with pytest.raises(InputError):
        wrong(parse_graph("path:5"))


@pytest.mark.parametrize(
    ("spec", "a_T", "a_S", "k", "r", "H"),
    [
        ("path:3", 1e-8, 1e-8, 5, 1, 6),
        ("star:4", 1e-3, 1e-12, 1, 1, 2),
        ("path:2", 1e8, 1e8, 2, 0, 3),
    ],
)
def test_every_charge_in_extended_precision(spec, a_T, a_S, k, r, H):
    # a ground of 1 + 5e-9, 1 taken away again, leaves eight digits
    network = parse_graph(spec)
    N = network.vertices
    whole = Joint(network, a_T, a_S, k, r, H)
    found = whole.charges()
    with mp.workdps(120):
        M = mp.eye(H * N)
        for i in range(H * N):
            t, v = divmod(i, N)
            others = [t * N + int(u) for u in network.neighbours(v)]
            pairs = [(mpf(a_S) / 2, j) for j in others]
            pairs += [(mpf(a_T) / 2, i - N), (mpf(a_T) / 2, i + N if t + 1 < H else None)]
            for weight, j in pairs:
                if j is not None:
                    M[i, i] += weight
                    if j >= 0:
                        M[i, j] -= weight
        B = M**-1
        for j, seen in enumerate(whole.seen(np.arange(H * N))):
            S = [int(i) for i in seen]
            part = mp.matrix([[M[a, b] for b in S] for a in S]) ** -1
            team = B[j, j] - part[S.index(j), S.index(j)]
            assert abs(found.optimal[j] / (1 - B[j, j]) - 1) < 1e-12
            if team > mpf(10) ** -100:
                assert abs(found.team[j] / team - 1) < 1e-12
            else:
                assert found.team[j] == 0
