import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nearsight.graphs import InputError, Network


@given(st.integers(1, 10), st.floats(0, 1), st.integers(0, 99))
def test_round_trip(n, p, seed):
    graph = nx.relabel_nodes(nx.gnp_random_graph(n, p, seed=seed), str)
    back = Network.from_networkx(graph).to_networkx()
    assert list(back) == list(graph)
    assert nx.utils.graphs_equal(back, graph)


def test_a_multigraph_without_parallel_edges_is_accepted():
    assert Network.from_networkx(nx.MultiGraph([("a", "b")])).edges == 1


@pytest.mark.parametrize(
    ("graph", "message"),
    [
        (nx.Graph(), "here: the graph has no vertices; at least one is needed"),
        (nx.DiGraph([("a", "b"), ("b", "a")]), r"here: directed \(2 arcs, the first a -> b\)"),
        (nx.empty_graph(2, nx.DiGraph), r"here: directed \(0 arcs\)"),
        (nx.Graph([("a", "b"), ("c", "c"), ("d", "d")]), r"2 self-loop\(s\), the first at c"),
        (
            nx.MultiGraph([("a", "b"), ("b", "c"), ("c", "b"), ("b", "c")]),
            r"2 parallel edge\(s\), the first between b and c",
        ),
        (nx.Graph([(1, "1")]), "two vertices are both named '1'"),
    ],
)
def test_rejected_by_name(graph, message):
    with pytest.raises(InputError, match=message) as caught:
        Network.from_networkx(graph, source="here")
    assert "\n" not in str(caught.value)


def test_rejection_says_what_would_help():
    with pytest.raises(InputError, match="a simple undirected graph is accepted, or pass --clean"):
        Network.from_networkx(nx.Graph([(1, 1)]))


@pytest.mark.parametrize("kind", [nx.MultiDiGraph, nx.MultiGraph, nx.DiGraph, nx.Graph])
def test_cleaning(kind):
    graph = kind([("a", "b"), ("b", "a"), ("a", "b"), ("c", "c"), ("b", "c")])
    network = Network.from_networkx(graph, clean=True)
    assert sorted(network.to_networkx().edges()) == [("a", "b"), ("b", "c")]


def test_cleaning_keeps_vertices_without_edges():
    network = Network.from_networkx(nx.MultiDiGraph([("a", "a")]), clean=True)
    assert (network.names, network.edges) == (("a",), 0)
