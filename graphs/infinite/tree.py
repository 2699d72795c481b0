"""The infinite regular tree: no graph of the same degree grows faster."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arguments import check_degree, convert
from ..errors import InputError
from ..growth import Growth

NAME = "tree"
SYNTAX = "tree:DELTA"
DESCRIPTION = "the infinite tree in which every vertex has DELTA neighbours"


@dataclass(frozen=True)
class Tree(Growth):
    """Growth of the infinite D-regular tree, D the `degree`: for ``q >= 1``::

        h(q) = eta(q) = D (D - 1)^(q-1),   ball(q) = 1 + D ((D - 1)^q - 1)/(D - 2).

    The transform ``(1 + z)/(1 - (D - 1) z)`` diverges at ``z >= 1/(D - 1)``.

    Parameters
    ----------
    degree : int
        Neighbours of every vertex, at least 2.

    Raises
    ------
    InputError
        If the degree is less than 2: such a tree is finite.
    """

    degree: int

    def __post_init__(self) -> None:
        """Check the degree."""
        if self.degree < 2:
            raise InputError(f"{SYNTAX} needs DELTA >= 2, not {self.degree}")

    @property
    def max_degree(self) -> int:
        """The degree of every vertex."""
        return self.degree

    @property
    def source(self) -> str:
        """The specification, e.g. ``tree:3``."""
        return f"{NAME}:{self.degree}"

    @property
    def _overflow(self) -> int | None:
        # (D - 1)^q >= 2^q, and 2^1024 is beyond binary64
        return 1024 if self.degree > 2 else None

    def _h(self, q: int) -> int:
        return self.degree * _power(self.degree - 1, q - 1) if q else 1

    def _ball(self, q: int) -> int:
        if self.degree == 2:
            return 2 * q + 1
        return 1 + self.degree * (_power(self.degree - 1, q) - 1) // (self.degree - 2)

    def _eta(self, q: int) -> int:
        return self._h(q) if q else 0

    def _converges(self, z: Any) -> Any:
        if isinstance(z, np.ndarray):
            return self._gap(z) > 0
        return super()._converges((self.degree - 1) * z)

    def _transform(self, z: Any) -> Any:
        return (1 + z) / self._gap(z)

    def _gap(self, z: Any) -> Any:
        """Return ``1 - (D - 1) z`` without rounding the product first.

        The gap is what cancels next to the pole. In binary64 the factor `z` is split into two
        halves of 26 bits, whose products with ``D - 1`` are exact (up to ``D = 2^26``).
        """
        c = self.degree - 1
        if not isinstance(z, np.ndarray) or c == 1:
            return 1 - c * z
        t = 134217729.0 * z  # 2^27 + 1
        high = t - (t - z)
        # a huge z overflows the splitting; it lies beyond the pole in any case
        high = np.where(np.isfinite(high), high, z)
        return (1 - c * high) - c * (z - high)


def build(arguments: tuple[str, ...], max_degree: int | None) -> Tree:
    """Return the growth of the regular tree; see `nearsight.graphs.parse_growth`."""
    (degree,) = convert(arguments, (int,), SYNTAX)
    growth = Tree(degree)
    check_degree(growth, max_degree)
    return growth


def _power(base: int, exponent: int) -> int:
    """Return a power with exponent >= 0, which the types of Python do not know to be an int."""
    return int(base**exponent)
