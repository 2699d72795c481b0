"""What a planner asks of a tier: bounds on ``CR - 1`` over many (k, r), and their floors."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import numpy as np
import numpy.typing as npt

Floats = npt.NDArray[np.float64]
FAR = 10**9  # a horizon at which nothing of the top is left


class Promise(ABC):
    """A bound on ``CR - 1`` as a function of k and r, fast in floats.

    Attributes
    ----------
    variant : str
        Which statement, for the plan to name.
    steps : int
        From this horizon on `floor_in_r` does not decrease with k.
    """

    variant: str
    steps: int = 2

    @abstractmethod
    def excess(self, k: Any, r: Any) -> Floats:
        """Return the bound on ``CR - 1``, infinite where there is none."""

    @abstractmethod
    def floor_in_k(self, k: Any) -> Floats:
        """Return a number that decreases in k and is below `excess` at every ``k' <= k``."""

    @abstractmethod
    def floor_in_r(self, k: int, r: Any) -> Floats:
        """Return a number below `excess` at r and every ``k' >= k``, for ``k >= steps``."""

    def settled(self, k: int, r: Any) -> bool:
        """Whether from horizon k on the bound has its limit at all these radii, to 1e-12.

        What depends on k decays exponentially: it has to be gone at k and at 2 k.
        """
        limit = np.asarray(self.excess(FAR, r))
        values = np.stack([self.excess(k, r), self.excess(2 * k, r)])
        with np.errstate(invalid="ignore"):
            gone = (values == limit) | (np.abs(values - limit) <= 1e-12 * limit)
        return bool(np.all(gone))

    @abstractmethod
    def hopeless(self, k: int, r: int, excess: float) -> bool:
        """Say whether at horizon k no radius from r on brings ``CR - 1`` down to ``excess``."""

    @abstractmethod
    def upper(self, k: int, r: int) -> float:
        """Return a float that ``CR - 1`` at one pair is certain, by intervals, not to exceed.

        Infinite where a condition is not certain to hold.
        """

    def certified(self, k: int, r: int, excess: float) -> bool:
        """Say whether ``CR - 1 <= excess`` is certain at one pair."""
        return self.upper(k, r) <= excess
