"""Costs given as formulas: text or SymPy, with symbolic derivatives."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from numpy.typing import ArrayLike

from ...graphs import InputError
from ..arrays import Floats, Ints, family, fits
from .claim import claim, compare
from .compiled import Compiled
from .constancy import constant_hessian
from .cost import Cost, Curvature
from .probe import probe
from .quadratic import spectrum


@dataclass(frozen=True, eq=False)
class Symbolic(Cost):
    """A convex function in C^2 given as a formula.

    Parameters
    ----------
    expression : str or SymPy expression
        Such as ``"m*(x - a)**2/2 + log(cosh(x))"``; see `nearsight.lpc.costs.expression.parse` for
        what is accepted. SymPy is kept as text.
    variables : sequence of str or of symbols
        The names of the entries of w, in their order: n for a node cost, 2 n for a pair.
    parameters : mapping of str to array_like, shape ([[T,] I])
        Numbers that may change with the step and the member.
    lower, upper : array_like, shape ([[T,] I]), optional
        What the author says of the eigenvalues of the Hessian: at least `lower` (0 if omitted), at
        most `upper`. Computed, and needless, where the Hessian does not depend on w; then what is
        said has to agree.

    Raises
    ------
    InputError
        If the formula is not accepted or not in C^2, a name is unknown, `upper` is missing where
        it is needed, or the function is not convex.

    Examples
    --------
    >>> cost = Symbolic("a*(x - y)**2", ["x", "y"], {"a": [0.5, 1.0]})
    >>> cost.curvature().upper
    array([[2., 4.]])
    """

    expression: str
    variables: tuple[str, ...]
    parameters: Mapping[str, Floats]
    lower: Floats | None
    upper: Floats | None
    kind = "symbolic"

    def __init__(
        self,
        expression: Any,
        variables: Sequence[Any],
        parameters: Mapping[str, ArrayLike] | None = None,
        lower: ArrayLike | None = None,
        upper: ArrayLike | None = None,
    ) -> None:
        made = Compiled((expression,), variables, parameters)
        object.__setattr__(self, "expression", made.texts[0])
        object.__setattr__(self, "variables", made.variables)
        object.__setattr__(self, "parameters", made.parameters)
        object.__setattr__(self, "_compiled", made)
        for name, value in (("lower", lower), ("upper", upper)):
            bound = None if value is None else family(value, 0, f"{name} curvature of a formula")
            object.__setattr__(self, name, bound)
        object.__setattr__(self, "_curvature", self._bounds(made))

    def _bounds(self, made: Compiled) -> Curvature:
        """Return the eigenvalues of a constant Hessian, or else the claim."""
        constant = constant_hessian(made)
        what = f"formula {self.expression[:60]!r}"
        if constant is None:
            if self.upper is None:
                raise InputError(
                    f"{what}: its curvature changes with {', '.join(self.variables)}; say upper, "
                    "a bound on the eigenvalues of the Hessian (and lower, if it is not 0)"
                )
            return claim(self.lower, self.upper, what)
        matrix, error = constant
        found = spectrum(matrix, what, error)
        compare(found, self.lower, self.upper, what)
        return found

    @property
    def size(self) -> int:
        """The length of w."""
        return len(self.variables)

    @cached_property
    def steady(self) -> bool:
        """Whether no parameter that changes with the step is in the Hessian."""
        moving = {name for name, value in self.parameters.items() if len(value) > 1}
        bends = self._made.symbols.orders[2]
        return not any(str(symbol) in moving for bend in bends for symbol in bend.free_symbols)

    @property
    def _made(self) -> Compiled:
        found: Compiled = self._compiled  # type: ignore[attr-defined]
        return found

    def value(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the costs, shape (m,)."""
        return self._made.value(t, i, w)[:, 0]

    def gradient(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the gradients, shape (m, size)."""
        return self._made.gradient(t, i, w)[:, 0]

    def hessian(self, t: Ints, i: Ints, w: Floats) -> Floats:
        """Return the Hessians, shape (m, size, size)."""
        return self._made.hessian(t, i, w)[:, 0]

    def curvature(self) -> Curvature:
        """Return the eigenvalues of a constant Hessian, or what the author says of them."""
        found: Curvature = self._curvature  # type: ignore[attr-defined]
        return found

    def check(self, H: int, count: int, size: int, name: str) -> None:
        """Raise `InputError` unless shapes fit, and a few samples agree with what is claimed."""
        if self.size != size:
            raise InputError(f"{name}: a formula in {self.size} variables where {size} are needed")
        for key, array in self.parameters.items():
            fits(array, H, count, f"parameter {key} of the {name}")
        for key in ("lower", "upper"):
            if getattr(self, key) is not None:
                fits(getattr(self, key), H, count, f"{key} curvature of the {name}")
        if count and self.curvature().source == "claimed":
            probe(self, H, count, name, samples=64)
