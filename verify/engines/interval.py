"""Proof over a whole range, by branch and bound in interval arithmetic."""

from __future__ import annotations

import heapq
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, replace
from fractions import Fraction
from typing import Any

from ...graphs import InputError
from ..check import Check
from ..evidence import Evidence, Level
from .enclosure import Box, certainly_negative, enclosure
from .exact import plain

Number = int | Fraction


@dataclass(frozen=True)
class Boxes(Check):
    """``function > 0`` on a product of closed intervals.

    The function is evaluated on balls that contain a box; a box with a positive enclosure is
    done, any other is halved. When none is left, the function is positive everywhere. A midpoint
    at which it is certainly negative refutes.

    What the claim has to bring into this form: an unbounded variable is substituted, ``a =
    y/(1-y)`` with y in [0, 1], and the difference of the two sides multiplied by the power of
    ``1 - y`` that keeps it finite and positive at ``y = 1``; where both sides are equal on the
    boundary (``a = 0``, say), the difference is divided by its zero there, by hand. A function
    that comes near 0 in the closed box without being negative is not decided: `run` raises.

    Parameters
    ----------
    function : callable
        Of one ball (flint ``arb``) a variable, in the order of `ranges`. Constants are integers or
        ``flint.fmpq``, not floats that are rounded. May use the closed forms of `bounds`. A ball
        that touches the end of a range may exceed it by rounding, so no ``sqrt(y)`` at ``y = 0``:
        substitute ``y = s**2``.
    ranges : dict
        Name -> two numbers, the closed range of a variable.
    reason : str
        The substitution and the factors, in words.
    nudge : int or Fraction
        ``function - nudge > 0`` is false: just above the smallest value of the function
        (``details["smallest_value"]`` of the evidence tells it). It makes a mutant.
    false : tuple of callable
        Further functions that are not positive everywhere, such as that of the claim with a
        constant nudged in the wrong direction past the true threshold.
    back : callable, optional
        ``back(**point) -> dict``: the numbers of the claim at a rational point of the box. They
        go into the instance of a refutation.
    mean_value : bool
        Also enclose by ``f(m) + sum_i d_i f(X) (X_i - m_i)``, with derivatives from power series:
        fewer boxes where the function is smooth. It is then called with ``arb_series`` too
        (``+ - * /``, ``sqrt``, ``exp``, no ``max``).
    quick, full : int
        How many boxes at most, at each level.
    bits : int
        Precision.
    """

    function: Callable[..., Any]
    ranges: Mapping[str, tuple[Number, Number]]
    reason: str
    nudge: Number = 0
    false: tuple[Callable[..., Any], ...] = ()
    back: Callable[..., Mapping[str, Any]] | None = None
    mean_value: bool = False
    quick: int = 20_000
    full: int = 400_000
    bits: int = 80

    def __post_init__(self) -> None:
        if not self.ranges or any(low >= high for low, high in self.ranges.values()):
            raise InputError("boxes need variables, each with a range low < high")
        if self.nudge < 0:
            raise InputError(f"nudge = {self.nudge}: it is subtracted, so it must be >= 0")

    def run(self, level: Level) -> Evidence:
        """Halve boxes until all are positive or one midpoint is negative.

        Raises
        ------
        RuntimeError
            If boxes are left over when their number reaches `quick` or `full`.
        """
        from flint import ctx

        with ctx.workprec(self.bits):
            return self._search(self.quick if level == "quick" else self.full)

    def mutants(self) -> Iterator[Check]:
        """Return the search for the function minus its nudge, and for the false functions."""
        plainly = replace(self, nudge=0, false=(), reason=f"mutant of: {self.reason}")
        if self.nudge:
            function, nudge = self.function, _exact(self.nudge)
            yield replace(plainly, function=lambda *balls: function(*balls) - nudge)
        for function in self.false:
            yield replace(plainly, function=function)

    def _search(self, limit: int) -> Evidence:
        start = Box(tuple((Fraction(a), Fraction(b)) for a, b in self.ranges.values()))
        todo: list[tuple[float, int, Box]] = [(0.0, 0, start)]
        seen, pushed, deepest, smallest, lowest = 0, 1, 0, float("inf"), float("inf")
        while todo:
            _, _, box = heapq.heappop(todo)  # the box with the smallest value at its midpoint
            seen += 1
            deepest = max(deepest, box.depth)
            middle = self.function(*box.middle_balls())
            if middle < 0:
                return self._refutation(box, seen)
            value = float(middle) if middle.is_finite() else 0.0
            smallest = min(smallest, value) if middle.is_finite() else smallest
            whole, steep = enclosure(self.function, box, middle, self.mean_value)
            if whole > 0:
                lowest = min(lowest, float(whole.lower()))
                continue
            if seen + len(todo) >= limit:
                raise RuntimeError(self._undecided(box, limit, whole))
            for half in box.halves(steep):
                heapq.heappush(todo, (value, pushed, half))
                pushed += 1
        return Evidence(
            "proved",
            "interval",
            f"{self.reason}: positive on {seen} boxes that cover the whole range, in interval "
            f"arithmetic; at least {lowest:.3g} everywhere.",
            details={
                "boxes": seen,
                "deepest": deepest,
                "bits": self.bits,
                "lower_bound": lowest,
                "smallest_value": smallest,
                "ranges": {name: plain(list(ends)) for name, ends in self.ranges.items()},
            },
        )

    def _undecided(self, box: Box, limit: int, whole: Any) -> str:
        where = ", ".join(
            f"{name} in [{float(a):.6g}, {float(b):.6g}]"
            for name, (a, b) in zip(self.ranges, box.sides, strict=True)
        )
        return f"not decided with {limit} boxes: {whole} for {where} ({self.reason})"

    def _refutation(self, box: Box, seen: int) -> Evidence:
        """Return the simplest rational point of the box that is certainly negative."""
        point, value = certainly_negative(self.function, box)
        named = dict(zip(self.ranges, point, strict=True))
        instance = {**named, **(self.back(**named) if self.back else {})}
        return Evidence(
            "refuted",
            "interval",
            f"{self.reason}: negative at one point, in interval arithmetic.",
            plain(instance),
            measured=value,
            bound=0.0,
            details={"boxes": seen, "bits": self.bits},
        )


def _exact(value: Number) -> Any:
    from flint import fmpq

    return fmpq(value.numerator, value.denominator)
