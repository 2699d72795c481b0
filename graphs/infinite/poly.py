"""Polynomial growth, h(q) <= C q^P, of which only the bound is known."""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ..arguments import convert, need_degree
from ..errors import InputError
from ..growth import Growth
from ..powers import power_ceiling, power_series, power_sum_ceiling

NAME = "poly"
SYNTAX = "poly:C,P"
DESCRIPTION = "any infinite graph with h(q) <= C q^P; needs --max-degree"
MAX_EXPONENT = 64


@dataclass(frozen=True)
class Poly(Growth):
    """Bounds from polynomial growth of the spheres: for ``q >= 1``::

        h(q) <= floor(C q^P),   ball(q) <= 1 + floor(C sum_{j=1}^q j^P),
        eta(q) <= Delta min(h(q), h(q - 1)),
        transform(z) <= 1 + C sum_{q >= 1} q^P z^q.

    Counts are integers, hence the floors; the transform is summed without them.

    Parameters
    ----------
    coefficient : Fraction
        C, at least 1: an infinite connected graph has a vertex at every distance.
    exponent : Fraction
        P, between 0 and 64.
    degree : int
        The largest degree, or an upper bound of it; at least 1.

    Raises
    ------
    InputError
        If a parameter is out of range.
    """

    coefficient: Fraction
    exponent: Fraction
    degree: int

    def __post_init__(self) -> None:
        """Check the parameters and make them exact."""
        object.__setattr__(self, "coefficient", Fraction(self.coefficient))
        object.__setattr__(self, "exponent", Fraction(self.exponent))
        if self.coefficient < 1:
            raise InputError(f"{SYNTAX} needs C >= 1, not {float(self.coefficient)}")
        if not 0 <= self.exponent <= MAX_EXPONENT:
            given = float(self.exponent)
            raise InputError(f"{SYNTAX} needs P between 0 and {MAX_EXPONENT}, not {given}")
        if self.degree < 1:
            raise InputError(f"--max-degree of {NAME} is at least 1, not {self.degree}")

    @property
    def exact(self) -> bool:
        """Whether all is known; here all are bounds."""
        return False

    @property
    def max_degree(self) -> int:
        """The degree that was given."""
        return self.degree

    @property
    def source(self) -> str:
        """The specification, e.g. ``poly:4,1``."""
        return f"{NAME}:{float(self.coefficient):g},{float(self.exponent):g}"

    def _h(self, q: int) -> int:
        return power_ceiling(q, self.coefficient, self.exponent) if q else 1

    def _ball(self, q: int) -> int:
        return 1 + (power_sum_ceiling(q, self.coefficient, self.exponent) if q else 0)

    def _eta(self, q: int) -> int:
        return self.degree * min(self._h(q), self._h(q - 1)) if q else 0

    def _transform(self, z: Any) -> Any:
        c = self.coefficient
        return 1 + c.numerator * power_series(z, self.exponent) / c.denominator


def build(arguments: tuple[str, ...], max_degree: int | None) -> Poly:
    """Return the polynomial growth; see `nearsight.graphs.parse_growth`."""
    coefficient, exponent = convert(arguments, (Fraction, Fraction), SYNTAX)
    return Poly(coefficient, exponent, need_degree(NAME, max_degree))
