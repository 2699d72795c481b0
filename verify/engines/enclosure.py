"""Boxes with rational corners, and enclosures of a function on them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

Function = Callable[..., Any]
Side = tuple[Fraction, Fraction]


@dataclass(frozen=True)
class Box:
    """A product of closed intervals with rational ends.

    Parameters
    ----------
    sides : tuple of (Fraction, Fraction)
    depth : int
        How often it has been halved.
    """

    sides: tuple[Side, ...]
    depth: int = 0

    def middle(self) -> tuple[Fraction, ...]:
        """Return the midpoint."""
        return tuple((a + b) / 2 for a, b in self.sides)

    def middle_balls(self) -> list[Any]:
        """Return the midpoint as balls."""
        return [ball(m) for m in self.middle()]

    def balls(self) -> list[Any]:
        """Return balls that contain the sides."""
        return [ball(a).union(ball(b)) for a, b in self.sides]

    def halves(self, steepness: Sequence[float] | None) -> tuple[Box, Box]:
        """Return the halves along the side over which the function may change most.

        Parameters
        ----------
        steepness : sequence of float or None
            Bounds on the derivatives; None takes the sides in turn.
        """
        widths = [float(b - a) for a, b in self.sides]
        if steepness is None:
            i = self.depth % len(widths)
        else:
            i = max(range(len(widths)), key=lambda j: widths[j] * steepness[j])
        a, b = self.sides[i]
        m = (a + b) / 2
        low, high = (
            Box((*self.sides[:i], side, *self.sides[i + 1 :]), self.depth + 1)
            for side in ((a, m), (m, b))
        )
        return low, high


def ball(x: Fraction) -> Any:
    """Return a ball around a rational number."""
    from flint import arb, fmpq

    return arb(fmpq(x.numerator, x.denominator))


def enclosure(
    function: Function, box: Box, middle: Any, mean_value: bool
) -> tuple[Any, list[float] | None]:
    """Return a ball that contains all values on a box, and bounds on the derivatives if known.

    Parameters
    ----------
    function : callable
    box : Box
    middle : arb
        The value at the midpoint.
    mean_value : bool
        Whether to use derivatives.
    """
    from flint import arb, arb_series

    balls = box.balls()
    whole = function(*balls)
    if whole > 0 or not mean_value:
        return whole, None
    linear, steep = middle, []
    for i, (m, x) in enumerate(zip(box.middle_balls(), balls, strict=True)):
        series = [arb_series([y, 1 if i == j else 0], prec=2) for j, y in enumerate(balls)]
        derivative = arb(arb_series(function(*series))[1])
        linear += derivative * (x - m)
        steep.append(float(derivative.abs_upper()))
    if not linear.is_finite():
        return whole, None
    if whole.is_finite() and whole.overlaps(linear):
        linear = whole.intersection(linear)
    return linear, steep


def certainly_negative(function: Function, box: Box) -> tuple[tuple[Fraction, ...], float]:
    """Return the simplest point of a box at which the function is certainly negative.

    The midpoint of the box must be such a point; the ends of the box, which may stand for an
    infinite value of a variable, are left out.
    """
    middle = box.middle()
    for largest in (1, 2, 4, 10, 100, 1000, 10**6):
        point = tuple(m.limit_denominator(largest) for m in middle)
        inside = all(a < p < b for p, (a, b) in zip(point, box.sides, strict=True))
        if inside:
            value = function(*(ball(p) for p in point))
            if value < 0:
                return point, float(value)
    return middle, float(function(*(ball(m) for m in middle)))
