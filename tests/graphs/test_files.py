import json
from pathlib import Path

import networkx as nx
import numpy as np
import pytest
from scipy.io import mmwrite
from scipy.sparse import coo_array

from nearsight.graphs import SUFFIXES, InputError, read_graph

GRAPH = nx.Graph([("a", "b"), ("b", "c"), ("c", "a"), ("c", "d"), ("e", "f")])
DATA = Path(__file__).resolve().parents[2] / "examples" / "data"


def write(graph, path):
    match path.suffix:
        case ".graphml":
            nx.write_graphml(graph, path)
        case ".gml":
            nx.write_gml(graph, path)
        case ".gexf":
            nx.write_gexf(graph, path)
        case ".edgelist":
            nx.write_edgelist(graph, path)
        case ".adjlist":
            nx.write_adjlist(graph, path)
        case ".json":
            path.write_text(json.dumps(nx.node_link_data(graph, edges="edges")))
        case ".mtx":
            dense = nx.to_numpy_array(graph)
            symmetry = "symmetric" if (dense == dense.T).all() else "general"
            mmwrite(path, coo_array(dense), symmetry=symmetry)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_round_trip(suffix, tmp_path):
    path = tmp_path / f"graph{suffix}"
    write(GRAPH, path)
    network = read_graph(path)
    expected = nx.relabel_nodes(GRAPH, dict(zip("abcdef", "123456", strict=True)))
    assert network.source == str(path)
    found = network.to_networkx()
    assert nx.utils.graphs_equal(found, expected if suffix == ".mtx" else GRAPH)


@pytest.mark.parametrize("suffix", [s for s in SUFFIXES if s not in (".edgelist", ".adjlist")])
def test_directed_is_rejected_or_cleaned(suffix, tmp_path):
    path = tmp_path / f"graph{suffix}"
    write(nx.DiGraph([("a", "b"), ("b", "c"), ("c", "b")]), path)
    with pytest.raises(InputError, match=r"directed \(3 arcs, the first"):
        read_graph(path)
    assert read_graph(path, clean=True).edges == 2


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_self_loop_is_rejected_or_cleaned(suffix, tmp_path):
    path = tmp_path / f"graph{suffix}"
    write(nx.Graph([("a", "b"), ("b", "b")]), path)
    with pytest.raises(InputError, match=r"1 self-loop\(s\), the first at [b2]"):
        read_graph(path)
    assert read_graph(path, clean=True).edges == 1


PARALLEL = {
    ".edgelist": "a b\nb c\nb a\n",
    ".adjlist": "a b b\nb c\n",
    ".gml": 'graph [ node [ id 0 label "a" ] node [ id 1 label "b" ] node [ id 2 label "c" ]'
    " edge [ source 0 target 1 ] edge [ source 1 target 0 ] edge [ source 1 target 2 ] ]",
    ".json": '{"nodes": [{"id": "a"}, {"id": "b"}, {"id": "c"}], "links": [{"source": "a",'
    ' "target": "b"}, {"source": "b", "target": "a"}, {"source": "b", "target": "c"}]}',
    ".mtx": "%%MatrixMarket matrix coordinate pattern symmetric\n3 3 3\n2 1\n2 1\n3 2\n",
}


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_parallel_edges_are_rejected_or_cleaned(suffix, tmp_path):
    path = tmp_path / f"graph{suffix}"
    if suffix in PARALLEL:
        path.write_text(PARALLEL[suffix])
    else:
        write(nx.MultiGraph([("a", "b"), ("b", "a"), ("b", "c")]), path)
    with pytest.raises(InputError, match=r"1 parallel edge\(s\), the first between [a1] and [b2]"):
        read_graph(path)
    assert read_graph(path, clean=True).edges == 2


def test_adjacency_may_be_listed_at_both_ends(tmp_path):
    path = tmp_path / "a.adjlist"
    path.write_text("# comment\na b c\nb a\n\nc a\nd\n")
    network = read_graph(path)
    assert (network.names, network.edges) == (("a", "b", "c", "d"), 2)


def test_edge_data_and_comments_are_ignored(tmp_path):
    path = tmp_path / "a.edgelist"
    path.write_text("# from to weight\na b 2.5\nb c {'weight': 1} # last\n")
    assert read_graph(path).edges == 2


DATA_OF_EDGES = [
    "",
    " 1",
    " -2.5e3 4",
    " {}",
    " {'w': 1, 'name': 'a, b'}",
    " {'colour': '#fff'} # red",
]


@pytest.mark.parametrize("data", DATA_OF_EDGES)
def test_weights_and_dicts_may_follow_an_edge(data, tmp_path):
    path = tmp_path / "a.edgelist"
    path.write_text(f"# all\na b{data}\n")
    assert read_graph(path).names == ("a", "b")


@pytest.mark.parametrize(
    "line", ["bus 1,bus 2", "a b c d", "a, b", "a,b", "(0, 0) (0, 1)", "1 2 x"]
)
def test_names_that_an_edge_list_cannot_hold_are_refused(line, tmp_path):
    path = tmp_path / "sp.edgelist"
    path.write_text(f"a b\n{line}\n")
    with pytest.raises(InputError) as caught:
        read_graph(path)
    assert str(caught.value) == (
        f"{path}, line 2: {line!r}: two names without blanks or commas, then weights or nothing; "
        "for such names use .graphml or .json"
    )


@pytest.mark.parametrize("suffix", [".edgelist", ".adjlist", ".json", ".gml"])
def test_other_encodings_are_named(suffix, tmp_path):
    path = tmp_path / f"a{suffix}"
    path.write_bytes("Zürich Genf\n".encode("latin-1"))
    with pytest.raises(InputError, match=r"not UTF-8; save it as UTF-8$"):
        read_graph(path)


def test_matrix_diagonal_and_dense(tmp_path):
    laplacian = nx.laplacian_matrix(GRAPH)
    mmwrite(tmp_path / "l.mtx", laplacian, symmetry="symmetric")
    with pytest.raises(InputError, match=r"6 self-loop\(s\), the first at 1"):
        read_graph(tmp_path / "l.mtx")
    assert read_graph(tmp_path / "l.mtx", clean=True).edges == 5
    mmwrite(tmp_path / "d.mtx", np.array([[0.0, 1.0], [1.0, 0.0]]))
    assert read_graph(tmp_path / "d.mtx").edges == 1


def test_gml_without_labels_uses_the_numbers(tmp_path):
    (tmp_path / "a.gml").write_text(
        "graph [ multigraph 0 node [ id 3 ] node [ id 5 ] edge [ source 3 target 5 ] ]"
    )
    assert read_graph(tmp_path / "a.gml").names == ("3", "5")


@pytest.mark.parametrize("suffix", [s for s in SUFFIXES if s not in (".edgelist", ".adjlist")])
def test_malformed_files_are_named(suffix, tmp_path):
    path = tmp_path / f"graph{suffix}"
    path.write_text("not a graph [ <")
    with pytest.raises(InputError, match=f"graph{suffix}: not a well-formed {suffix} file") as e:
        read_graph(path)
    assert "\n" not in str(e.value)


@pytest.mark.parametrize("suffix", SUFFIXES)
def test_empty_files_are_named(suffix, tmp_path):
    path = tmp_path / f"graph{suffix}"
    path.write_text("")
    with pytest.raises(InputError, match=f"graph{suffix}: (not a well-formed|the graph has no ve)"):
        read_graph(path)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("a.edgelist", "a b\nc\n", "line 2 has one name, an edge has two"),
        ("a.json", "[1, 2]", 'node-link data is an object with "nodes" and "edges"'),
        ("a.json", "{", "not a well-formed .json file"),
        ("a.json", '{"nodes": [], "links": []}', "no vertices"),
        (
            "a.mtx",
            "%%MatrixMarket matrix coordinate pattern general\n2 3 1\n1 2\n",
            "a graph needs a square matrix, not 2x3",
        ),
        ("a.txt", "a b", r"a graph file ends in one of \.graphml \.gml"),
    ],
)
def test_other_messages(name, text, message, tmp_path):
    (tmp_path / name).write_text(text)
    with pytest.raises(InputError, match=message):
        read_graph(tmp_path / name)


def test_missing_file_and_folder(tmp_path):
    for name in ("none.gml", "folder.gml"):
        (tmp_path / "folder.gml").mkdir(exist_ok=True)
        with pytest.raises(InputError, match=f"{name}: no such file"):
            read_graph(tmp_path / name)


def test_unreadable_file(tmp_path, monkeypatch):
    path = tmp_path / "a.edgelist"
    path.write_text("a b")

    def refuse(*_args, **_kwargs):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "read_text", refuse)
    with pytest.raises(InputError, match=r"a\.edgelist: cannot be read: Permission denied"):
        read_graph(path)


def test_ieee118():
    network = read_graph(DATA / "ieee118.graphml")
    assert (network.vertices, network.edges, network.max_degree) == (118, 179, 9)
    assert network.names == tuple(map(str, range(1, 119)))
    graph = network.to_networkx()
    assert nx.is_connected(graph)
    assert nx.diameter(graph) == 14
    # bus 49 has the most lines, bus 10 hangs on bus 9 alone
    assert max(graph.degree(), key=lambda pair: pair[1]) == ("49", 9)
    assert list(graph["10"]) == ["9"]


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("g.edgelist", "a b\nb c\n"),
        ("g.adjlist", "a b\nb c\n"),
        (
            "g.json",
            '{"nodes": [{"id": "a"}, {"id": "b"}], "edges": [{"source": "a", "target": "b"}]}',
        ),
    ],
)
def test_a_byte_order_mark_is_no_part_of_a_name(name, text, tmp_path):
    path = tmp_path / name
    path.write_bytes(b"\xef\xbb\xbf" + text.encode())
    assert read_graph(path).names[:2] == ("a", "b")
