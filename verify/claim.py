"""A claim of the paper, or of this project, as an object."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from ..graphs import InputError
from .check import Check
from .evidence import Evidence, Level, together

Kind = Literal["theorem", "lemma", "corollary", "step", "remark", "definition"]
_STRENGTH = {"refuted": 2, "proved": 1, "supported": 0}


@dataclass(frozen=True)
class Claim:
    """One statement that is true or false.

    Parameters
    ----------
    label : str
        The paper's LaTeX label, unchanged. A claim without one is named after its place:
        ``"sec:main:perturb#b1b2-choice"``. One of the project begins with ``nearsight:``.
    part : str
        A letter, where one label has several claims; else empty.
    kind : str
        ``theorem``, ``lemma``, ``corollary``, ``step`` (a line of a proof), ``remark`` (in the
        text), ``definition``.
    title : str
        A few words.
    statement : str
        The claim in mathematics, as printed, plain text or LaTeX in ``$``.
    hypotheses : str
        What it supposes.
    checks : tuple of Check
        At least one. The verdict is that of the strongest evidence: a refutation beats a proof (and
        both at once are an error of ours), a proof beats support.
    uses : tuple of str
        Keys of the claims that its printed proof uses.
    repaired : str
        For a claim that fails: what holds instead, and the key of the claim that says so.
    """

    label: str
    title: str
    statement: str
    hypotheses: str
    checks: tuple[Check, ...]
    part: str = ""
    kind: Kind = "theorem"
    uses: tuple[str, ...] = ()
    repaired: str = ""

    def __post_init__(self) -> None:
        if not (self.label and self.title and self.statement and self.checks):
            raise InputError(f"claim {self.key!r}: label, title, statement and a check are needed")

    @property
    def key(self) -> str:
        """The label, and the part in brackets if there is one."""
        return f"{self.label}[{self.part}]" if self.part else self.label

    def judge(self, level: Level) -> Evidence:
        """Return the evidence of all checks, the strongest first.

        Raises
        ------
        RuntimeError
            If one check proves what another refutes.
        """
        found = [check.run(level) for check in self.checks]
        words = {evidence.verdict for evidence in found}
        if {"proved", "refuted"} <= words:
            raise RuntimeError(f"{self.key}: proved and refuted at once")
        return together(sorted(found, key=lambda evidence: -_STRENGTH[evidence.verdict]))
