"""The topology of the IEEE 118-bus power network."""

from __future__ import annotations

from importlib.resources import as_file, files

import numpy as np
from numpy.typing import NDArray

from ..files import read_graph

NAME = "ieee118"
SYNTAX = "ieee118"
DESCRIPTION = "the 118 buses and 179 lines of the IEEE power network test case"
RANDOM = False
TRANSITIVE = False
PARAMETERS = ()
NAMES = tuple(str(bus) for bus in range(1, 119))


def build(*, seed: int = 0) -> tuple[int, NDArray[np.int64]]:
    """Edges between buses that a line or a transformer joins; vertex i is bus ``i + 1``.

    References
    ----------
    Power Systems Test Case Archive, University of Washington (R. Christie, 1993).
    """
    with as_file(files("nearsight.graphs") / "data" / "ieee118.graphml") as path:
        network = read_graph(path)
    rows = np.repeat(np.arange(network.vertices), network.degrees)
    once = rows < network.indices
    return network.vertices, np.stack([rows[once], network.indices[once]], axis=1)
