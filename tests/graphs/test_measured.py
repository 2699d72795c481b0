import dataclasses

import mpmath
import networkx as nx
import numpy as np
import pytest

from nearsight.graphs import Network, measured, network_growth, network_profile, parse_graph


@pytest.fixture
def calls(monkeypatch):
    """The radii for which a profile was really computed, with laziness on for small graphs."""
    computed = []

    def counted(network, radius=None, progress=None):
        computed.append(radius)
        return network_profile(network, radius, progress)

    monkeypatch.setattr(measured, "SMALL", 0)
    monkeypatch.setattr(measured, "network_profile", counted)
    return computed


def test_nothing_is_computed_before_it_is_asked_for(calls):
    growth = network_growth(parse_graph("grid:12x12"), radius=3)
    assert (growth.vertices, growth.edges, growth.max_degree) == (144, 264, 4)
    assert (growth.exact, growth.infinite, growth.source) == (True, False, "grid:12x12")
    assert calls == []
    assert growth.h(2) == 8
    assert growth.ball(3) == 25
    assert calls == [3]


def test_extension(calls):
    growth = network_growth(parse_graph("grid:12x12"), radius=3)
    expected = network_profile(growth.network)
    for q in range(40):
        assert growth.h(q) == (expected.h[q] if q < 23 else 0)
        assert growth.ball(q) == (expected.ball[q] if q < 23 else 144)
        assert growth.eta(q) == (expected.eta[q] if q < 23 else 0)
    assert calls == [3, 16, 68]
    assert growth.radius == 22
    assert growth.values() == list(expected.h)
    assert len(calls) == 3


def test_all_of_it(calls):
    growth = network_growth(parse_graph("grid:12x12"))
    assert growth.radius == 22
    assert calls == [None]
    assert growth.transform(1) == sum(growth.values())
    assert calls == [None]


def test_small_graphs_are_computed_once(monkeypatch):
    seen = []
    growth = network_growth(parse_graph("grid:8x8"), 2, lambda *call: seen.append(call))
    assert growth.h(1) == 4
    assert growth.radius == 14
    assert seen == [(1, 1)]


def test_transform():
    graph = nx.gnp_random_graph(60, 0.05, seed=4)
    growth = network_growth(Network.from_networkx(graph))
    values = growth.values()
    z = np.array([0.0, 0.1, 0.9, 1.0, 3.0])
    exact = [mpmath.fdot((mpmath.mpf(x) ** q, h) for q, h in enumerate(values)) for x in z]
    assert growth.transform(z) == pytest.approx([float(x) for x in exact], rel=1e-14)
    with mpmath.workdps(50):
        x = mpmath.mpf(1) / 3
        assert mpmath.almosteq(
            growth.transform(x), mpmath.fsum(h * x**q for q, h in enumerate(values))
        )


def test_a_single_vertex():
    growth = network_growth(parse_graph("path:1"))
    assert (growth.h(0), growth.h(1), growth.ball(5), growth.eta(1)) == (1, 0, 1, 0)
    assert (growth.radius, growth.max_degree, growth.transform(0.5)) == (0, 0, 1.0)


def test_immutable_and_checked():
    growth = network_growth(parse_graph("ring:5"))
    with pytest.raises(dataclasses.FrozenInstanceError):
        growth.first = 3
    with pytest.raises(ValueError, match="radius is at least 1, not 0"):
        network_growth(parse_graph("ring:5"), 0)
