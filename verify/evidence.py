"""Verdicts, and what they rest on."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Literal

from ..graphs import InputError

Word = Literal["proved", "supported", "refuted"]
Level = Literal["quick", "full"]
WORDS: tuple[Word, ...] = ("proved", "supported", "refuted")


@dataclass(frozen=True)
class Evidence:
    """What one check has found.

    Parameters
    ----------
    verdict : {"proved", "supported", "refuted"}
        ``proved``: symbolically, by a decision procedure, or by interval arithmetic over the whole
        hypothesis range. ``supported``: no violation in `instances` instances. ``refuted``: an
        explicit instance inside the hypotheses violates the claim, re-checked exactly.
    engine : str
        Which engine: ``symbolic``, ``decision``, ``interval``, ``exact``, ``search``.
    reason : str
        One or two sentences a reader can follow: the substitution, the boxes, the instance.
    instance : dict
        For a refutation: the numbers, as JSON values; rational ones as ``"p/q"``.
    measured, bound : float or None
        The two sides of the claim at the instance, or at the worst of those tried.
    instances : int
        For support: how many were tried.
    details : dict
        Whatever else makes the evidence checkable (boxes, certificates), as JSON values.
    """

    verdict: Word
    engine: str
    reason: str
    instance: Mapping[str, Any] = field(default_factory=dict)
    measured: float | None = None
    bound: float | None = None
    instances: int = 0
    details: Mapping[str, Any] = field(default_factory=dict)

    def __post_init__(self) -> None:
        if self.verdict not in WORDS:
            raise InputError(f"verdict = {self.verdict!r}: one of {', '.join(WORDS)}")
        if self.verdict == "refuted" and not self.instance:
            raise InputError("a refutation needs its instance")
        if self.verdict == "supported" and self.instances < 1:
            raise InputError("support needs instances")
        if not self.reason:
            raise InputError("evidence needs a reason")


def together(found: Sequence[Evidence]) -> Evidence:
    """Return one piece of evidence from several, the strongest first.

    Its verdict, instance and two sides are those of the first; the reasons are numbered, and the
    details of each are kept. Instances tried are added up.
    """
    first = found[0]
    if len(found) == 1:
        return first
    return replace(
        first,
        engine=" + ".join(dict.fromkeys(one.engine for one in found)),
        reason=" ".join(f"({i}) {one.reason}" for i, one in enumerate(found, 1)),
        instances=sum(one.instances for one in found),
        details={
            "parts": [
                {"engine": one.engine, "verdict": one.verdict, "reason": one.reason}
                | ({"instance": one.instance} if one.instance else {})
                | dict(one.details)
                for one in found
            ]
        },
    )


@dataclass(frozen=True)
class Verdict:
    """The verdict on one claim.

    Parameters
    ----------
    label, part : str
        Of the claim.
    verdict : {"proved", "supported", "refuted"}
    rests_on : tuple of str
        Keys of the refuted claims that its proof uses, directly or not.
    evidence : Evidence
        The strongest that the checks have found.
    """

    label: str
    part: str
    verdict: Word
    rests_on: tuple[str, ...]
    evidence: Evidence

    @property
    def key(self) -> str:
        """The label, and the part in brackets if there is one."""
        return f"{self.label}[{self.part}]" if self.part else self.label
