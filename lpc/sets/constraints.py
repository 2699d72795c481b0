"""Convex sets given by formulas: ``"x**2 + y**2 - a"`` and the like, each at most 0."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

from numpy.typing import ArrayLike

from ..arrays import Floats, Ints, fits
from ..costs.compiled import Compiled
from .convex import Convex


@dataclass(frozen=True, eq=False)
class Constraints(Convex):
    """``{y : g_j(y) <= 0 for all j}`` with convex g_j in C^2 given as formulas.

    Parameters
    ----------
    expressions : sequence of str or SymPy expressions
        The g_j; see `nearsight.lpc.costs.expression.parse` for what is accepted.
    variables : sequence of str or of symbols, length n
        The names of the entries of y.
    parameters : mapping of str to array_like, shape ([[T,] N])
        Numbers that may change with the step and the agent.

    Raises
    ------
    InputError
        If a formula is not accepted or not in C^2, or a name is unknown.

    Examples
    --------
    >>> disc = Constraints(["x**2 + y**2 - r**2"], ["x", "y"], {"r": [1.0, 2.0]})
    >>> disc.constant
    (True, False)
    """

    expressions: tuple[str, ...]
    variables: tuple[str, ...]
    parameters: Mapping[str, Floats]
    kind = "constraints"

    def __init__(
        self,
        expressions: Sequence[Any],
        variables: Sequence[Any],
        parameters: Mapping[str, ArrayLike] | None = None,
    ) -> None:
        given = (expressions,) if isinstance(expressions, str) else tuple(expressions)
        made = Compiled(given, variables, parameters)
        object.__setattr__(self, "expressions", made.texts)
        object.__setattr__(self, "variables", made.variables)
        object.__setattr__(self, "parameters", made.parameters)
        object.__setattr__(self, "_compiled", made)

    @property
    def size(self) -> int:
        """The number of entries of y."""
        return len(self.variables)

    @property
    def constant(self) -> tuple[bool, bool]:
        """Whether no parameter changes with the step, and none with the agent."""
        shapes = [value.shape for value in self.parameters.values()]
        return all(shape[0] == 1 for shape in shapes), all(shape[1] == 1 for shape in shapes)

    def name(self, j: int) -> str:
        """Return constraint j as it was written."""
        return f"constraint {self.expressions[j]!r}"

    def constraints(self, t: Ints, v: Ints, y: Floats) -> tuple[Floats, Floats, Floats]:
        """Return ``g`` (m, p), its gradients (m, p, n) and Hessians (m, p, n, n)."""
        made: Compiled = self._compiled  # type: ignore[attr-defined]
        return made.value(t, v, y), made.gradient(t, v, y), made.hessian(t, v, y)

    def check(self, H: int, N: int, n: int) -> None:
        """Raise `InputError` unless sizes fit, constraints look convex, and no set is empty."""
        for key, value in self.parameters.items():
            fits(value, H, N, f"parameter {key} of the feasible set")
        super().check(H, N, n)
