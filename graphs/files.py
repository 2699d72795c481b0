"""Graph files, by suffix."""

from __future__ import annotations

import json
import re
from collections import Counter
from collections.abc import Callable
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .errors import InputError
from .network import Network

if TYPE_CHECKING:
    import networkx as nx

    AnyGraph = nx.Graph[Any]


def read_graph(path: str | Path, clean: bool = False) -> Network:
    """Read a graph from a file; attributes and weights are ignored.

    Parameters
    ----------
    path : str or Path
        With one of the suffixes in `SUFFIXES`: GraphML, GML, GEXF, edge list (two names a line,
        then weights, a dict or nothing), adjacency list (a name and its neighbours a line), JSON in
        node-link form, or Matrix Market (a square matrix with symmetric pattern: every stored entry
        is an edge). Text is UTF-8.
    clean : bool
        Drop directions, parallel edges and self-loops instead of rejecting them.

    Returns
    -------
    Network
        Named by the vertices' identifiers (labels, for GML; row numbers from 1, for a matrix).

    Raises
    ------
    InputError
        If the file is missing, of another kind, malformed or empty, or if its graph is directed
        or has parallel edges or self-loops.
    """
    path = Path(path)
    reader = READERS.get(path.suffix.lower())
    if reader is None:
        raise InputError(f"{path}: a graph file ends in one of {' '.join(SUFFIXES)}")
    if not path.is_file():
        raise InputError(f"{path}: no such file; a graph file or a family is accepted")
    try:
        graph = reader(path)
    except InputError:
        raise
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise InputError(f"{path}: not UTF-8; save it as UTF-8") from error
    except Exception as error:
        # the readers raise whatever malformed input happens to lead to
        reason = " ".join(str(error).split()) or type(error).__name__
        raise InputError(f"{path}: not a well-formed {path.suffix} file: {reason}") from error
    return Network.from_networkx(graph, clean=clean, source=str(path))


def _graphml(path: Path) -> AnyGraph:
    import networkx as nx

    return nx.read_graphml(path)


def _gexf(path: Path) -> AnyGraph:
    import networkx as nx

    return nx.read_gexf(path)


def _gml(path: Path) -> AnyGraph:
    """Read GML as a multigraph, so that parallel edges are counted rather than a syntax error."""
    import networkx as nx

    text = path.read_text(encoding="utf-8-sig")
    head, bracket, body = text.partition("[")
    before, node, after = body.partition("node")
    before = re.sub(r"\bmultigraph\s+\d+", "", before)
    text = f"{head}{bracket} multigraph 1 {before}{node}{after}"
    label = "label" if re.search(r"\blabel\b", after) else "id"
    graph: AnyGraph = nx.parse_gml(text, label=label)
    return graph


def _json(path: Path) -> AnyGraph:
    """Read node-link data; the edges are called `edges` by recent writers, `links` by others."""
    import networkx as nx

    data = json.loads(path.read_text(encoding="utf-8-sig"))
    if not isinstance(data, dict) or "nodes" not in data:
        raise ValueError('node-link data is an object with "nodes" and "edges" (or "links")')
    edges = "edges" if "edges" in data else "links"
    # as a multigraph parallel edges are kept, to be counted
    graph: AnyGraph = nx.node_link_graph({**data, "multigraph": True}, edges=edges)
    return graph


def _edgelist(path: Path) -> AnyGraph:
    """Read one edge a line; what follows the two names, weights or a dict, is ignored."""
    import networkx as nx

    graph: AnyGraph = nx.MultiGraph()
    for number, words in _lines(path):
        if "," in "".join(words[:2]) or not _is_data(words[2:]):
            # names with blanks, or separated by commas, would be read as other vertices
            raise InputError(
                f"{path}, line {number}: {' '.join(words)!r}: two names without blanks or commas, "
                f"then weights or nothing; for such names use .graphml or .json"
            )
        if len(words) < 2:
            raise ValueError(f"line {number} has one name, an edge has two")
        graph.add_edge(words[0], words[1])
    return graph


def _is_data(words: list[str]) -> bool:
    """Return whether words are numbers, or a dict (cut short by a # in it, perhaps)."""
    if words and words[0].startswith("{"):
        return True
    try:
        _ = [float(word) for word in words]
    except ValueError:
        return False
    return True


def _adjlist(path: Path) -> AnyGraph:
    """Read one vertex and its neighbours a line; an edge may be listed at one end or at both."""
    import networkx as nx

    graph: AnyGraph = nx.MultiGraph()
    listed: Counter[tuple[str, str]] = Counter()
    for _, (vertex, *neighbours) in _lines(path):
        graph.add_nodes_from([vertex, *neighbours])
        listed.update((vertex, other) for other in neighbours)
    for (a, b), count in listed.items():
        if b == a or (b, a) not in listed or (count, a) > (listed[b, a], b):
            graph.add_edges_from([(a, b)] * count)
    return graph


def _lines(path: Path) -> list[tuple[int, list[str]]]:
    """Return the numbered lines as words, without comments and blanks."""
    text = path.read_text(encoding="utf-8-sig").splitlines()
    words = ((i, line.partition("#")[0].split()) for i, line in enumerate(text, start=1))
    return [(i, line) for i, line in words if line]


def _mtx(path: Path) -> AnyGraph:
    """Read the pattern of a square matrix: undirected if symmetric, else directed."""
    import networkx as nx
    from scipy.io import mmread
    from scipy.sparse import coo_array

    matrix = coo_array(mmread(path, spmatrix=False))
    if matrix.shape[0] != matrix.shape[1]:
        raise ValueError(f"a graph needs a square matrix, not {matrix.shape[0]}x{matrix.shape[1]}")
    entries = Counter(zip((matrix.row + 1).tolist(), (matrix.col + 1).tolist(), strict=True))
    symmetric = all(entries[j, i] == count for (i, j), count in entries.items())
    graph: AnyGraph = nx.MultiGraph() if symmetric else nx.MultiDiGraph()
    graph.add_nodes_from(range(1, matrix.shape[0] + 1))
    for (i, j), count in entries.items():
        if i <= j or not symmetric:
            graph.add_edges_from([(i, j)] * count)
    return graph


READERS: dict[str, Callable[[Path], AnyGraph]] = {
    ".graphml": _graphml,
    ".gml": _gml,
    ".gexf": _gexf,
    ".edgelist": _edgelist,
    ".adjlist": _adjlist,
    ".json": _json,
    ".mtx": _mtx,
}
"""How each kind of file is read."""

SUFFIXES = tuple(READERS)
"""The kinds of file that are accepted."""
