"""Formulas with symbolic derivatives, compiled for arrays of points."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...graphs import InputError
from ..arrays import Floats, Ints, at, family
from . import stable
from .derivatives import Symbols, symbols
from .expression import check_names, write

BITS = 212  # of the numbers that take over where doubles overflow on the way to a result
Function = Callable[..., Any]


@dataclass(frozen=True, eq=False)
class Compiled:
    """``p`` functions of ``s`` variables, given as formulas in variables and parameters.

    Parameters
    ----------
    texts : sequence of str or SymPy expressions
        The formulas; kept as text, so that what is loaded is computed as what was saved.
    variables : sequence of str or symbols
        The names of the entries of w, in their order.
    parameters : mapping of str to array_like, shape ([[T,] I])
        Numbers that may change with the step and the member.

    Raises
    ------
    InputError
        If a name is unusable or unknown, a formula is not accepted, or a parameter is not a
        finite number for every step and member.
    """

    texts: tuple[str, ...]
    variables: tuple[str, ...]
    parameters: Mapping[str, Floats]

    def __init__(
        self,
        texts: Sequence[Any],
        variables: Sequence[Any],
        parameters: Mapping[str, ArrayLike] | None = None,
    ) -> None:
        texts = tuple(text if isinstance(text, str) else _text(text) for text in texts)
        names = (variables,) if isinstance(variables, str) else tuple(map(str, variables))
        given = {str(k): v for k, v in (parameters or {}).items()}
        if not names:
            raise InputError("variables of a formula: at least one is needed")
        check_names(names + tuple(given))
        values = {k: family(v, 0, f"parameter {k}") for k, v in given.items()}
        object.__setattr__(self, "texts", texts)
        object.__setattr__(self, "variables", names)
        object.__setattr__(self, "parameters", values)
        symbols(texts, names, tuple(values))  # raises where a formula is not accepted

    @property
    def symbols(self) -> Symbols:
        """The formulas and their derivatives as SymPy expressions."""
        return symbols(self.texts, self.variables, tuple(self.parameters))

    def value(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the p functions, shape (m, p)."""
        return self._run(0, t, i, w)

    def gradient(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return their gradients, shape (m, p, s)."""
        p, s = len(self.texts), len(self.variables)
        return self._run(1, t, i, w).reshape(len(w), p, s)

    def hessian(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return their Hessians, exactly symmetric, shape (m, p, s, s)."""
        p, s = len(self.texts), len(self.variables)
        half = self._run(2, t, i, w).reshape(len(w), p, s * (s + 1) // 2)
        found = np.empty((len(w), p, s, s))
        rows, columns = np.triu_indices(s)
        found[:, :, rows, columns] = half
        found[:, :, columns, rows] = half
        return found

    def _run(self, order: int, t: Ints, i: Ints, w: Floats) -> Floats:
        columns = [*w.T, *(at(value, t, i) for value in self.parameters.values())]
        # one contiguous row a name: what NumPy computes must not depend on the other points
        table = np.ascontiguousarray(np.stack(columns))
        key = (self.texts, self.variables, tuple(self.parameters))
        plain, exact = _functions(*key, order)
        return _evaluate(plain, exact, table, len(symbols(*key).orders[order]))


def _text(expression: Any) -> str:
    import sympy

    try:
        return write(sympy.sympify(expression, strict=True))
    except sympy.SympifyError as error:
        raise InputError(f"formula {expression!r}: text or a SymPy expression is needed") from error


@cache
def _functions(
    texts: tuple[str, ...], variables: tuple[str, ...], parameters: tuple[str, ...], order: int
) -> tuple[Function, Function]:
    """Compile one order of derivatives, for NumPy and for mpmath."""
    import mpmath
    import sympy

    wide = {
        "logcosh": lambda u: mpmath.log(mpmath.cosh(u)),
        "rise": mpmath.tanh,
        "bell": lambda u: mpmath.sech(u) ** 2,
        "softplus": lambda u: mpmath.log1p(mpmath.exp(u)),
        "logistic": lambda u: 1 / (1 + mpmath.exp(-u)),
        "hyperbola": lambda u: mpmath.sqrt(1 + u**2),
        "tilt": lambda u: u / mpmath.sqrt(1 + u**2),
        "bump": lambda u: (1 + u**2) ** -1.5,
    }
    found = symbols(texts, variables, parameters)
    own = [*found.variables, *found.parameters]
    # names that nothing in the generated code can have
    names = [sympy.Symbol(f"_v{j}", real=True) for j in range(len(own))]
    renamed = dict(zip(own, names, strict=True))
    entries = [entry.xreplace(renamed) for entry in found.orders[order]]

    def shared(entries: list[Any]) -> Any:
        return sympy.cse(entries, symbols=sympy.numbered_symbols("_s"), list=False)

    fast = {name: getattr(stable, name) for name in stable.NAMES}
    plain = sympy.lambdify(names, entries, modules=[fast, "numpy"], cse=shared)
    exact = sympy.lambdify(names, entries, modules=[wide, "mpmath"], cse=shared)
    return plain, exact


def _evaluate(plain: Function, exact: Function, table: Floats, entries: int) -> Floats:
    """Return all entries at all points, shape (m, entries).

    Where a double overflows on the way (``cosh(1000)``), the point is computed with mpmath, whose
    exponents have no limit. Halving finds such points; the others are as they would be anyway.
    """
    m = table.shape[1]
    if m == 0:
        return np.zeros((0, entries))
    try:
        with np.errstate(over="raise", invalid="raise", divide="raise", under="ignore"):
            found = [np.broadcast_to(entry, (m,)) for entry in plain(*table)]
        return np.stack(found, axis=1).astype(np.float64)
    except FloatingPointError:
        if m == 1:
            return _exactly(exact, table[:, 0], entries)
        halves = np.ascontiguousarray(table[:, : m // 2]), np.ascontiguousarray(table[:, m // 2 :])
        return np.concatenate([_evaluate(plain, exact, half, entries) for half in halves])


def _exactly(exact: Function, point: Floats, entries: int) -> Floats:
    """Return all entries at one point, shape (1, entries); NaN where there is no real value."""
    import mpmath

    with mpmath.workprec(BITS):
        try:
            found = exact(*(mpmath.mpf(float(x)) for x in point))
        except (ArithmeticError, ValueError, MemoryError):
            return np.full((1, entries), np.nan)
        real = [float(x) if getattr(x, "imag", 0) == 0 else np.nan for x in found]
    return np.array([real])
