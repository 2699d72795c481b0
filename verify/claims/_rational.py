"""Small quadratic problems in rational arithmetic, and closed forms at rational points."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ...graphs import InputError


@dataclass(frozen=True)
class Pair:
    """A convex, ``strength``-smooth quadratic cost of two numbers.

    Its Hessian is ``[[xx, xy], [xy, yy]]``; construction checks that it lies between 0 and
    ``strength``.

    Parameters
    ----------
    x, y : hashable
        Names of the two variables.
    strength, xx, xy, yy : Fraction
    """

    x: Hashable
    y: Hashable
    strength: Fraction
    xx: Fraction
    xy: Fraction
    yy: Fraction

    def __post_init__(self) -> None:
        above = (self.strength - self.xx, self.strength - self.yy)
        below = (self.xx, self.yy)
        inside = all(p >= 0 and q >= 0 and p * q >= self.xy**2 for p, q in (below, above))
        if not inside:
            raise InputError(f"{self}: the Hessian is not between 0 and {self.strength}")


def difference(x: Hashable, y: Hashable, strength: Fraction) -> Pair:
    """Return ``(l/4)(x - y)^2``, whose Hessian has eigenvalues 0 and ``l = strength``."""
    half = strength / 2
    return Pair(x, y, strength, half, -half, half)


def tilted(x: Hashable, y: Hashable, strength: Fraction, p: Fraction, q: Fraction) -> Pair:
    """Return ``(l/2)(p x - q y)^2``, ``p^2 + q^2 <= 1``."""
    return Pair(x, y, strength, strength * p * p, -strength * p * q, strength * q * q)


def response(
    free: Sequence[Hashable], pairs: Sequence[Pair], moved: Hashable, mu: Fraction = Fraction(1)
) -> dict[Hashable, Fraction]:
    """Return how the minimiser of ``sum (mu/2) x_i^2 + sum pairs`` moves with one fixed number.

    Parameters
    ----------
    free : sequence
        Names of the free variables; all others are fixed.
    pairs : sequence of Pair
    moved : hashable
        The fixed variable that is moved by 1.
    mu : Fraction
        Of the node costs.

    Returns
    -------
    dict
        Name -> derivative, ``-M^{-1} C``, by Gaussian elimination in fractions.
    """
    row = {name: i for i, name in enumerate(free)}
    M = [[mu if i == j else Fraction(0) for j in range(len(free))] for i in range(len(free))]
    right = [Fraction(0)] * len(free)
    for pair in pairs:
        ends = ((pair.x, pair.y, pair.xx), (pair.y, pair.x, pair.yy))
        for mine, other, bend in ends:
            if mine not in row:
                continue
            M[row[mine]][row[mine]] += bend
            if other in row:
                M[row[mine]][row[other]] += pair.xy
            elif other == moved:
                right[row[mine]] -= pair.xy
    return dict(zip(free, solve(M, right), strict=True))


def solve(M: Sequence[Sequence[Fraction]], right: Sequence[Fraction]) -> list[Fraction]:
    """Return ``M^{-1} right`` for a positive definite M: elimination without pivoting."""
    rows = [[*row, b] for row, b in zip(M, right, strict=True)]
    size = len(rows)
    for i in range(size):
        head = rows[i][i]
        rows[i] = [x / head for x in rows[i]]
        for j in range(size):
            if j != i and rows[j][i]:
                rows[j] = [x - rows[j][i] * y for x, y in zip(rows[j], rows[i], strict=True)]
    return [row[-1] for row in rows]


def exact(value: Any) -> Fraction:
    """Return a rational SymPy number as a Fraction; raise `InputError` if it is none."""
    import sympy

    found = sympy.nsimplify(sympy.simplify(value))
    if not found.is_Rational:
        raise InputError(f"{value} is not rational")
    return Fraction(int(found.p), int(found.q))


def rational(value: Fraction) -> Any:
    """Return a Fraction as a SymPy number, for the closed forms of `bounds`."""
    import sympy

    return sympy.Rational(value.numerator, value.denominator)
