"""What a run of the verifier returns."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Literal

from .claim import Claim
from .evidence import WORDS, Level, Verdict

Outcome = Literal["refuted", "undecided", "accepted", "missing"]


@dataclass(frozen=True)
class Mutation:
    """What a check makes of a false statement near its own.

    Parameters
    ----------
    key : str
        Of the claim.
    check, mutant : int
        Which check of the claim, and which mutant of the check, counted from 0.
    engine : str
        The class of the check.
    outcome : {"refuted", "undecided", "accepted", "missing"}
        ``refuted`` and ``undecided`` (the check finds no proof) reject the false statement;
        ``accepted`` is an error of the check, ``missing`` says that it has no mutant.
    text : str
        What the check says.
    """

    key: str
    check: int
    engine: str
    mutant: int
    outcome: Outcome
    text: str

    @property
    def good(self) -> bool:
        """Whether the false statement is rejected."""
        return self.outcome in ("refuted", "undecided")


@dataclass(frozen=True)
class Change:
    """A verdict that is not the recorded one.

    Parameters
    ----------
    key : str
        Of the claim.
    recorded, found : str or None
        The two verdicts; None for a claim that is not recorded, or that is recorded and gone, or
        on which there is no verdict now.
    """

    key: str
    recorded: str | None
    found: str | None

    def __str__(self) -> str:
        return f"{self.key}: {self.found or 'no verdict'}, recorded is {self.recorded or 'none'}"


@dataclass(frozen=True)
class Report:
    """The verdicts on claims, with all that is needed to show and to doubt them.

    Parameters
    ----------
    level : {"quick", "full"}
    claims : tuple of Claim
        Those judged, in the order of the catalogue.
    verdicts : tuple of Verdict
        In the same order; a claim in `errors` has none.
    seconds : dict
        Key -> how long it took when it was computed.
    errors : dict
        Key -> why there is no verdict.
    changes : tuple of Change
        Against the recorded verdicts.
    mutations : tuple of Mutation or None
        None if mutants were not asked for.
    """

    level: Level
    claims: tuple[Claim, ...]
    verdicts: tuple[Verdict, ...]
    seconds: Mapping[str, float] = field(default_factory=dict)
    errors: Mapping[str, str] = field(default_factory=dict)
    changes: tuple[Change, ...] = ()
    mutations: tuple[Mutation, ...] | None = None

    def __getitem__(self, key: str) -> Verdict:
        """Return the verdict on the claim with a key."""
        for verdict in self.verdicts:
            if verdict.key == key:
                return verdict
        raise KeyError(f"no verdict on {key!r}")

    @property
    def counts(self) -> dict[str, int]:
        """How many claims have each verdict."""
        counted = Counter(verdict.verdict for verdict in self.verdicts)
        return {word: counted[word] for word in WORDS}

    @property
    def weak(self) -> tuple[Mutation, ...]:
        """The checks that cannot fail: a mutant is accepted, or there is none."""
        return tuple(m for m in self.mutations or () if not m.good)

    @property
    def good(self) -> bool:
        """Whether every claim has its recorded verdict and every mutant is rejected."""
        return not (self.changes or self.errors or self.weak)
