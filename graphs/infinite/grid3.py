"""The infinite cubic grid Z^3."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..arguments import check_degree, convert
from ..growth import Growth

NAME = "grid3"
SYNTAX = "grid3"
DESCRIPTION = "the infinite cubic grid"


@dataclass(frozen=True)
class Grid3(Growth):
    """Growth of Z^3 with its six neighbours: for ``q >= 1``::

        h(q) = 4 q^2 + 2,   ball(q) = (2 q + 1)(2 q^2 + 2 q + 3)/3,   eta(q) = 12 q^2 - 12 q + 6.

    `eta`: of the sphere, 6 vertices are approached by one edge (on an axis), ``12 (q - 1)`` by two
    (in a coordinate plane) and ``4 (q - 1)(q - 2)`` by three.
    """

    @property
    def max_degree(self) -> int:
        """Six neighbours."""
        return 6

    @property
    def source(self) -> str:
        """The specification, ``grid3``."""
        return NAME

    def _h(self, q: int) -> int:
        return 4 * q * q + 2 if q else 1

    def _ball(self, q: int) -> int:
        return (2 * q + 1) * (2 * q * q + 2 * q + 3) // 3

    def _eta(self, q: int) -> int:
        return 12 * q * (q - 1) + 6 if q else 0

    def _transform(self, z: Any) -> Any:
        # The distance is a sum over the coordinates, so this is the transform of the line, cubed.
        return ((1 + z) / (1 - z)) ** 3


def build(arguments: tuple[str, ...], max_degree: int | None) -> Grid3:
    """Return the growth of the cubic grid; see `nearsight.graphs.parse_growth`."""
    convert(arguments, (), SYNTAX)
    growth = Grid3()
    check_degree(growth, max_degree)
    return growth
