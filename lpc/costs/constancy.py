"""Is the Hessian of a formula the same everywhere, and what is it?"""

from __future__ import annotations

from typing import Any

import numpy as np

from ..arrays import Floats
from .compiled import Compiled

EPS = float(np.finfo(float).eps)


def constant_hessian(made: Compiled) -> tuple[Floats, Floats] | None:
    """Return the Hessian of one formula where it does not depend on w, shape (T, I, s, s).

    Returns
    -------
    tuple or None
        The matrices, and bounds on the rounding errors of their entries, shape (T, I). None if
        the Hessian depends on w, or on parameters other than rationally.
    """
    import sympy

    known = made.symbols
    own = set(known.variables)
    bends = []
    for bend in known.orders[2]:
        if bend.free_symbols & own:
            if not bend.is_polynomial(*own):
                return None
            bend = sympy.expand(bend)
        if bend.free_symbols & own or not bend.is_rational_function(*known.parameters):
            return None
        bends.append(bend)
    values = {str(key): value for key, value in made.parameters.items()}
    shape = np.broadcast_shapes((1, 1), *_used(bends, values))
    s = len(known.variables)
    matrix, error = np.empty((*shape, s, s)), np.zeros(shape)
    for bend, a, b in zip(bends, *np.triu_indices(s), strict=True):
        with np.errstate(all="ignore"):
            entry, off = _walk(bend, values)
        matrix[..., a, b] = matrix[..., b, a] = entry
        error = np.maximum(error, off)
    return (matrix, error) if np.isfinite(matrix).all() else None


def _used(bends: list[Any], values: dict[str, Floats]) -> list[tuple[int, ...]]:
    names = {str(symbol) for bend in bends for symbol in bend.free_symbols}
    return [values[name].shape for name in names]


def _walk(expression: Any, values: dict[str, Floats]) -> tuple[Floats, Floats]:
    """Return a rational expression in doubles, and a bound on its rounding error."""
    if expression.is_Symbol:
        found = values[str(expression)]
        return found, np.zeros_like(found)
    if expression.is_number:
        number = np.array(float(expression))
        true = expression.is_Float or (expression.is_Rational and number == expression)
        return number, np.array(0.0 if true else EPS * abs(number))
    if expression.is_Pow and expression.exp.is_Integer:
        base, off = _walk(expression.base, values)
        k = int(expression.exp)
        value = base**k
        spread = abs(k) * np.abs(base) ** (k - 1) * off * (1 + 4 * off / np.abs(base))
        spread = np.where(off > 0, spread, 0.0)
        return value, spread + (abs(k) + 1) * EPS * np.abs(value)
    parts = [_walk(part, values) for part in expression.args]
    value, off = parts[0]
    for other, more in parts[1:]:
        if expression.is_Add:
            value, off = value + other, off + more
            off = off + EPS * np.abs(value)
        else:
            off = off * np.abs(other) + more * np.abs(value) + off * more
            exact = (np.frexp(value)[0] == 0.5) | (np.frexp(other)[0] == 0.5) | (value * other == 0)
            value = value * other
            off = off + np.where(exact, 0.0, EPS * np.abs(value))
    return value, off
