"""A number of the paper's proofs beside the exact one."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Literal

from ..bounds.arithmetic import Number

Tier = Literal["stated", "repaired", "sharp"]


@dataclass(frozen=True)
class Claimed:
    """The claim ``exact >= claimed``.

    Attributes
    ----------
    label : str
        The paper's.
    part : str
        Which of the claims under that label.
    tier : str
        ``"stated"``: as printed; ``"repaired"``: what its proof gives; ``"sharp"``.
    exact, claimed : number
        Both sides, in the arithmetic they were asked for in.
    hypotheses : bool
        Whether the hypotheses of the claim hold here.
    """

    label: str
    part: str
    tier: Tier
    exact: Number
    claimed: Number
    hypotheses: bool = True

    @property
    def holds(self) -> Any:
        """Whether the exact number is as large as claimed."""
        return self.exact >= self.claimed

    @property
    def refuted(self) -> bool:
        """Whether this is a counterexample."""
        return self.hypotheses and not bool(self.holds)
