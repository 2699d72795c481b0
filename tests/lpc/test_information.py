"""Balls and information sets, against networkx and the definitions."""

import networkx as nx
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nearsight.graphs import InputError, parse_graph
from nearsight.lpc import information_set
from nearsight.lpc.information import Balls

SPECS = ["ring:7", "grid:4x5", "erdos-renyi:20x0.1", "path:1", "star:6"]


@pytest.mark.parametrize("spec", SPECS)
@pytest.mark.parametrize("radius", [0, 1, 2, 9])
def test_balls_are_those_of_networkx(spec, radius):
    network = parse_graph(spec, seed=1)
    graph = nx.convert_node_labels_to_integers(network.to_networkx())
    balls = Balls.of(network, radius)
    for v in range(network.vertices):
        distance = nx.single_source_shortest_path_length(graph, v, cutoff=radius)
        expected = sorted(distance, key=lambda u: (distance[u], u))
        assert balls.ball(v).tolist() == expected
        for q in range(-1, radius + 1):
            inside = [u for u in expected if distance[u] <= q]
            assert balls.ball(v, q).tolist() == inside
            assert balls.within(q).ball(v).tolist() == inside


@given(st.integers(1, 5), st.integers(0, 4), st.integers(0, 19), st.integers(1, 9))
def test_information_sets_are_products(k, r, v, t):
    network = parse_graph("grid:4x5")
    graph = nx.convert_node_labels_to_integers(network.to_networkx())
    distance = nx.single_source_shortest_path_length(graph, v)

    def product(k, r):
        return {(s, u) for s in range(t, t + k) for u in distance if distance[u] <= r}

    found = information_set(network, t, v, k, r)
    sets = {
        name: [tuple(map(int, pair)) for pair in getattr(found, name)]
        for name in ("everything", "free", "boundary", "bottom")
    }
    assert all(len(set(pairs)) == len(pairs) for pairs in sets.values())
    assert set(sets["everything"]) == product(k, r)
    assert set(sets["free"]) == product(k - 1, r - 1)
    assert set(sets["boundary"]) == product(k, r) - product(k - 1, r - 1)
    assert set(sets["bottom"]) == {(t - 1, u) for u in distance if distance[u] <= r}


def test_bad_arguments():
    network = parse_graph("ring:5")
    for arguments, words in (
        ((1, 5, 2, 1), r"v = 5: there are the agents 0\.\.4"),
        ((1, 0, 0, 1), "k = 0"),
        ((1, 0, 2, -1), "r = -1"),
    ):
        with pytest.raises(InputError, match=words):
            information_set(network, *arguments)


def test_no_agents_is_no_ball():
    assert np.diff(Balls.of(parse_graph("ring:5"), 2).within(-1).start).sum() == 0
