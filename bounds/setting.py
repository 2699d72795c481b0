"""What a theorem is asked about: strengths of the costs, a network, perhaps k and r."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from ..graphs.errors import InputError
from ..graphs.growth import Growth
from .arithmetic import Number, kind_of
from .energy import Couplings
from .parameters import Parameters

LARGEST = 1_000_000
"""Largest horizon and radius that statements are evaluated at."""


@dataclass(frozen=True)
class Setting:
    """What a theorem is asked about.

    Parameters
    ----------
    parameters : Parameters
        Strengths of the costs, in any arithmetic; float arrays broadcast.
    growth : Growth
        What the theory needs of the network.
    k, r : int or array of int, optional
        Prediction horizon (``k >= 2``) and communication radius (``r >= 1``): below these
        LPC has no free variable.
    unconstrained : bool
        Whether every feasible set is all of R^n.
    b : tuple of two numbers, optional
        ``(b_1, b_2)`` of ``thm:networked-exp-decay-tight``; optimised if not given.

    Raises
    ------
    InputError
        If k, r or b are outside their range.
    """

    parameters: Parameters
    growth: Growth
    k: Any = None
    r: Any = None
    unconstrained: bool = False
    b: tuple[Number, Number] | None = None

    def __post_init__(self) -> None:
        for name, least, why in (("k", 2, "horizon"), ("r", 1, "radius")):
            value = getattr(self, name)
            if value is None:
                continue
            array = np.asarray(value)
            whole = array.dtype.kind in "iu"
            bad = array[(array < least) | (array > LARGEST)] if whole else array
            if bad.size:
                small = not whole or bad.flat[0] < least
                accepted = (
                    f">= {least} (below, LPC has no free variable)" if small else (f"<= {LARGEST}")
                )
                raise InputError(
                    f"{name} = {bad.flat[0]}: the {why} must be an integer {accepted}", name
                )
        typed = self.b is not None and kind_of(*self.b) == "float"
        if typed and not all(np.isfinite(b) and b > 0 for b in self.b or ()):
            raise InputError(f"b = {self.b}: two finite numbers > 0 are needed", "b")

    @property
    def a_T(self) -> Number:
        """``l_T/mu``."""
        return self.parameters.a_T

    @property
    def a_S(self) -> Number:
        """``l_S/mu``."""
        return self.parameters.a_S

    @property
    def max_degree(self) -> int:
        """The largest degree Delta."""
        return self.growth.max_degree

    @property
    def x(self) -> Number:
        """``Delta l_S/mu``."""
        return self.max_degree * self.a_S

    @property
    def couplings(self) -> Couplings:
        """The ratios that all sharp statements depend on."""
        return Couplings(self.a_T, self.a_S, self.parameters.condition, self.max_degree)

    @property
    def sized(self) -> bool:
        """Whether both k and r are given."""
        return self.k is not None and self.r is not None

    def converted(self, arithmetic: str) -> Setting:
        """Return the same setting in another arithmetic, see `Parameters.converted`."""
        return replace(self, parameters=self.parameters.converted(arithmetic))
