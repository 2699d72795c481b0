from pathlib import Path

import networkx as nx
import numpy as np
import pytest

from nearsight.graphs import InputError, modules, network_profile, parse_graph
from nearsight.graphs.profile import Profile

DATA = Path(__file__).resolve().parents[2] / "examples" / "data"
SAME_AS = {
    "ieee118": nx.read_graphml(DATA / "ieee118.graphml"),
    "path:7": nx.path_graph(7),
    "path:1": nx.path_graph(1),
    "ring:3": nx.cycle_graph(3),
    "ring:8": nx.cycle_graph(8),
    "grid:3x5": nx.grid_2d_graph(3, 5),
    "grid:1x4": nx.path_graph(4),
    "torus:3x4": nx.grid_2d_graph(3, 4, periodic=True),
    "tree:2x3": nx.balanced_tree(2, 3),
    "tree:1x4": nx.path_graph(5),
    "tree:3x0": nx.empty_graph(1),
    "complete:6": nx.complete_graph(6),
    "complete:1": nx.empty_graph(1),
    "star:6": nx.star_graph(5),
    "hypercube:4": nx.hypercube_graph(4),
    "hypercube:0": nx.empty_graph(1),
    "ring-of-blocks:5x1": nx.cycle_graph(5),
    "ring-of-blocks:5x3": nx.lexicographic_product(nx.cycle_graph(5), nx.empty_graph(3)),
    "regular:5x6": nx.complete_graph(6),
    "erdos-renyi:5x1": nx.complete_graph(5),
    "erdos-renyi:5x0": nx.empty_graph(5),
    "barabasi-albert:6x5": nx.star_graph(5),
    "geometric:5x2": nx.complete_graph(5),
    "geometric:5x0": nx.empty_graph(5),
}
RANDOM = ["regular:3x20", "erdos-renyi:30x0.2", "barabasi-albert:20x2", "geometric:30x0.3"]


@pytest.mark.parametrize("spec", SAME_AS)
def test_isomorphic_to_networkx(spec):
    network = parse_graph(spec)
    assert network.source == spec
    assert nx.is_isomorphic(network.to_networkx(), SAME_AS[spec])


def test_the_buses_keep_their_numbers():
    assert parse_graph("ieee118").names == tuple(map(str, range(1, 119)))
    with pytest.raises(InputError, match=r"ieee118 takes 0 argument\(s\), not 1"):
        parse_graph("ieee118:3")


def test_every_family_is_tested():
    assert {spec.partition(":")[0] for spec in SAME_AS} == set(modules("families"))


@pytest.mark.parametrize("family", modules("families").values(), ids=lambda f: f.NAME)
def test_every_family_describes_itself(family):
    assert family.SYNTAX.partition(":")[0] == family.NAME
    assert family.DESCRIPTION
    assert family.SYNTAX.count("x") - family.NAME.count("x") + 1 >= len(family.PARAMETERS)


@pytest.mark.parametrize(
    "spec", ["ring:9", "torus:4x5", "complete:5", "hypercube:3", "ring-of-blocks:4x2"]
)
def test_transitive_families_are(spec):
    network = parse_graph(spec)
    assert network.transitive
    distances = dict(nx.all_pairs_shortest_path_length(network.to_networkx()))
    spheres = {tuple(np.bincount(list(d.values())).tolist()) for d in distances.values()}
    assert len(spheres) == 1


@pytest.mark.parametrize("spec", RANDOM)
def test_random_families_obey_the_seed(spec):
    assert modules("families")[spec.partition(":")[0]].RANDOM
    one, again, other = (parse_graph(spec, seed=s) for s in (1, 1, 2))
    assert np.array_equal(one.indices, again.indices)
    assert not np.array_equal(one.indices, other.indices)


def test_geometric_joins_points_within_the_radius():
    points = np.random.default_rng(7).random((40, 2))
    apart = np.linalg.norm(points[:, None] - points[None], axis=2)
    network = parse_graph("geometric:40x0.25", seed=7)
    for v in range(40):
        near = np.flatnonzero((apart[v] <= 0.25) & (np.arange(40) != v))
        assert np.array_equal(network.neighbours(v), near)


def test_regular_and_barabasi_albert_degrees():
    assert set(parse_graph("regular:4x50", seed=3).degrees.tolist()) == {4}
    assert parse_graph("barabasi-albert:50x3", seed=3).edges == 3 * (50 - 3)


def test_large_deterministic_families():
    # 10^5 vertices: built and profiled without a loop over them
    assert network_profile(parse_graph("torus:300x400"), 2) == Profile(
        (1, 4, 8), (1, 5, 13), (0, 4, 12), False
    )
    assert network_profile(parse_graph("star:100000")).h == (1, 99_999, 99_998)


@pytest.mark.parametrize(
    ("spec", "message"),
    [
        ("path:0", "path:N needs N >= 1, not 0"),
        ("ring:2", "ring:N needs N >= 3, not 2"),
        ("grid:0x3", "grid:AxB needs A, B >= 1, not 0x3"),
        ("torus:2x9", "torus:AxB needs A, B >= 3, not 2x9"),
        ("tree:0x2", "tree:BxDEPTH needs B >= 1 and DEPTH >= 0, not 0x2"),
        ("tree:2x-1", "tree:BxDEPTH needs B >= 1 and DEPTH >= 0, not 2x-1"),
        ("complete:0", "complete:N needs N >= 1, not 0"),
        ("star:0", "star:N needs N >= 1, not 0"),
        ("hypercube:-1", "hypercube:D needs D >= 0, not -1"),
        ("ring-of-blocks:2x2", "ring-of-blocks:NxD needs N >= 3 and D >= 1, not 2x2"),
        ("ring-of-blocks:3x0", "ring-of-blocks:NxD needs N >= 3 and D >= 1, not 3x0"),
        ("regular:3x3", "regular:DxN needs 0 <= D < N, not 3x3"),
        ("regular:3x5", r"regular:DxN needs D\*N even, not 3x5"),
        ("erdos-renyi:5x1.5", "erdos-renyi:NxP needs N >= 1 and 0 <= P <= 1, not 5x1.5"),
        ("barabasi-albert:5x5", "barabasi-albert:NxM needs 1 <= M < N, not 5x5"),
        ("geometric:5x-1", "geometric:NxRADIUS needs N >= 1 and RADIUS >= 0, not 5x-1"),
        ("ring", r"ring:N takes 1 argument\(s\), not none"),
        ("ring:3x4", r"ring:N takes 1 argument\(s\), not 2 argument\(s\): 3, 4"),
        ("ring:3.5", "ring:N needs an integer, not '3.5'"),
        ("erdos-renyi:5xnan", "needs a finite number, not 'nan'"),
        ("erdos-renyi:5x1/2", "needs a finite number, not '1/2'"),
    ],
)
def test_bad_arguments(spec, message):
    with pytest.raises(InputError, match=f"--graph '{spec}".replace("*", r"\*")) as caught:
        parse_graph(spec)
    assert caught.match(message)


@pytest.mark.parametrize(
    "spec",
    [
        "path:60000000",
        "ring:60000000",
        "grid:6000x6000",
        "torus:6000x6000",
        "tree:2x999999999",
        "tree:1x60000000",
        "complete:20000",
        "star:60000000",
        "hypercube:99",
        "ring-of-blocks:3x9999",
        "regular:4x60000000",
        "erdos-renyi:60000x0.9",
        "barabasi-albert:20000000x3",
        "geometric:50000x1",
    ],
)
def test_too_large_is_refused_at_once(spec):
    with pytest.raises(InputError, match="takes up to 50,000,000 vertices and edges"):
        parse_graph(spec)
