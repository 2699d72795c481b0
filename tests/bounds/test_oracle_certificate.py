"""No instance found by brute force is worse for LPC than the certificates promise."""

from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from nearsight.bounds import bounds_for
from nearsight.graphs import Network, network_growth, parse_graph

from . import oracles as oracle
from .oracle_support import GUARD, certificates, graph, network, setting

IEEE = Path(__file__).resolve().parents[2] / "examples" / "data" / "ieee118.graphml"
SMALL = [
    "ring:6",
    "ring:9",
    "path:5",
    "star:5",
    "complete:4",
    "cubic tree",
    "grid:3x3",
    "ring-of-blocks:4x2",
]
PAIRS = [(2, 1), (2, 2), (3, 1), (3, 2), (4, 2), (4, 3), (5, 3)]
COUPLINGS = [(0.02, 0.05), (0.3, 0.02), (0.1, 0.3), (1.0, 1.0), (3.0, 0.5)]  # a and x


@pytest.mark.parametrize("spec", SMALL)
def test_no_instance_exceeds_a_certificate(spec):
    rng = np.random.default_rng(SMALL.index(spec))
    small, growth = graph(spec), network_growth(network(spec))
    a, x = np.repeat(COUPLINGS, 2, axis=0).T
    l_f = np.tile([1.0, 8.0], len(COUPLINGS))
    k, r = np.array(PAIRS).T
    promised = certificates(growth, a[:, None], x[:, None], k, r, l_f[:, None])
    highest = 0.0
    for i, style in [(i, style) for i in range(len(a)) for style in oracle.STYLES]:
        instance = oracle.random_instance(
            rng,
            small,
            H=int(rng.integers(3, 6)),
            a=a[i],
            a_S=x[i] / small.degree,
            l_f=l_f[i],
            n=int(rng.choice([1, 1, 2])) if small.vertices <= 6 else 1,
            style=style,
            shifts=bool(rng.integers(2)),
        )
        for j, (kk, rr) in enumerate(PAIRS):
            least = min(promised[kind][i, j] for kind in promised)
            if np.isfinite(least):
                worst, _ = instance.worst(kk, rr)
                assert worst <= least * GUARD, (a[i], x[i], l_f[i], style, kk, rr)
                highest = max(highest, worst / least)
    assert highest > 0.1  # the certificate is within reach: a smaller one would be caught


@pytest.mark.parametrize(("k", "r"), [(2, 1), (3, 1)])
@pytest.mark.parametrize("style", ["difference", "tilted"])
def test_power_grid(k, r, style):
    growth, grid = network_growth(parse_graph(IEEE)), oracle.Graph.of(parse_graph(IEEE))
    a, x = 0.1, 0.1
    instance = oracle.random_instance(
        np.random.default_rng(3), grid, 2, a, x / grid.degree, style=style
    )
    worst, _ = instance.worst(k, r)
    for bound in bounds_for("nearsight:sharp-cr"):
        result = bound.evaluate(setting(growth, a, x, k, r))
        assert result.guarantee
        assert worst <= result.values["cr_minus_one"] * GUARD
    assert worst > 1e-5


@st.composite
def cases(draw):
    vertices = draw(st.integers(2, 7))
    parents = draw(st.lists(st.integers(0, 6), min_size=vertices - 1, max_size=vertices - 1))
    extra = draw(st.lists(st.integers(0, 20), max_size=6))
    strength = st.floats(-2.5, 0.5).map(lambda e: 10.0**e)
    return {
        "graph": oracle.connected_graph(vertices, parents, extra),
        "H": draw(st.integers(1, 5)),
        "k": draw(st.integers(2, 5)),
        "r": draw(st.integers(1, 4)),
        "a": draw(strength),
        "x": draw(strength),
        "l_f": draw(st.sampled_from([1.0, 1.5, 30.0])),
        "style": draw(st.sampled_from(oracle.STYLES)),
        "seed": draw(st.integers(0, 2**32 - 1)),
    }


def as_network(found):
    lattice = nx.Graph()
    lattice.add_nodes_from(range(found.vertices))
    lattice.add_edges_from(found.edges.tolist())
    return Network.from_networkx(lattice)


@settings(max_examples=60)
@given(case=cases())
def test_random_networks(case):
    small, k, r, a, x = (case[name] for name in ("graph", "k", "r", "a", "x"))
    rng = np.random.default_rng(case["seed"])
    instance = oracle.random_instance(
        rng,
        small,
        case["H"],
        a,
        x / small.degree,
        l_f=case["l_f"],
        n=int(rng.integers(1, 3)),
        style=case["style"],
        shifts=bool(rng.integers(2)),
    )
    worst, _ = instance.worst(k, r)
    growth = network_growth(as_network(small))
    for kind, promised in certificates(growth, a, x, k, r, case["l_f"]).items():
        assert worst <= promised * GUARD + 1e-24, kind


@pytest.mark.parametrize("spec", ["ring:6", "path:5", "star:5", "ring-of-blocks:4x2"])
def test_the_repaired_corollary_holds_where_it_says_something(spec):
    rng = np.random.default_rng(5)
    small, growth = graph(spec), network_growth(network(spec))
    numbers = 0
    for a, x, k, r in [
        (1e-3, 1e-3, 3, 2),
        (1e-3, 1e-2, 3, 3),
        (1e-2, 1e-3, 4, 2),
        (0.02, 0.02, 4, 3),
    ]:
        at = setting(growth, a, x, k, r, 2.0)
        for bound in bounds_for("coro:CR-LPC"):
            if bound.tier != "repaired":
                continue
            result = bound.evaluate(at)
            promised = result.values["cr_minus_one"]
            if promised is None:
                continue
            assert result.guarantee
            numbers += 1
            for style in oracle.STYLES:
                instance = oracle.random_instance(
                    rng, small, 4, a, x / small.degree, l_f=2.0, style=style
                )
                assert instance.worst(k, r)[0] <= promised * GUARD
    assert numbers >= 3
