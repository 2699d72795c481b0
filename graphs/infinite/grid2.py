"""The infinite square grid Z^2, the limit of large grids and tori."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..arguments import check_degree, convert
from ..growth import Growth

NAME = "grid2"
SYNTAX = "grid2"
DESCRIPTION = "the infinite square grid"


@dataclass(frozen=True)
class Grid2(Growth):
    """Growth of Z^2 with its four neighbours: for ``q >= 1``::

        h(q) = 4 q,   ball(q) = 2 q^2 + 2 q + 1,   eta(q) = 8 q - 4.

    `eta`: the 4 vertices on the axes are approached by one edge, the other ``4 (q - 1)`` by two.
    """

    @property
    def max_degree(self) -> int:
        """Four neighbours."""
        return 4

    @property
    def source(self) -> str:
        """The specification, ``grid2``."""
        return NAME

    def _h(self, q: int) -> int:
        return 4 * q if q else 1

    def _ball(self, q: int) -> int:
        return 2 * q * (q + 1) + 1

    def _eta(self, q: int) -> int:
        return 8 * q - 4 if q else 0

    def _transform(self, z: Any) -> Any:
        # The distance is a sum over the coordinates, so this is the transform of the line, squared.
        return ((1 + z) / (1 - z)) ** 2


def build(arguments: tuple[str, ...], max_degree: int | None) -> Grid2:
    """Return the growth of the square grid; see `nearsight.graphs.parse_growth`."""
    convert(arguments, (), SYNTAX)
    growth = Grid2()
    check_degree(growth, max_degree)
    return growth
