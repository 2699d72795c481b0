"""Where agents stand: apart, the same every time, paths as lines."""

import numpy as np
import pytest

from nearsight.figures.pictures._places import part, places
from nearsight.graphs import parse_graph


@pytest.mark.parametrize(
    "graph", ["grid:4x4", "erdos-renyi:30x0.03", "star:12", "ring:9", "path:2"]
)
def test_agents_stand_apart_in_a_strip_of_width_one(graph):
    network = parse_graph(graph, 1)
    whole = part(network, range(network.vertices))
    assert whole.number_of_edges() == network.edges
    found = places(whole)
    assert found == places(part(network, range(network.vertices)))
    at = np.array([found[u] for u in range(network.vertices)])
    apart = np.linalg.norm(at[:, None] - at[None], axis=2) + 9 * np.eye(len(at))
    assert apart.min() > 0.2 / len(at)
    assert at.min() >= 0
    assert at[:, 0].max() == 1


def test_a_path_is_a_line_in_its_order():
    found = places(part(parse_graph("path:8"), range(8)))
    assert [y for _, y in found.values()] == [0.0] * 8
    assert np.allclose(np.diff([found[u][0] for u in range(8)]), 1 / 7, atol=0.02)
