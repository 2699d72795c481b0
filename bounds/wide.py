"""Double-double numbers with an exponent of their own.

A float holds 53 bits, and a power ``rho**k`` multiplies the rounding of ``rho``
by ``k``. Every float result of this package is therefore computed with `Wide`
numbers, 104 bits or more and no overflow or underflow on the way, and rounded once.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
Ints = npt.NDArray[np.int64]

_SPLITTER = 134217729.0  # 2**27 + 1, Veltkamp's constant for 53-bit mantissas
_ZERO_EXPONENT = -(2**40)  # a zero must not decide the alignment of a sum


def _two_sum(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """Return ``fl(a + b)`` and its exact error [Knuth, TAOCP 2, 4.2.2 Theorem B]."""
    s = a + b
    t = s - a
    return s, (a - (s - t)) + (b - t)


def _two_product(a: Floats, b: Floats) -> tuple[Floats, Floats]:
    """Return ``fl(a * b)`` and its exact error [Dekker 1971]; mantissas near 1 only."""
    p = a * b
    t = _SPLITTER * a
    a_high = t - (t - a)
    a_low = a - a_high
    t = _SPLITTER * b
    b_high = t - (t - b)
    b_low = b - b_high
    return p, ((a_high * b_high - p) + a_high * b_low + a_low * b_high) + a_low * b_low


def _scaled(x: Floats, shift: Ints) -> Floats:
    """Multiply by ``2**shift``; shifts beyond the range of a float give 0 or inf."""
    return np.asarray(np.ldexp(x, np.clip(shift, -3000, 3000).astype(np.int32)))


class Wide:
    """An array of numbers ``(high + low) * 2**exponent``, ``1/2 <= |high| < 1``.

    Supports ``+ - * /``, integer powers (arrays of exponents too), comparison and
    `sqrt`, elementwise with broadcasting. Each operation has a relative error of at
    most a few ``2**-104``; for a difference, relative to the operands, not to the result.
    Convert with ``Wide(float_or_array)`` and `to_float`.

    Parameters
    ----------
    value : float, int or array of them, or Wide
        Taken exactly (integers above ``2**53`` are split over both parts).
    """

    __slots__ = ("exponent", "high", "low")
    high: Floats
    low: Floats
    exponent: Ints
    __array_ufunc__ = None  # numpy must leave ``array * Wide`` to ``Wide.__rmul__``

    def __init__(self, value: Any) -> None:
        if isinstance(value, Wide):
            self.high, self.low, self.exponent = value.high, value.low, value.exponent
            return
        if isinstance(value, int | np.integer) and abs(int(value)) > 2**53:
            value = int(value)
            shift = max(0, value.bit_length() - 106)  # 106 bits are all that fit
            top = value >> shift
            head = float(top >> 53) * 2.0**53
            self._set(np.asarray(head), np.asarray(float(top - int(head))), np.asarray(shift))
            return
        high = np.asarray(value, dtype=np.float64)
        self._set(high, np.zeros_like(high), np.zeros(high.shape, np.int64))

    def _set(self, high: Floats, low: Floats, exponent: Ints) -> None:
        """Normalise ``(high + low) * 2**exponent`` into the three fields."""
        total = high + low
        with np.errstate(invalid="ignore"):
            error = low - (total - high)
        mantissa, shift = np.frexp(total)
        ordinary = np.isfinite(total) & (total != 0.0)
        self.high = np.asarray(mantissa)
        self.low = np.where(ordinary, _scaled(error, -shift.astype(np.int64)), 0.0)
        self.exponent = np.where(
            ordinary, exponent + shift, np.where(total == 0.0, _ZERO_EXPONENT, 0)
        )

    @classmethod
    def _make(cls, high: Floats, low: Floats, exponent: Ints) -> Wide:
        result = cls.__new__(cls)
        result._set(high, low, exponent)
        return result

    def to_float(self) -> Any:
        """Round once: a ``float`` for a scalar, else a float64 array."""
        with np.errstate(over="ignore", under="ignore"):
            rounded = _scaled(self.high, self.exponent)
        return float(rounded) if rounded.ndim == 0 else rounded

    def map(self, function: Callable[[Any], Any]) -> Wide:
        """Apply a function of one mpmath number to each element, at 130 bits.

        For what has no `Wide` form of its own, such as the sum of a series.
        """
        from mpmath import mp

        parts = np.broadcast_arrays(self.high, self.low, self.exponent)
        high, low = np.empty(parts[0].shape), np.empty(parts[0].shape)
        with mp.workprec(130):
            for i, (head, tail, exponent) in enumerate(zip(*(p.flat for p in parts), strict=True)):
                value = function(mp.ldexp(mp.mpf(float(head)) + float(tail), int(exponent)))
                high.flat[i] = float(value)
                low.flat[i] = float(value - high.flat[i]) if np.isfinite(high.flat[i]) else 0.0
        return Wide._make(high, low, np.zeros(high.shape, np.int64))

    def __add__(self, other: Any) -> Wide:
        other = Wide(other)
        top = np.maximum(self.exponent, other.exponent)
        left, right = self.exponent - top, other.exponent - top
        with np.errstate(invalid="ignore"):
            high, error = _two_sum(_scaled(self.high, left), _scaled(other.high, right))
            low = error + (_scaled(self.low, left) + _scaled(other.low, right))
        low = np.where(np.isfinite(high), low, 0.0)
        return Wide._make(high, low, top)

    def __mul__(self, other: Any) -> Wide:
        other = Wide(other)
        with np.errstate(invalid="ignore"):
            high, error = _two_product(self.high, other.high)
            low = error + (self.high * other.low + self.low * other.high)
        low = np.where(np.isfinite(high), low, 0.0)
        return Wide._make(high, low, self.exponent + other.exponent)

    def __truediv__(self, other: Any) -> Wide:
        other = Wide(other)
        with np.errstate(invalid="ignore", divide="ignore"):
            quotient = self.high / other.high
            product, error = _two_product(quotient, other.high)
            rest = ((self.high - product) - error) + (self.low - quotient * other.low)
            both = np.isfinite(quotient) & np.isfinite(other.high)
            low = np.where(both, rest / other.high, 0.0)
        return Wide._make(quotient, low, self.exponent - other.exponent)

    def sqrt(self) -> Wide:
        """Return the square root (nan below 0)."""
        odd = self.exponent & 1
        high, low = _scaled(self.high, odd), _scaled(self.low, odd)
        with np.errstate(invalid="ignore", divide="ignore"):
            root = np.sqrt(high)
            product, error = _two_product(root, root)
            low = np.where(high > 0.0, ((high - product) - error + low) / (2.0 * root), 0.0)
        low = np.where(np.isfinite(root), low, 0.0)
        return Wide._make(root, low, (self.exponent - odd) >> 1)

    def __pow__(self, n: Any) -> Wide:
        """Raise to integer powers ``n >= 0`` by repeated squaring."""
        counts = np.asarray(n, dtype=np.int64)
        if np.any(counts < 0):
            raise ValueError("a power of a Wide number takes an exponent >= 0")
        result, square = Wide(np.ones(counts.shape)), self
        for bit in range(int(counts.max(initial=0)).bit_length()):
            result = where((counts >> bit) & 1 == 1, result * square, result)
            square = square * square
        return result

    def __neg__(self) -> Wide:
        return Wide._make(-self.high, -self.low, self.exponent)

    def __sub__(self, other: Any) -> Wide:
        return self + (-Wide(other))

    def __rsub__(self, other: Any) -> Wide:
        return Wide(other) + (-self)

    def __rtruediv__(self, other: Any) -> Wide:
        return Wide(other) / self

    __radd__ = __add__
    __rmul__ = __mul__

    def _above(self, other: Any) -> Floats:
        """Return a float of the sign of ``self - other``, 0 for equal infinities."""
        other = Wide(other)
        same = (self.high == other.high) & (self.low == other.low)
        return np.where(same & (self.exponent == other.exponent), 0.0, (self - other).high)

    def __lt__(self, other: Any) -> npt.NDArray[np.bool_]:
        return np.asarray(self._above(other) < 0.0)

    def __le__(self, other: Any) -> npt.NDArray[np.bool_]:
        return np.asarray(self._above(other) <= 0.0)

    def __gt__(self, other: Any) -> npt.NDArray[np.bool_]:
        return np.asarray(self._above(other) > 0.0)

    def __ge__(self, other: Any) -> npt.NDArray[np.bool_]:
        return np.asarray(self._above(other) >= 0.0)

    def __repr__(self) -> str:
        return f"Wide({self.to_float()!r})"


def where(condition: Any, yes: Any, no: Any) -> Wide:
    """Choose elementwise; all three broadcast."""
    yes, no = Wide(yes), Wide(no)
    return Wide._make(
        np.where(condition, yes.high, no.high),
        np.where(condition, yes.low, no.low),
        np.where(condition, yes.exponent, no.exponent),
    )
