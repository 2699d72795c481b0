"""The infinite ring of blocks, on which the lower bounds live."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from ..arguments import check_degree, convert
from ..errors import InputError
from ..growth import Growth

NAME = "ring-of-blocks"
SYNTAX = "ring-of-blocks:D"
DESCRIPTION = "infinitely many blocks of D vertices, neighbouring blocks completely joined"


@dataclass(frozen=True)
class RingOfBlocks(Growth):
    """Growth of infinitely many blocks in a row, each vertex joined to both blocks beside its own.

    With ``D = size`` the degree is ``2 D`` and::

        h(1) = 2 D,   h(2) = 3 D - 1,         h(q) = 2 D        (q >= 3)
        eta(1) = 2 D, eta(2) = 4 D^2 - 2 D,   eta(q) = 2 D^2    (q >= 3)

    At distance 2 lie the two blocks next but one, approached through D edges each vertex, and the
    other ``D - 1`` vertices of the own block, approached through all ``2 D``.

    Parameters
    ----------
    size : int
        Vertices of a block, D, at least 1 (then it is the line).

    Raises
    ------
    InputError
        If the size is less than 1.
    """

    size: int

    def __post_init__(self) -> None:
        """Check the size."""
        if self.size < 1:
            raise InputError(f"{SYNTAX} needs D >= 1, not {self.size}")

    @property
    def max_degree(self) -> int:
        """Two blocks of neighbours."""
        return 2 * self.size

    @property
    def source(self) -> str:
        """The specification, e.g. ``ring-of-blocks:2``."""
        return f"{NAME}:{self.size}"

    def _h(self, q: int) -> int:
        if q == 0:
            return 1
        return 3 * self.size - 1 if q == 2 else 2 * self.size

    def _ball(self, q: int) -> int:
        # the own block is complete from distance 2 on
        return 2 * self.size * q + (1 if q < 2 else self.size)

    def _eta(self, q: int) -> int:
        if q < 3:
            return (0, 2 * self.size, 4 * self.size**2 - 2 * self.size)[q]
        return 2 * self.size**2

    def _transform(self, z: Any) -> Any:
        return 1 + (self.size - 1) * z**2 + 2 * self.size * z / (1 - z)


def build(arguments: tuple[str, ...], max_degree: int | None) -> RingOfBlocks:
    """Return the growth of the ring of blocks; see `nearsight.graphs.parse_growth`."""
    (size,) = convert(arguments, (int,), SYNTAX)
    growth = RingOfBlocks(size)
    check_degree(growth, max_degree)
    return growth
