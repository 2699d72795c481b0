"""One formula, many arithmetics.

A closed form of this package is written once, with ``+ - * /`` and the functions
below. It then runs on floats and float arrays, on SymPy expressions, on mpmath
numbers (`mpmath.mp` and the intervals of `mpmath.iv`) and on python-flint's `arb`.
"""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from . import wide
from .wide import Wide

Number = Any
"""A float, an array, a `Wide`, a SymPy expression, an mpmath number or an `arb`."""


def kind_of(*numbers: Number) -> str:
    """Name the arithmetic the numbers belong to.

    Returns
    -------
    str
        ``"wide"``, ``"sympy"``, ``"mpmath"``, ``"interval"``, ``"arb"``, or
        ``"float"`` when all are Python or NumPy numbers.
    """
    for x in numbers:
        root = type(x).__module__.partition(".")[0]
        if isinstance(x, Wide):
            return "wide"
        if root == "sympy":
            return "sympy"
        if root == "mpmath":
            return "interval" if type(x).__name__ == "ivmpf" else "mpmath"
        if root == "flint":
            return "arb"
    return "float"


def sqrt(x: Number) -> Number:
    """Return the square root in the arithmetic of ``x``."""
    match kind_of(x):
        case "wide" | "arb":
            return x.sqrt()
        case "sympy":
            import sympy

            return sympy.sqrt(x)
        case "interval":
            from mpmath import iv

            return iv.sqrt(x)
        case "mpmath":
            return x.context.sqrt(x)
    return np.sqrt(x)


def asinh(x: Number) -> Number:
    """Return the inverse hyperbolic sine (not for `mpmath.iv`, which has none)."""
    match kind_of(x):
        case "wide":
            raise TypeError("asinh is not offered for Wide numbers")
        case "arb":
            return x.asinh()
        case "sympy":
            import sympy

            return sympy.asinh(x)
        case "mpmath":
            return x.context.asinh(x)
        case "interval":
            raise TypeError("mpmath.iv has no asinh; use python-flint's arb")
    return np.arcsinh(x)


def maximum(x: Number, y: Number) -> Number:
    """Return the larger of two numbers, elementwise for arrays."""
    match kind_of(x, y):
        case "wide":
            return wide.where(Wide(x) >= Wide(y), x, y)
        case "sympy":
            import sympy

            return sympy.Max(x, y)
        case "interval":
            from mpmath import iv

            x, y = iv.convert(x), iv.convert(y)
            return iv.mpf([max(x.a, y.a).a, max(x.b, y.b).b])
        case "arb":
            return x.max(y) if kind_of(x) == "arb" else y.max(x)
        case "mpmath":
            return max(x, y)
    return np.maximum(x, y)


def minimum(x: Number, y: Number) -> Number:
    """Return the smaller of two numbers, elementwise for arrays."""
    return -maximum(-x, -y)


def select(condition: Any, yes: Number, no: Number) -> Number:
    """Choose by a condition on counts (or on floats): arrays elementwise, else one branch.

    A condition on SymPy symbols that is not decided gives a `sympy.Piecewise`; one on
    intervals that is not certain counts as False.
    """
    if kind_of(condition) == "sympy" and not condition.is_Atom:
        import sympy

        return sympy.Piecewise((yes, condition), (no, True))
    if np.ndim(condition) == 0:
        return yes if bool(condition) else no
    if kind_of(yes, no) == "wide":
        return wide.where(condition, yes, no)
    return np.where(condition, yes, no)


def approximate(x: Number) -> Any:
    """Return a number of any arithmetic as a float (or float array), for searching.

    Raises
    ------
    TypeError
        If it holds a free symbol: where something is searched for, symbols will not do.
    """
    match kind_of(x):
        case "wide":
            return x.to_float()
        case "interval":
            return float(x.mid)
        case "float":
            return x
    return float(x)


def upper_end(x: Number) -> float:
    """Return a float not below the upper end of an mpmath interval."""
    nearest = float(x.b)
    return nearest if x.b <= nearest else float(np.nextafter(nearest, np.inf))


def one_plus(excess: Any, *, up: bool) -> Any:
    """Return ``1 + excess`` for floats, rounded up (for an upper bound) or down, not to nearest."""
    total = 1 + excess
    with np.errstate(invalid="ignore"):  # infinite and undefined values stay what they are
        part = total - 1
        error = (1 - (total - part)) + (excess - part)  # exact [Knuth's two-sum]
    wrong = error > 0 if up else error < 0
    return np.where(wrong, np.nextafter(total, np.inf if up else 1.0), total)[()]


def is_zero(x: Number) -> Any:
    """Say where a nonnegative number is 0 (False where that is not certain)."""
    match kind_of(x):
        case "wide":
            return x <= 0.0
        case "sympy":
            return bool(x.is_zero)
        case "float":
            return np.equal(x, 0.0)
    return bool(x == 0)


def power(x: Number, n: Any) -> Number:
    """Return ``x**n`` for counts ``n >= 0`` (an int, or an array of them)."""
    if kind_of(x) in ("float", "wide"):
        return x**n
    return x ** int(n)


def _bits(n: Any) -> Iterator[Any]:
    """Yield the binary digits of the counts ``n``, most significant first."""
    counts = np.asarray(n, dtype=np.int64)
    if np.any(counts < 0):
        raise ValueError("a sum takes a number of terms >= 0")
    for bit in reversed(range(int(counts.max(initial=0)).bit_length())):
        yield ((counts >> bit) & 1) == 1


def geometric_sum(p: Number, q: Number, n: Any) -> Number:
    """Return ``sum_{j=0}^{n-1} p**j * q**(n-1-j)``; with ``q = 1`` the geometric sum.

    By doubling, ``T_{2m} = T_m (p**m + q**m)`` and ``T_{m+1} = p T_m + q**m``: only
    sums and products of nonnegative numbers, so nothing cancels where ``p`` is near
    ``q`` (or near 1), and ``log2(n)`` steps.
    """
    zero, one = 0 * (p + q), 1 + 0 * (p + q)  # of the arithmetic and shape of p and q
    total, p_m, q_m = zero, one, one
    for digit in _bits(n):
        total, p_m, q_m = total * (p_m + q_m), p_m * p_m, q_m * q_m
        total = select(digit, p * total + q_m, total)
        p_m, q_m = select(digit, p * p_m, p_m), select(digit, q * q_m, q_m)
    return total
