"""Support by instances that try to break a claim, boundary cases first."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..check import Check
from ..evidence import Evidence, Level
from .exact import plain

Trial = tuple[float, float, Mapping[str, Any]]


@dataclass(frozen=True)
class Search(Check):
    """``measured <= bound`` on many instances.

    Parameters
    ----------
    trial : callable
        ``trial(rng) -> (measured, bound, instance)``: one instance inside the hypotheses; draws the
        boundary cases often.
    reason : str
        What the instances are.
    quick, full : int
        How many at each level.
    nudge : float
        A factor on the bound at which the search must find a violation: the statement is known to
        be within that factor of the truth. It is what `mutants` test.
    rounding : float
        Relative excess that rounding may cause.
    seed : int
    """

    trial: Callable[[np.random.Generator], Trial]
    reason: str
    quick: int = 200
    full: int = 5000
    nudge: float = 0.5
    rounding: float = 1e-9
    seed: int = 0
    scale: float = 1.0

    def run(self, level: Level) -> Evidence:
        """Return support with the smallest slack, or the first violation.

        A violation that is found here is a refutation in floating point; a claim keeps it as a
        `Counterexample`, re-checked exactly.
        """
        count = self.quick if level == "quick" else self.full
        worst, at, seen = -np.inf, {}, (0.0, 0.0)
        for i in range(count):
            measured, bound, instance = self.trial(np.random.default_rng([self.seed, i]))
            bound *= self.scale
            ratio = measured / bound if bound > 0 else (np.inf if measured > 0 else 0.0)
            if ratio > worst:
                worst, at, seen = ratio, dict(instance), (measured, bound)
            if measured > bound * (1 + self.rounding) and measured > 1e-14:
                return Evidence(
                    "refuted",
                    "search",
                    f"{self.reason}: instance {i} of the search violates it.",
                    plain({"seed": [self.seed, i], **instance}),
                    measured,
                    bound,
                    i + 1,
                )
        return Evidence(
            "supported",
            "search",
            f"{self.reason}: no violation in {count} instances; the largest ratio of the two sides "
            f"is {worst:.4g}.",
            measured=seen[0],
            bound=seen[1],
            instances=count,
            details={"largest_ratio": float(worst), "worst": plain(at)},
        )

    def mutants(self) -> tuple[Check, ...]:
        """Return the search for a bound smaller by the factor `nudge`."""
        return (replace(self, scale=self.scale * self.nudge),)
