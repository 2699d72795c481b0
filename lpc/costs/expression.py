"""Formulas as text: ``"log(cosh(x - a)) + x**2/2"`` to SymPy and back, without `eval`."""

from __future__ import annotations

import ast
import keyword
from collections.abc import Callable, Iterable
from functools import cache
from typing import Any

from ...graphs import InputError

FUNCTIONS = (
    *("exp", "log", "sqrt", "sinh", "cosh", "tanh", "asinh", "sin", "cos", "atan"),
    *("logcosh", "softplus"),
)
"""The functions a formula may contain; `softplus` is ``log(1 + exp(x))``."""

CONSTANTS = ("pi", "E")
LONGEST = 20_000  # characters: what comes from a file shall not exhaust memory
HIGHEST_POWER = 64
MOST_BITS = 4096  # of an integer that a formula computes


def parse(text: str, names: Iterable[str]) -> Any:
    """Return the SymPy expression of a formula in the given names, all of them real.

    Parameters
    ----------
    text : str
        In Python's notation: names, numbers, ``+ - * / **``, parentheses, the constants ``pi``
        and ``E``, and the functions in `FUNCTIONS`.
    names : iterable of str
        The variables and parameters.

    Raises
    ------
    InputError
        If the text is anything else; the message quotes the part that is not accepted.
    """
    import sympy

    if len(text) > LONGEST:
        raise InputError(f"a formula of {len(text)} characters; at most {LONGEST} are accepted")
    known = {name: sympy.Symbol(name, real=True) for name in names}
    try:
        tree = ast.parse(text.strip(), mode="eval").body
        found = _Reader(text.strip(), known).read(tree)
    except (SyntaxError, ValueError, RecursionError, MemoryError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"formula {_short(text)}: not a formula ({error})") from error
    if found.has(sympy.nan, sympy.zoo, sympy.oo, -sympy.oo):
        raise InputError(f"formula {_short(text)}: it has no finite value")
    return found


def write(expression: Any) -> str:
    """Return a formula that `parse` turns into the same function.

    Raises
    ------
    InputError
        If the expression has a part that no formula can have, such as ``Abs(x)``.
    """
    import sympy

    kind = expression.func.__name__
    if expression.is_Symbol or expression in (sympy.pi, sympy.E):
        return str(expression)
    if expression.is_Float and expression._prec == 53 and expression.is_finite:
        return f"({float(expression)!r})"
    if expression.is_Float and expression.is_finite:
        expression = sympy.Rational(expression)  # exact: a float of another precision is dyadic
    if expression.is_Rational:
        return f"({expression.p}/{expression.q})" if expression.q != 1 else f"({expression.p})"
    parts = [write(part) for part in expression.args]
    if expression.is_Add or expression.is_Mul:
        return "(" + (" + " if expression.is_Add else "*").join(parts) + ")"
    if expression.is_Pow:
        return f"({parts[0]}**{parts[1]})"
    if kind in FUNCTIONS and len(parts) == 1:
        return f"{kind}({parts[0]})"
    raise InputError(f"formula: {expression} is not accepted; functions: {', '.join(FUNCTIONS)}")


def check_names(names: tuple[str, ...]) -> None:
    """Raise `InputError` unless these are different names that a formula can use."""
    for j, name in enumerate(names):
        if not name.isidentifier() or not name.isascii() or name.startswith("_"):
            raise InputError(f"variable or parameter {name!r}: a name such as x or theta_1")
        if keyword.iskeyword(name) or name in FUNCTIONS + CONSTANTS:
            raise InputError(f"variable or parameter {name!r}: the name has a meaning already")
        if name in names[:j]:
            raise InputError(f"variable or parameter {name!r}: it is there twice")


class _Reader:
    """Turns a syntax tree into SymPy, refusing every node that is not in a formula."""

    def __init__(self, text: str, known: dict[str, Any]) -> None:
        self.text = text
        self.known = known

    def read(self, node: ast.expr) -> Any:
        """Return the expression below a node."""
        import sympy

        match node:
            case ast.Constant(value=bool()):
                raise self.refused(node, "a number is needed")
            case ast.Constant(value=int(number)):
                return sympy.Integer(number)
            case ast.Constant(value=float(number)):
                return sympy.Float(number)
            case ast.Name(id=name) if name in self.known:
                return self.known[name]
            case ast.Name(id=name) if name in CONSTANTS:
                return getattr(sympy, name)
            case ast.Name():
                raise self.refused(node, f"there are the names {', '.join(self.known) or '(none)'}")
            case ast.UnaryOp(op=ast.USub(), operand=inner):
                return -self.read(inner)
            case ast.UnaryOp(op=ast.UAdd(), operand=inner):
                return self.read(inner)
            case ast.BinOp(left=left, op=ast.Pow(), right=right):
                return self.power(node, self.read(left), self.read(right))
            case ast.BinOp(left=left, op=op, right=right):
                return self.combined(node, op, self.read(left), self.read(right))
            case ast.Call(func=ast.Name(id=name), args=[inner], keywords=[]) if name in FUNCTIONS:
                return function(name)(self.read(inner))
        raise self.refused(node, f"accepted: + - * / ** and {', '.join(FUNCTIONS)}")

    def combined(self, node: ast.expr, op: ast.operator, a: Any, b: Any) -> Any:
        """Return a sum, a difference, a product or a quotient."""
        match op:
            case ast.Add():
                return a + b
            case ast.Sub():
                return a - b
            case ast.Mult():
                return a * b
            case ast.Div():
                return a / b
        raise self.refused(node, "accepted operators: + - * / **")

    def power(self, node: ast.expr, base: Any, exponent: Any) -> Any:
        """Return ``base**exponent`` unless it would be a number of unreasonable size."""
        if exponent.is_number and not abs(exponent) <= HIGHEST_POWER:
            raise self.refused(node, f"exponents up to {HIGHEST_POWER} are accepted")
        if base.is_Rational and exponent.is_Rational:
            bits = max(int(base.p).bit_length(), int(base.q).bit_length())
            if bits * abs(exponent) > MOST_BITS:
                raise self.refused(node, "the number is too large")
        return base**exponent

    def refused(self, node: ast.expr, why: str) -> InputError:
        """Return the error that quotes a node."""
        part = ast.get_source_segment(self.text, node) or self.text
        return InputError(f"formula {_short(self.text)}: {_short(part)} is not accepted; {why}")


def _short(text: str) -> str:
    text = " ".join(text.split())
    return repr(text if len(text) <= 60 else text[:57] + "...")


@cache
def function(name: str) -> Any:
    """Return the SymPy function of a name in `FUNCTIONS`, or of `stable`."""
    import sympy

    slopes: dict[str, Callable[[Any], Any]] = {
        "logcosh": lambda u: function("rise")(u),
        "rise": lambda u: function("bell")(u),
        "bell": lambda u: -2 * function("rise")(u) * function("bell")(u),
        "softplus": lambda u: function("logistic")(u),
        "logistic": lambda u: function("logistic")(u) * function("logistic")(-u),
        "hyperbola": lambda u: function("tilt")(u),
        "tilt": lambda u: function("bump")(u),
        "bump": lambda u: -3 * function("tilt")(u) * function("bump")(u) / function("hyperbola")(u),
    }
    if name not in slopes:
        return getattr(sympy, name)
    slope = slopes[name]

    # a class each, as SymPy knows functions by their class
    def fdiff(self: Any, _: int = 1) -> Any:
        return slope(self.args[0])

    return type(name, (sympy.Function,), {"nargs": 1, "fdiff": fdiff, "is_real": True})
