"""The matrices of the lemmas and their combinatorics, against loops, SymPy and mpmath."""

from itertools import product
from math import comb

import mpmath
import networkx as nx
import numpy as np
import pytest
import sympy

from nearsight.bounds import Parameters
from nearsight.graphs import InputError, parse_graph
from nearsight.perturbation.lemmas import _specimen, first_order, series, walks
from nearsight.perturbation.lemmas._extended import Minimiser
from nearsight.perturbation.lemmas._hierarchy import Hierarchy, distances
from nearsight.perturbation.lemmas._specimen import Shape, Specimen


def by_hand(specimen):
    """M and the cross blocks by loops over single costs."""
    h, local = specimen.hierarchy, specimen.local
    problem, n, v0 = local.problem, h.n, specimen.shape.v
    graph = nx.convert_node_labels_to_integers(problem.network.to_networkx())
    reach = nx.single_source_shortest_path_length(graph, v0)
    inner = sorted(u for u, q in reach.items() if q <= specimen.shape.r - 1)
    k = specimen.shape.k
    free = [(t, u) for t in range(1, k) for u in inner]
    value = {tuple(a[1:]): x for a, x in zip(local.terms.free, h.x, strict=True)}
    value |= {tuple(a[1:]): x for a, x in zip(local.terms.fixed, h.fixed, strict=True)}
    fixed = [tuple(a[1:]) for a in local.terms.fixed]
    place = {a: i for i, a in enumerate(free + fixed)}
    W = np.zeros((len(place) * n, len(place) * n))

    def add(cost, t, i, ends):
        if not set(ends) & set(free):
            return
        w = np.concatenate([value[a] for a in ends])[None]
        B = cost.hessian(np.array([t]), np.array([i]), w)[0]
        rows = np.concatenate([np.arange(n) + n * place[a] for a in ends])
        W[np.ix_(rows, rows)] += B

    for t, u in free:
        add(problem.node, t, u, [(t, u)])
    for t, u in product(range(1, k + 1), range(problem.N)):
        add(problem.temporal, t, u, [(t, u), (t - 1, u)])
    for t, (e, (u, w)) in product(range(1, k), enumerate(problem.edges)):
        add(problem.spatial, t, e, [(t, int(u)), (t, int(w))])
    m = len(free) * n
    return W[:m, :m], -W[:m, m:], inner


@pytest.mark.parametrize("seed", range(40))
def test_matrices_are_sums_of_the_costs_hessians(seed):
    specimen = _specimen.drawn(seed, k=4)
    M, cross, inner = by_hand(specimen)
    h = specimen.hierarchy
    assert h.agents.tolist() == inner
    np.testing.assert_allclose(h.M, M, atol=1e-12 * np.abs(M).max())
    np.testing.assert_allclose(h.cross, cross, atol=1e-12 * np.abs(M).max())
    np.testing.assert_array_equal(h.D + h.A, h.M)
    np.testing.assert_allclose(h.D @ h.inverse_D, np.eye(len(M)), atol=1e-9)
    for i, j in product(h.steps, h.steps):
        assert (i == j) or not h.slice(h.D, i, j).any()
        assert (i != j) or not h.slice(h.A, i, j).any()


def test_the_constants_of_the_class_bound_the_blocks():
    for seed in range(60):
        specimen = _specimen.drawn(seed)
        h, p = specimen.hierarchy, specimen.parameters
        assert h.norms(h.A).max() <= p.l_T / 2 * (1 + 1e-12)
        assert np.linalg.eigvalsh(h.M)[0] >= p.mu * (1 - 1e-12)


@pytest.mark.parametrize("graph", ["erdos-renyi:12x0.15", "tree:3x2", "ring-of-blocks:4x2"])
def test_distances(graph):
    network = parse_graph(graph, 3)
    lengths = dict(nx.all_pairs_shortest_path_length(
        nx.convert_node_labels_to_integers(network.to_networkx())))  # fmt: skip
    found = distances(network)
    for u, v in product(range(network.vertices), repeat=2):
        assert found[u, v] == lengths[u].get(v, np.inf)


def test_a_window_beyond_the_horizon_or_without_freedom_is_rejected():
    constants = Parameters(1.0, 1.0, 1.0, 1.0)
    for shape in (Shape("ring:5", k=1), Shape("ring:5", r=0)):
        with pytest.raises(InputError, match="nothing is free"):
            _ = Specimen(shape, constants).hierarchy
    found = Specimen(Shape("ring:5", k=3), constants).local
    late = type(found)(found.problem, 2, 0, 3, 1)
    F, G = len(late.terms.free), len(late.terms.fixed)
    with pytest.raises(InputError, match="at most H = 3"):
        Hierarchy(late, np.zeros((F, 1)), np.zeros((G, 1)))


@pytest.mark.parametrize("S", [1, 2, 3, 5])
def test_powers_of_j_in_noncommuting_symbols(S):
    J = sympy.zeros(S, S)
    for i, j in product(range(S), repeat=2):
        if abs(i - j) == 1:
            names = f"A{i + 1}{j + 1} D{j + 1}"
            a, d = sympy.symbols(names, commutative=False)
            J[i, j] = a * d
    power = sympy.eye(S)
    for l in range(1, 7):  # noqa: E741 - the paper's letter
        power = (power * J).applyfunc(sympy.expand)
        counts = walks.counts(S, l)
        for i, j in product(range(S), repeat=2):
            terms = sympy.Add.make_args(power[i, j]) if power[i, j] != 0 else ()
            # every term is one product of l factors A D, and occurs once
            assert all(len(sympy.Mul(t).args) == 2 * l or not t.args for t in terms) or S == 2
            assert len(terms) == (counts[i, j] if S != 2 else min(counts[i, j], 1))
            gap = abs(i - j)
            allowed = comb(l, (l - gap) // 2) if l >= gap and (l - gap) % 2 == 0 else 0
            assert allowed == walks.most(l, gap)
            assert len(terms) <= allowed
            if walks.away(S, l, i + 1, j + 1) and allowed:
                assert len(terms) == allowed


@pytest.mark.parametrize("S", range(1, 9))
def test_the_number_of_terms_is_the_binomial_exactly_away_from_the_ends(S):
    for l in range(1, 10):  # noqa: E741 - the paper's letter
        for i in range(1, S + 1):
            ends = [i]
            for _ in range(l):
                ends = [e for b in ends for e in (b - 1, b + 1) if 1 <= e <= S]
            for j in range(1, S + 1):
                number, bound = ends.count(j), walks.most(l, abs(i - j))
                assert number == walks.counts(S, l)[i - 1, j - 1] <= bound
                if bound:
                    assert (number == bound) == walks.away(S, l, i, j)


@pytest.mark.parametrize("style", ["attraction", "blocks", "logcosh", "softplus", "tilted"])
def test_extended_gradients_agree_with_floats(style):
    shape = Shape("tree:2x2", k=3, r=2, style=style, n=2, seed=4, varying=True)
    specimen = Specimen(shape, Parameters(1.0, 2.0, 0.7, 1.3))
    terms, h = specimen.local.terms, specimen.hierarchy
    with mpmath.workdps(30):
        wide = Minimiser(terms).gradient(h.x + mpmath.mpf(0), h.fixed + mpmath.mpf(0))
    found = wide.astype(float)
    np.testing.assert_allclose(found, terms.gradient(h.x, h.fixed), atol=1e-13)


def test_the_derivative_of_a_minimiser_known_in_closed_form():
    # one agent, one free step: ((l/2)(y + z) + mu theta)/(mu + l)
    mu, l_T = 2.0, 3.0
    specimen = Specimen(Shape("path:1", k=2, r=1), Parameters(mu, mu, l_T, 0.0))
    terms = specimen.local.terms
    found = Minimiser(terms).derivative(np.array([[0.3], [-1.0]]), np.array([[1.0], [0.0]]))
    np.testing.assert_allclose(found, [l_T / 2 / (mu + l_T)], rtol=1e-14)


def test_a_wrong_hessian_breaks_the_first_order_identity(monkeypatch):
    specimen = Specimen(Shape("path:3", k=3, style="logcosh"), Parameters(1.0, 2.0, 1.0, 1.0))
    G = len(specimen.local.terms.fixed)
    fixed, e = np.linspace(-1, 1, G)[:, None], np.ones((G, 1))
    derivative, structure = first_order.compare(specimen.local, fixed, e)
    assert derivative.holds
    assert structure.holds
    right = Hierarchy.M.fget
    monkeypatch.setattr(Hierarchy, "M", property(lambda h: right(h) * (1 + 1e-7)))
    derivative, _ = first_order.compare(specimen.local, fixed, e)
    assert not derivative.holds


def test_two_matrices_of_one_name_at_k_2():
    # the two R^(1) of k = 2 are different: read as one, the identity is wrong
    shape = Shape("path:1", k=2, r=1, style="tilted", varying=True, seed=1)
    h = Specimen(shape, Parameters(1.0, 1.0, 1.0, 0.0)).hierarchy
    first, last = h.cross[0]
    assert abs(first - last) > 0.1


def test_remainders_in_extended_precision():
    specimen = _specimen.drawn(11, k=5)
    h = specimen.hierarchy
    rows, norms = series._remainders(h)
    with mpmath.workdps(40):
        M, D = mpmath.matrix(h.M.tolist()), mpmath.matrix(h.D.tolist())
        inverse, J = M**-1, (M - D) * D**-1
        total, power = mpmath.zeros(M.rows, M.rows), mpmath.eye(M.rows)
        for L, norm in zip(range(1, 4), norms, strict=False):
            total, power = total + power, -power * J
            gap = np.array((inverse - D**-1 * total).tolist(), dtype=float)
            assert np.linalg.norm(gap, 2) == pytest.approx(norm, rel=1e-9, abs=1e-13), L
    assert (rows >= 0).all()
