import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nearsight.graphs import Network, Profile, network_profile, parse_graph
from nearsight.graphs import bitsearch as bits
from nearsight.graphs import profile as module


def brute_force(graph):
    """h, ball and eta by their definitions, from all shortest path lengths."""
    d = dict(nx.all_pairs_shortest_path_length(graph))
    last = max(max(row.values()) for row in d.values())
    sphere = {
        q: {v: [u for u, x in row.items() if x == q] for v, row in d.items()}
        for q in range(last + 1)
    }
    h = tuple(max(map(len, sphere[q].values())) for q in range(last + 1))
    ball = tuple(
        max(sum(len(sphere[p][v]) for p in range(q + 1)) for v in graph) for q in range(last + 1)
    )
    eta = tuple(
        max(sum(d[v].get(w) == q - 1 for v in sphere[q][u] for w in graph[u]) for u in graph)
        for q in range(last + 1)
    )
    return Profile(h, ball, eta, True)


def cut(profile, radius):
    n = radius + 1
    return (profile.h[:n], profile.ball[:n], profile.eta[:n], len(profile.h) <= n)


@st.composite
def graphs(draw):
    """Small graphs of several components: isolated vertices, paths, cycles, sparse, dense."""
    parts = draw(st.lists(st.tuples(st.integers(1, 14), st.floats(0, 1)), min_size=1, max_size=3))
    seed = draw(st.integers(0, 2**16))
    graph = nx.disjoint_union_all([nx.gnp_random_graph(n, p, seed=seed) for n, p in parts])
    kind = draw(st.sampled_from([nx.path_graph, nx.cycle_graph, nx.empty_graph, nx.star_graph]))
    return nx.disjoint_union(graph, kind(draw(st.integers(3, 9))))


@given(graphs())
def test_against_the_definition(graph):
    expected = brute_force(graph)
    assert network_profile(Network.from_networkx(graph)) == expected


@given(graphs(), st.integers(0, 8))
def test_truncated(graph, radius):
    found = network_profile(Network.from_networkx(graph), radius)
    h, ball, eta, complete = cut(brute_force(graph), radius)
    assert (found.h, found.ball, found.eta, found.complete) == (h, ball, eta, complete)


@pytest.mark.parametrize(
    "spec",
    [
        "grid:9x17",
        "tree:3x4",
        "barabasi-albert:150x3",
        "geometric:150x0.12",
        "star:100",
        "erdos-renyi:150x0.02",
        "erdos-renyi:80x0.9",
        "regular:3x150",
        "complete:20",
    ],
)
@pytest.mark.parametrize("words", [1, 2, 64])
def test_several_batches(spec, words, monkeypatch):
    # one word is 64 sources, so these graphs take up to three batches; chunks of 8 rows as well
    monkeypatch.setattr(module, "MAX_WORDS", words)
    monkeypatch.setattr(bits, "CHUNK_WORDS", 8)
    network = parse_graph(spec, seed=5)
    assert network_profile(network) == brute_force(network.to_networkx())


@pytest.mark.parametrize(
    "spec",
    [
        "ring:3",
        "ring:10",
        "ring:11",
        "torus:5x8",
        "hypercube:5",
        "complete:6",
        "complete:1",
        "ring-of-blocks:3x2",
        "ring-of-blocks:4x3",
        "ring-of-blocks:9x2",
        "hypercube:0",
    ],
)
@pytest.mark.parametrize("radius", [None, 0, 1, 2])
def test_transitive_needs_one_search(spec, radius):
    network = parse_graph(spec)
    plain = Network(network.indptr, network.indices, network.names, network.source)
    assert network.transitive
    assert network_profile(network, radius) == network_profile(plain, radius)
    if radius is None:
        assert network_profile(network) == brute_force(network.to_networkx())


@pytest.mark.parametrize("graph", [nx.path_graph(n) for n in range(1, 10)], ids=len)
def test_paths(graph):
    assert network_profile(Network.from_networkx(graph)) == brute_force(graph)


@pytest.mark.parametrize("graph", [nx.cycle_graph(n) for n in range(3, 10)], ids=len)
def test_cycles(graph):
    assert network_profile(Network.from_networkx(graph)) == brute_force(graph)


def test_long_thin_graphs():
    path = network_profile(parse_graph("path:10000"))
    assert len(path.h) == 10_000
    assert path.h[4999:5001] == (2, 1)
    ladder = network_profile(parse_graph("grid:2x300"))
    # from the middle of a ladder: two vertices each way on both sides
    assert ladder.h[:4] == (1, 3, 4, 4)
    assert len(ladder.h) == 301


def test_grid_sides_show():
    # the far corners are the only pairs at distance A + B - 2
    profile = network_profile(parse_graph("grid:30x40"))
    assert len(profile.h) == 69
    assert profile.h[:15] == (1, *(4 * q for q in range(1, 15)))
    assert profile.h[-1] == 1
    assert profile.ball[-1] == 1200


def test_many_neighbours_of_one_vertex():
    # more than a call can share: the rows of hubs go one by one
    graph = nx.complete_multipartite_graph(3, 400)
    graph.add_edge(0, 1)
    assert network_profile(Network.from_networkx(graph)) == brute_force(graph)


def test_progress_counts_batches(monkeypatch):
    monkeypatch.setattr(module, "MAX_WORDS", 1)
    calls = []
    network_profile(parse_graph("grid:10x20"), progress=lambda *call: calls.append(call))
    assert calls == [(1, 4), (2, 4), (3, 4), (4, 4)]


def test_negative_radius():
    with pytest.raises(ValueError, match="radius is at least 0, not -1"):
        network_profile(parse_graph("ring:5"), -1)


@settings(max_examples=30)
@given(st.integers(1, 200), st.integers(1, 100), st.integers(0, 2**32))
def test_popcount(rows, words, seed):
    data = np.random.default_rng(seed).integers(0, 2**64, (rows, words), dtype=np.uint64)
    expected = np.unpackbits(data.view(np.uint8), axis=1).sum(axis=1)
    assert np.array_equal(bits._popcount(data), expected)
