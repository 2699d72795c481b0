"""A growth typed in: h(0), h(1), ... as listed, and nothing beyond."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..arguments import convert, need_degree
from ..errors import InputError
from ..evaluate import horner
from ..growth import Growth

NAME = "values"
SYNTAX = "values:1,H1,H2,..."
DESCRIPTION = "h(0), h(1), ... as listed, 0 beyond the last; needs --max-degree"


@dataclass(frozen=True)
class Values(Growth):
    """Bounds from the list ``h(0), ..., h(L)`` of a graph of diameter L::

        ball(q) <= h(0) + ... + h(q),   eta(q) <= Delta min(h(q), h(q - 1)).

    Parameters
    ----------
    listed : tuple of int
        ``h(0), ..., h(L)``: the first 1, the others at least 1, ``h(1) <= degree``.
    degree : int
        The largest degree, or an upper bound of it.

    Raises
    ------
    InputError
        If the list does not begin with 1, has an entry below 1, or contradicts the degree.
    """

    listed: tuple[int, ...]
    degree: int

    def __post_init__(self) -> None:
        """Check the list."""
        if not self.listed or self.listed[0] != 1:
            raise InputError(f"{SYNTAX} begins with h(0) = 1, not {self.listed[:1]}")
        low = [v for v in self.listed if v < 1]
        if low:
            raise InputError(f"{SYNTAX} needs positive integers, not {low[0]}")
        if self.degree < 0:
            raise InputError(f"--max-degree of {NAME} is at least 0, not {self.degree}")
        if len(self.listed) > 1 and self.listed[1] > self.degree:
            raise InputError(
                f"--max-degree {self.degree} contradicts {self.source}: "
                f"h(1) = {self.listed[1]} neighbours need at least that degree"
            )

    @property
    def exact(self) -> bool:
        """Whether all is known; here `ball` and `eta` are bounds."""
        return False

    @property
    def infinite(self) -> bool:
        """Whether there are infinitely many vertices; here the list ends."""
        return False

    @property
    def max_degree(self) -> int:
        """The degree that was given."""
        return self.degree

    @property
    def source(self) -> str:
        """The specification, e.g. ``values:1,4,8,12``."""
        return f"{NAME}:{','.join(map(str, self.listed))}"

    @property
    def radius(self) -> int:
        """The last distance listed."""
        return len(self.listed) - 1

    def _h(self, q: int) -> int:
        return self.listed[q] if q < len(self.listed) else 0

    def _ball(self, q: int) -> int:
        return sum(self.listed[: q + 1])

    def _eta(self, q: int) -> int:
        return self.degree * min(self._h(q), self._h(q - 1)) if q else 0

    def _converges(self, z: Any) -> Any:
        return np.full(z.shape, True) if isinstance(z, np.ndarray) else True

    def _transform(self, z: Any) -> Any:
        return horner(list(self.listed), z)


def build(arguments: tuple[str, ...], max_degree: int | None) -> Values:
    """Return the growth as listed; see `nearsight.graphs.parse_growth`."""
    listed = convert(arguments, (int,) * max(len(arguments), 1), SYNTAX)
    return Values(listed, need_degree(NAME, max_degree))
