"""What an engine is: something that can decide, and can fail."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterable

from .evidence import Evidence, Level


class Check(ABC):
    """One way of checking one claim.

    A subclass is an engine (`verify.engines`); an object of it knows the statement. A check must
    be able to fail: `mutants` are the same check of statements nudged past the truth, and the
    build fails if one of them is not rejected.
    """

    @abstractmethod
    def run(self, level: Level) -> Evidence:
        """Return what is found; ``"quick"`` may take a second, ``"full"`` a minute.

        Must give the same answer each time: seeds are fixed.
        """

    def mutants(self) -> Iterable[Check]:
        """Return checks of false statements near this one.

        None for a check whose evidence is exact in itself (an identity decided symbolically, an
        instance in rational arithmetic), at least one for a check by intervals or by search.
        """
        return ()
