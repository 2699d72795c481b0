"""Entries of the inverse in the picture of the ring of blocks, in extended precision."""

import mpmath
import networkx as nx
import pytest

from nearsight.figures import picture_named
from nearsight.figures.pictures._rings import ring_of
from nearsight.graphs import parse_graph

GRAPHS = ["ring-of-blocks:7x3", "ring:8", "grid:3x4", "erdos-renyi:12x0.15", "star:6"]


def _compute(graph, **changes):
    picture = picture_named("ring-of-blocks")
    typed = {"graph": parse_graph(graph, 2), "l_S": 0.3, **changes}
    subject = picture.subject.with_typed(typed, picture.takes)
    return picture.compute(subject, print), subject


@pytest.mark.parametrize("graph", GRAPHS)
def test_entries_are_those_of_the_inverse_and_lie_between_the_bounds(graph):
    table, subject = _compute(graph)
    whole = nx.convert_node_labels_to_integers(subject.network.to_networkx())
    ell = mpmath.mpf(0.3) / 2
    with mpmath.workdps(40):
        laplacian = mpmath.matrix(nx.laplacian_matrix(whole).todense().tolist())
        inverse = (mpmath.eye(len(whole)) + ell * laplacian) ** -1
    v = subject.centre
    hops = nx.single_source_shortest_path_length(whole, v)
    for row in table.where(kind="agent").records():
        exact = float(inverse[row["agent"], v]) if row["agent"] in hops else 0.0
        assert row["entry"] == pytest.approx(exact, rel=1e-12)
        assert row["distance"] == hops.get(row["agent"])
    for row in table.where(kind="decay").records():
        mine = [float(inverse[u, v]) for u, d in hops.items() if d == row["distance"]]
        assert (row["smallest"], row["largest"]) == pytest.approx((min(mine), max(mine)), rel=1e-12)
        assert row["shortest"] <= row["smallest"] <= row["largest"] <= row["upper"]
        every = [
            mpmath.fprod([ell ** row["distance"], *(1 / (1 + ell * whole.degree[w]) for w in path)])
            for u, d in hops.items()
            if d == row["distance"]
            for path in nx.all_shortest_paths(whole, v, u)
        ]
        if len(every) == len(mine):  # one path to each
            assert row["shortest"] == pytest.approx(float(min(every)), rel=1e-12)


def test_the_stated_lower_bound_as_printed_exceeds_entries():
    picture = picture_named("fig:G_exp_decay_lower")
    table, d, ell = picture.compute(picture.subject, print), 2, 0.1
    rows = [row for row in table.where(kind="decay").records() if row["printed"] is not None]
    assert [row["distance"] for row in rows] == [3, 4, 5, 6, 7, 8]
    for row in rows:
        kappa, weight = row["distance"], d * ell / (2 * d * ell + 1)
        printed = kappa / (d**2 * (2 * d * ell + 1)) * weight**kappa
        assert row["printed"] == pytest.approx(printed, rel=1e-12)
        assert row["printed"] > row["largest"]


@pytest.mark.parametrize(("graph", "sizes"), [("ring-of-blocks:5x2", (2, 5)), ("ring:6", (1, 6))])
def test_rings_are_recognised(graph, sizes):
    ring = ring_of(parse_graph(graph))
    assert (ring.d, ring.blocks) == sizes


@pytest.mark.parametrize("graph", ["grid:3x3", "torus:4x5", "path:1", "complete:6", "hypercube:4"])
def test_other_networks_are_not(graph):
    assert ring_of(parse_graph(graph)) is None


def test_without_couplings_nothing_but_the_agent_itself_moves():
    table, _ = _compute("ring:8", l_S=0.0)
    assert table.where(kind="decay").values("largest") == [1.0, 0.0, 0.0, 0.0, 0.0]
