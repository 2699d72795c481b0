"""Refutation by one instance, in rational arithmetic or intervals."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from ..check import Check
from ..evidence import Evidence, Level

Sides = Callable[[], tuple[Any, Any]]


@dataclass(frozen=True)
class Counterexample(Check):
    """An instance inside the hypotheses at which ``left <= right`` fails.

    Parameters
    ----------
    sides : callable
        Returns ``(left, right)``, numbers that are compared exactly: `fractions.Fraction`, int, or
        flint ``arb`` balls (then the comparison holds for all members of the balls).
    instance : dict
        The numbers that define it, rational ones as Fractions; a reader redoes it by hand.
    reason : str
        How: what is evaluated, and why the instance satisfies the hypotheses.
    """

    sides: Sides
    instance: Mapping[str, Any]
    reason: str

    def run(self, level: Level) -> Evidence:
        """Return the refutation.

        Raises
        ------
        RuntimeError
            If the instance does not violate the claim after all.
        """
        left, right = self.sides()
        if not bool(left > right):
            raise RuntimeError(
                f"no counterexample: {left} > {right} is not certain ({self.reason})"
            )
        return Evidence(
            "refuted",
            "exact",
            self.reason,
            {name: plain(value) for name, value in self.instance.items()},
            measured=float(left),
            bound=float(right),
        )


def plain(value: Any) -> Any:
    """Return a JSON value; Fractions as ``"p/q"``."""
    if isinstance(value, Fraction):
        return str(value)
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    return value
