"""Proof by algebra: an identity, or a polynomial without negative coefficients."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from ..check import Check
from ..evidence import Evidence, Level


@dataclass(frozen=True)
class Identity(Check):
    """``left == right`` for all values of the symbols.

    Parameters
    ----------
    sides : callable
        Returns two SymPy expressions, rational in the symbols (after a substitution that makes
        them so).
    substitution : str
        That substitution, in words.
    """

    sides: Callable[[], tuple[Any, Any]]
    substitution: str

    def run(self, level: Level) -> Evidence:
        """Bring the difference to one fraction; it vanishes if and only if its numerator does."""
        import sympy

        left, right = self.sides()
        numerator, _ = sympy.fraction(sympy.together(left - right))
        rest = sympy.expand(numerator)
        if rest != 0:
            raise RuntimeError(f"no identity: the numerator of the difference is {rest}")
        return Evidence(
            "proved",
            "symbolic",
            f"{self.substitution}: the difference of the two sides has numerator 0.",
        )


@dataclass(frozen=True)
class Nonnegative(Check):
    """``right - left >= 0`` for all nonnegative values of the symbols.

    Parameters
    ----------
    sides : callable
        Returns ``(left, right)``, SymPy expressions that are rational in symbols that range over
        ``[0, oo)``, with positive denominators.
    substitution : str
        How the variables of the claim are expressed by those symbols, in words.
    """

    sides: Callable[[], tuple[Any, Any]]
    substitution: str

    def run(self, level: Level) -> Evidence:
        """Expand numerator and denominator of the difference: no coefficient is negative."""
        import sympy

        left, right = self.sides()
        top, bottom = sympy.fraction(sympy.cancel(sympy.together(right - left)))
        symbols = sorted((right - left).free_symbols, key=str)
        if not symbols:
            signs = [sympy.Rational(top), sympy.Rational(bottom)]
            polynomials = signs
            good = bool(signs[0] >= 0) and bool(signs[1] > 0)
        else:
            polynomials = [sympy.Poly(part, *symbols) for part in (top, bottom)]
            if all(c <= 0 for p in polynomials for c in p.coeffs()):
                polynomials = [-p for p in polynomials]
            good = all(c >= 0 for p in polynomials for c in p.coeffs())
            good &= bool(polynomials[1].coeffs()) and not polynomials[1].is_zero
        if not good:
            raise RuntimeError(f"a coefficient is negative: {top} / ({bottom})")
        return Evidence(
            "proved",
            "symbolic",
            f"{self.substitution}: right minus left is a quotient of polynomials without "
            "negative coefficients.",
            details={"numerator": str(top), "denominator": str(bottom)},
        )

    def mutants(self) -> tuple[Check, ...]:
        """Return the reversed inequality, which must be rejected unless both sides agree."""
        return (Nonnegative(lambda: self.sides()[::-1], self.substitution),)
