"""The infinite line Z, the limit of long paths and rings."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..arguments import check_degree, convert
from ..growth import Growth

NAME = "line"
SYNTAX = "line"
DESCRIPTION = "the infinite line"


@dataclass(frozen=True)
class Line(Growth):
    """Growth of Z: ``h(q) = 2``, ``ball(q) = 2 q + 1``, ``eta(q) = 2`` for ``q >= 1``."""

    @property
    def max_degree(self) -> int:
        """Two neighbours."""
        return 2

    @property
    def source(self) -> str:
        """The specification, ``line``."""
        return NAME

    def _h(self, q: int) -> int:
        return 2 if q else 1

    def _ball(self, q: int) -> int:
        return 2 * q + 1

    def _eta(self, q: int) -> int:
        return 2 if q else 0

    def _transform(self, z: Any) -> Any:
        return (1 + z) / (1 - z)


def build(arguments: tuple[str, ...], max_degree: int | None) -> Line:
    """Return the growth of the line; see `nearsight.graphs.parse_growth`."""
    convert(arguments, (), SYNTAX)
    growth = Line()
    check_degree(growth, max_degree)
    return growth
