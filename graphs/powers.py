"""Sums of powers q^p, for integer and for real p >= 0, in any arithmetic."""

from __future__ import annotations

from fractions import Fraction
from functools import cache
from math import comb
from typing import Any

import numpy as np

from .evaluate import horner

DIRECT = 200  # terms of a sum of real powers that are added up one by one


@cache
def eulerian(p: int) -> tuple[int, ...]:
    """Eulerian numbers ``A(p, 0), ..., A(p, max(p - 1, 0))``.

    ``A(p, m)`` counts the orders of ``1..p`` with m ascents. They turn powers into geometric
    series, ``sum_{q >= 1} q^p z^q = z sum_m A(p, m) z^m / (1 - z)^(p + 1)``, and into binomials,
    ``q^p = sum_m A(p, m) C(q + m, p)`` (Worpitzky) for ``p >= 1``.
    """
    if p < 2:
        return (1,)
    last = (0, *eulerian(p - 1), 0)
    return tuple((m + 1) * last[m + 1] + (p - m) * last[m] for m in range(p))


def power_ceiling(q: int, c: Fraction, p: Fraction) -> int:
    """Return ``floor(c q^p)`` for ``q >= 1``; a value within 2^-64 below an integer counts as it.

    Integer exponents are computed exactly.
    """
    if p.denominator == 1:
        return int(c * q**p.numerator)
    from mpmath import mp, mpf, workprec

    with workprec(96 + _bits(q, c, p + 1)):
        value = mpf(q) ** (mpf(p.numerator) / p.denominator) * c.numerator / c.denominator
        return int(mp.floor(value + mpf(2) ** -64))


def power_sum_ceiling(q: int, c: Fraction, p: Fraction) -> int:
    """Return ``floor(c sum_{j=1}^q j^p)`` for ``q >= 1``, or for real `p` a little more.

    Integer exponents are exact, by Worpitzky's identity. For others the first terms are summed,
    and the rest is at most an integral: a convex ``x^p`` is below its mean over
    ``[j - 1/2, j + 1/2]``, and the trapezoids of a concave one lie below it. So the cost does not
    grow with `q`.
    """
    if p == 0:
        return int(c * q)
    if p.denominator == 1:
        n = p.numerator
        return int(c * sum(a * comb(q + 1 + m, n + 1) for m, a in enumerate(eulerian(n))))
    from mpmath import fsum, mp, mpf, workprec

    with workprec(96 + _bits(q, c, p + 1)):
        e = mpf(p.numerator) / p.denominator
        total = fsum(mpf(j) ** e for j in range(1, min(q, DIRECT) + 1))
        if q > DIRECT and p > 1:
            total += _antiderivative(q + mpf(0.5), e) - _antiderivative(DIRECT + mpf(0.5), e)
        elif q > DIRECT:
            total += _antiderivative(mpf(q), e) - _antiderivative(mpf(DIRECT + 1), e)
            total += (mpf(q) ** e + mpf(DIRECT + 1) ** e) / 2
        return int(mp.floor(total * c.numerator / c.denominator + mpf(2) ** -64))


def _antiderivative(x: Any, e: Any) -> Any:
    """Return the integral of ``x^e`` from 0."""
    return x ** (e + 1) / (e + 1)


def power_series(z: Any, p: Fraction) -> Any:
    """``sum_{q >= 1} q^p z^q`` for ``0 <= z < 1``, the polylogarithm of order ``-p``.

    Parameters
    ----------
    z : ndarray of float64, or a number of any arithmetic
        Below 1.
    p : Fraction
        The exponent, at least 0.

    Returns
    -------
    Same kind as `z`
        A closed form for integer `p`. For other `p`, floats are correctly rounded up to an ulp,
        mpmath and SymPy use their own polylogarithm, and any other arithmetic (intervals, balls)
        gets an upper bound: up to 0.99 it exceeds the sum by less than 2^-100 of it, beyond by a
        few per cent (Hoelder's inequality between the closed forms of the next integers).
    """
    if p.denominator == 1:
        n = p.numerator
        # intervals shrink if the closed form is summed with positive terms only
        return z * horner(list(eulerian(n)), z) / (1 - z) ** (n + 1)
    if isinstance(z, np.ndarray):
        return np.array([_float_series(float(x), p) for x in z.flat]).reshape(z.shape)
    if hasattr(z, "free_symbols"):
        import sympy

        return sympy.polylog(-sympy.Rational(p.numerator, p.denominator), z)
    from mpmath import mpf, polylog, workprec

    if isinstance(z, mpf):
        with workprec(_polylog_precision(z, p)):
            value = polylog(-mpf(p.numerator) / p.denominator, z).real
        return +value
    if 100 * z < 99:
        return _series(z, p)
    below = int(p)
    share = (z * 0 + 1) * (p - below).numerator / (p - below).denominator
    low, high = (power_series(z, Fraction(n)) for n in (below, below + 1))
    return low ** (1 - share) * high**share


def _float_series(z: float, p: Fraction) -> float:
    """Return the sum at one float, computed in mpmath and rounded once."""
    from mpmath import mpf, workprec

    if z != z or z == 0:
        return z
    with workprec(64):
        return float(power_series(mpf(z), p))


def _polylog_precision(z: Any, p: Fraction) -> int:
    """Working precision: near 1 the polylogarithm adds terms as large as ``(1 - z)^(-p-1)``."""
    from mpmath import log, mp

    return int(mp.prec + 32 + 2 * abs(log(1 - z, 2)) + 4 * p)


def _series(z: Any, p: Fraction) -> Any:
    """Sum term by term, and close with a geometric series that bounds the tail from above."""
    one = z * 0 + 1
    exponent = one * p.numerator / p.denominator
    total, q = z, 1
    while True:
        term = (one * (q + 1)) ** exponent * z ** (q + 1)
        # from here on a term is at most `ratio` times the one before it
        ratio = (one * (q + 2) / (q + 1)) ** exponent * z
        if ratio < 1:
            tail = term / (1 - ratio)
            if tail * 2**100 <= total:
                return total + tail
        total, q = total + term, q + 1


def _bits(q: int, c: Fraction, p: Fraction) -> int:
    """Return an upper bound of the binary digits before the point of ``c q^p``."""
    return q.bit_length() * (int(p) + 1) + c.numerator.bit_length()
