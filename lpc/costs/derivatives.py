"""Formulas and their derivatives as SymPy expressions that double precision computes well."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache
from typing import Any

from ...graphs import InputError
from .expression import function, parse


@dataclass(frozen=True)
class Symbols:
    """SymPy expressions: values (p), gradients (p s) and upper triangles of Hessians, flat."""

    variables: tuple[Any, ...]
    parameters: tuple[Any, ...]
    orders: tuple[tuple[Any, ...], tuple[Any, ...], tuple[Any, ...]]


@lru_cache(maxsize=256)
def symbols(
    texts: tuple[str, ...], variables: tuple[str, ...], parameters: tuple[str, ...]
) -> Symbols:
    """Return the formulas and their first and second derivatives."""
    import sympy

    names = variables + parameters
    x = [sympy.Symbol(name, real=True) for name in variables]
    values = [_steady(parse(text, names)) for text in texts]
    for value, text in zip(values, texts, strict=True):
        if value.has(sympy.Abs, sympy.sign, sympy.re, sympy.im, sympy.I):
            raise InputError(f"formula {text[:60]!r}: it is {value}, not twice differentiable")
    slopes = [sympy.diff(value, y) for value in values for y in x]
    s = len(x)
    bends = [
        sympy.diff(slopes[p * s + a], x[b])
        for p in range(len(values))
        for a in range(s)
        for b in range(a, s)
    ]
    known = tuple(sympy.Symbol(name, real=True) for name in parameters)
    return Symbols(tuple(x), known, (tuple(values), tuple(slopes), tuple(bends)))


def _steady(expression: Any) -> Any:
    """Rewrite ``log cosh``, ``log(exp + exp)`` and ``sqrt(c + u^2)`` as functions of `stable`."""
    import sympy

    def logarithm(inner: Any) -> Any:
        if inner.func is sympy.cosh:
            return function("logcosh")(inner.args[0])
        if inner.is_Add and len(inner.args) == 2:
            heights = [a.args[0] if a.func is sympy.exp else a - 1 for a in inner.args]
            if all(a.func is sympy.exp or a == 1 for a in inner.args):
                low, high = sorted(heights, key=lambda u: not u.is_zero)
                return low + function("softplus")(high - low)
        return sympy.log(inner)

    def root(base: Any, exponent: Any) -> Any:
        if exponent == sympy.Rational(1, 2) and base.is_Add and len(base.args) == 2:
            number, rest = base.as_coeff_Add()
            factor, square = rest.as_coeff_Mul()
            if number > 0 and factor > 0 and square.is_Pow and square.exp == 2:
                inner = sympy.sqrt(factor / number) * square.base
                return sympy.sqrt(number) * function("hyperbola")(inner)
        return sympy.Pow(base, exponent)

    return expression.replace(sympy.log, logarithm).replace(sympy.Pow, root)
