"""One number of a lemma beside what the lemma promises for it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from ..graphs import InputError
from ..lpc.arrays import Floats

Relation = Literal["<=", "=="]
ROUNDING = 1e-9  # share of a bound that the rounding of what is measured may take


@dataclass(frozen=True)
class Comparison:
    """A measured number, a bound, and the relation that a lemma claims between them.

    Parameters
    ----------
    label : str
        The lemma, by its label in the paper.
    part : str
        Which inequality of it, and in which tier: ``"stated"``, ``"sharp"``, ...
    measured, bound : float
        Both counted in the same way; the bound may be infinite.
    relation : {"<=", "=="}
        What is claimed of them.
    tolerance : float
        By how much rounding may have moved `measured`.
    instance : str
        What was measured, in words.
    seed : int, optional
        What the instance was drawn from.
    hypotheses : bool
        Whether the instance obeys the hypotheses of the lemma. If not, nothing is claimed.

    Raises
    ------
    InputError
        If a number is not one, the tolerance is negative, or the relation is unknown.
    """

    label: str
    part: str
    measured: float
    bound: float
    relation: Relation = "<="
    tolerance: float = 0.0
    instance: str = ""
    seed: int | None = None
    hypotheses: bool = True

    def __post_init__(self) -> None:
        for name in ("measured", "bound", "tolerance"):
            value = getattr(self, name)
            if math.isnan(value) or (name != "bound" and math.isinf(value)):
                raise InputError(f"{name} = {value}: a number is needed", name)
        if self.tolerance < 0:
            raise InputError(f"tolerance = {self.tolerance:g}: >= 0 is needed", "tolerance")
        if self.relation not in ("<=", "=="):
            raise InputError(f"relation = {self.relation!r}: '<=' or '==' is needed", "relation")

    @property
    def ratio(self) -> float:
        """How much is used of what is allowed.

        ``max(measured - tolerance, 0)/bound`` for an inequality, ``|measured - bound|/tolerance``
        for an equation; ``0/0 = 0``.
        """
        if self.relation == "==":
            return _quotient(abs(self.measured - self.bound), self.tolerance)
        return _quotient(max(self.measured - self.tolerance, 0.0), self.bound)

    @property
    def holds(self) -> bool:
        """Whether the relation is true of the two numbers."""
        if self.relation == "==":
            return abs(self.measured - self.bound) <= self.tolerance
        return self.measured <= self.bound + self.tolerance

    @property
    def violates(self) -> bool:
        """Whether this refutes the lemma: the hypotheses hold and the relation does not."""
        return self.hypotheses and not self.holds


def worst(
    label: str,
    part: str,
    measured: Floats,
    bound: Floats | float,
    *,
    rounding: float = ROUNDING,
    **described: Any,
) -> tuple[Comparison, ...]:
    """Return the entry that is largest beside its bound, of many that obey one inequality.

    Parameters
    ----------
    label, part : str
        As in `Comparison`.
    measured, bound : ndarray
        Of shapes that broadcast.
    rounding : float
        Tolerance, as a share of the bound.
    **described
        `instance`, `seed` and `hypotheses` of the `Comparison`.

    Returns
    -------
    tuple of Comparison
        One, or none if there are no entries.
    """
    measured, bound = np.broadcast_arrays(np.asarray(measured, float), np.asarray(bound, float))
    if not measured.size:
        return ()
    with np.errstate(divide="ignore", invalid="ignore"):
        share = np.where(measured == 0, 0.0, measured / bound)
    at = np.unravel_index(int(np.argmax(share)), share.shape)
    found, limit = float(measured[at]), float(bound[at])
    tolerance = rounding * limit if math.isfinite(limit) else 0.0
    return (Comparison(label, part, found, limit, "<=", tolerance, **described),)


def _quotient(a: float, b: float) -> float:
    if a == 0:
        return 0.0
    return a / b if b > 0 else math.inf
