import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nearsight.graphs import InputError, Network


@given(st.integers(1, 12), st.randoms(use_true_random=False))
def test_edges_become_sorted_adjacency(n, random):
    pairs = [(a, b) for a in range(n) for b in range(a) if random.random() < 0.4]
    random.shuffle(pairs)
    network = Network.from_edges(n, pairs)
    graph = nx.empty_graph(n)
    graph.add_edges_from(pairs)
    assert (network.vertices, network.edges) == (n, len(pairs))
    assert network.degrees.tolist() == [d for _, d in graph.degree()]
    assert network.max_degree == max(d for _, d in graph.degree())
    for v in range(n):
        assert network.neighbours(v).tolist() == sorted(graph[v])


def test_layout_of_the_arrays():
    network = Network.from_edges(3, [(2, 0), (1, 0)], names="abc", source="here")
    assert (network.indptr.dtype, network.indices.dtype) == (np.int64, np.int32)
    assert network.indptr.tolist() == [0, 2, 3, 4]
    assert network.indices.tolist() == [1, 2, 0, 0]
    assert (network.names, network.source, network.transitive) == (("a", "b", "c"), "here", False)


@pytest.mark.parametrize("array", ["indptr", "indices", "degrees"])
def test_arrays_cannot_be_changed(array):
    network = Network.from_edges(2, [(0, 1)])
    with pytest.raises(ValueError, match="read-only"):
        getattr(network, array)[0] = 1


def test_arrays_are_copied():
    indptr, indices = np.array([0, 1, 2]), np.array([1, 0])
    network = Network(indptr, indices, ("a", "b"), "test")
    indices[0] = 0
    assert network.indices.tolist() == [1, 0]


@pytest.mark.parametrize(
    ("n", "edges", "message"),
    [
        (0, [], "edges: the graph has no vertices; at least one is needed"),
        (3, [(0, 1), (2, 2)], r"1 self-loop\(s\), the first at vertex 2"),
        (3, [(0, 1), (1, 2), (1, 0)], r"1 parallel edge\(s\), the first between 0 and 1"),
        (3, [(0, 3)], r"edge \(0, 3\) leaves the vertices 0\.\.2"),
        (3, [(-1, 0)], r"edge \(-1, 0\) leaves the vertices 0\.\.2"),
        (3, [(0, 1, 2)], r"integers of shape \(E, 2\), not int64 of \(1, 3\)"),
        (3, [(0.0, 1.0)], r"integers of shape \(E, 2\), not float64 of \(1, 2\)"),
    ],
)
def test_bad_edges(n, edges, message):
    with pytest.raises(InputError, match=message):
        Network.from_edges(n, edges)


@pytest.mark.parametrize(
    ("indptr", "indices", "names", "message"),
    [
        ([0], [], "", "no vertices"),
        ([0, 1, 3], [1, 0], "ab", "does not divide"),
        ([0, 1, 2], [2, 0], "ab", "leaves the vertices"),
        ([0, 1, 2], [1, 0], "aa", "needs 2 different names, has 1"),
        ([0, 1, 1], [1], "ab", "not sorted, or not symmetric"),
        ([0, 2, 3, 4], [2, 1, 0, 0], "abc", "not sorted, or not symmetric"),
    ],
)
def test_bad_adjacency(indptr, indices, names, message):
    with pytest.raises(InputError, match=message):
        Network(np.array(indptr), np.array(indices), tuple(names), "test")


def test_bad_names_and_symmetry():
    with pytest.raises(InputError, match="1 names for 2 vertices"):
        Network.from_edges(2, [(0, 1)], names=["a"])
    with pytest.raises(InputError, match="regular, this is not"):
        Network.from_edges(3, [(0, 1), (1, 2)], transitive=True)
