"""The profile of a graph against two other ways to get all distances, in one run.

Prints the time of `network_profile` and, as ratios to it, that of NetworkX (one breadth-first
search a vertex, in Python) and SciPy (`csgraph.shortest_path`, unweighted). The others yield the
distances alone, from which the spheres are counted here; the boundary counts they would still
lack. Run with ``python benchmarks/graphs_profile.py [SPEC ...]``.
"""

import os
import sys
import time

THREADS = {"OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1", "MKL_NUM_THREADS": "1"}
os.environ.update(THREADS)  # before NumPy loads its linear algebra

import networkx as nx
import numpy as np
from scipy.sparse import csr_array
from scipy.sparse.csgraph import shortest_path

from nearsight.graphs import Network, network_profile, parse_graph

SPECS = ["grid:50x50", "regular:3x4000", "barabasi-albert:4000x3", "geometric:4000x0.03"]


def by_profile(network: Network) -> list[int]:
    """h(0), h(1), ... from the project's own search."""
    return list(network_profile(network).h)


def by_networkx(network: Network) -> list[int]:
    """The same from one search a vertex."""
    graph = nx.convert_node_labels_to_integers(network.to_networkx())
    spheres = np.zeros(network.vertices, dtype=np.int64)
    for v in graph:
        lengths = nx.single_source_shortest_path_length(graph, v)
        counts = np.bincount(np.fromiter(lengths.values(), dtype=np.int64))
        spheres[: len(counts)] = np.maximum(spheres[: len(counts)], counts)
    return [int(s) for s in spheres if s]


def by_scipy(network: Network) -> list[int]:
    """The same from the dense matrix of all distances."""
    n = network.vertices
    ones = np.ones(len(network.indices))
    matrix = csr_array((ones, network.indices, network.indptr.astype(np.int32)), shape=(n, n))
    distances = shortest_path(matrix, directed=False, unweighted=True)
    spheres = np.zeros(n, dtype=np.int64)
    for row in distances:
        counts = np.bincount(row[np.isfinite(row)].astype(np.int64))
        spheres[: len(counts)] = np.maximum(spheres[: len(counts)], counts)
    return [int(s) for s in spheres if s]


def main(specs: list[str]) -> None:
    """Time all three on every graph, and check that they agree."""
    print("one thread:", ", ".join(f"{name}={value}" for name, value in THREADS.items()))
    print(f"{'graph':28} {'profile':>10} {'networkx':>10} {'scipy':>10}")
    for spec in specs:
        network = parse_graph(spec, seed=1)
        times, results = [], []
        for method in (by_profile, by_networkx, by_scipy):
            start = time.perf_counter()
            results.append(method(network))
            times.append(time.perf_counter() - start)
        if not results[0] == results[1] == results[2]:
            raise SystemExit(f"{spec}: the three disagree")
        ratios = " ".join(f"{t / times[0]:9.1f}x" for t in times[1:])
        print(f"{spec:28} {times[0]:9.3f}s {ratios}")


if __name__ == "__main__":
    main(sys.argv[1:] or SPECS)
