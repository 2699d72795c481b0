"""Evaluation in several arithmetics: exact for one integer, binary64 for arrays, any other."""

from __future__ import annotations

import operator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

if TYPE_CHECKING:
    from collections.abc import Callable

Floats = NDArray[np.float64]
Integers = NDArray[np.integer[Any]]


def horner(coefficients: list[int], z: Any) -> Any:
    """Return ``sum_i coefficients[i] z^i`` in the arithmetic of `z`.

    No term is negative here, so there is no cancellation.
    """
    if isinstance(z, np.ndarray):
        terms = [to_float(c) for c in coefficients]
        total: Any = np.full(z.shape, terms[-1])
        for c in reversed(terms[:-1]):
            total *= z
            total += c
        return total
    total = z * 0 + coefficients[-1]
    for c in reversed(coefficients[:-1]):
        total = total * z + c
    return total


def to_float(value: int) -> float:
    """Return the nearest binary64 number, ``inf`` if there is none."""
    try:
        return float(value)
    except OverflowError:
        return float("inf")


def evaluate(f: Callable[[int], int], q: int | Integers, overflow: int | None) -> int | Floats:
    """Apply an integer function to one distance exactly, to an array in binary64."""
    if not isinstance(q, np.ndarray) or q.ndim == 0:
        index = operator.index(q)
        if index < 0:
            raise ValueError(f"a distance is at least 0, not {index}")
        return f(index)
    if q.dtype.kind not in "iu":
        raise TypeError(f"distances are integers, not {q.dtype}")
    if (q < 0).any():
        raise ValueError(f"a distance is at least 0, not {q.min()}")
    distinct, inverse = np.unique(q, return_inverse=True)
    rounded = [
        float("inf") if overflow is not None and i > overflow else to_float(f(i))
        for i in distinct.tolist()
    ]
    return np.array(rounded, dtype=np.float64)[inverse].reshape(q.shape)


def true(comparison: Any, *, symbolic: bool) -> bool:
    """Truth of a comparison: False if an interval leaves it open, `symbolic` if a symbol does."""
    try:
        return bool(comparison)
    except TypeError:
        return symbolic
