"""Which perturbation bounds a competitive ratio of the paper is built on."""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple, Protocol

from .arithmetic import Number
from .global_bound import GlobalBound, global_repaired, global_stated
from .local_bound import LocalBound, local_repaired, local_stated
from .setting import Setting
from .theorem import Tier
from .tight import choice


class Constants(NamedTuple):
    """The local and the global bound, and margins that must all be ``>= 0``."""

    local: LocalBound
    whole: GlobalBound
    margins: tuple[Number, ...] = ()


class Source(Protocol):
    """Gives the constants of a setting, in its arithmetic."""

    def __call__(self, s: Setting) -> Constants:
        """Return the constants."""
        ...


def whole_bound(tier: Tier, a_T: Number) -> GlobalBound:
    """Return the stated or the repaired global bound."""
    return global_stated(a_T) if tier == "stated" else global_repaired(a_T)


@dataclass(frozen=True)
class Regrouped:
    """With ``thm:networked-exp-decay``, stated or repaired."""

    tier: Tier

    def __call__(self, s: Setting) -> Constants:
        """Return the constants of the tier."""
        local = local_stated if self.tier == "stated" else local_repaired
        return Constants(local(s.a_T, s.a_S, s.max_degree), whole_bound(self.tier, s.a_T))


@dataclass(frozen=True)
class Tight:
    """With ``thm:networked-exp-decay-tight`` at given ``b_1, b_2``."""

    tier: Tier
    b_1: float
    b_2: float

    def __call__(self, s: Setting) -> Constants:
        """Return the constants, with the margins of the theorem's two conditions."""
        zero = 0 * s.a_T
        found = choice(s.growth, s.a_T, s.a_S, self.b_1 + zero, self.b_2 + zero)
        return Constants(found.local, whole_bound(self.tier, s.a_T), found.margins)
