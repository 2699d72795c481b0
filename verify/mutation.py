"""Is every check able to fail? It is given false statements near the one it checks."""

from __future__ import annotations

from collections.abc import Iterator

from .check import Check
from .claim import Claim
from .engines.exact import Counterexample
from .engines.symbolic import Identity, Nonnegative
from .results import Mutation, Outcome

EXACT = (Counterexample, Identity, Nonnegative)  # their evidence is a computation, not a search


def mutate(claim: Claim) -> tuple[Mutation, ...]:
    """Run all mutants of all checks of a claim, at level ``"quick"``.

    A mutant is rejected if it is refuted, or if its check raises RuntimeError because it finds
    no proof. A check of another kind than `EXACT` without mutants counts as one that cannot fail,
    unless it refutes its claim: a refutation stands on an instance that is checked again.
    """
    return tuple(
        found for i, check in enumerate(claim.checks) for found in _of_check(claim, i, check)
    )


def _of_check(claim: Claim, i: int, check: Check) -> Iterator[Mutation]:
    engine = type(check).__name__
    mutants = tuple(check.mutants())
    for number, mutant in enumerate(mutants):
        yield Mutation(claim.key, i, engine, number, *_outcome(mutant))
    if not mutants and not isinstance(check, EXACT) and _outcome(check)[0] != "refuted":
        text = "it has no false statement to reject"
        yield Mutation(claim.key, i, engine, 0, "missing", text)


def _outcome(check: Check) -> tuple[Outcome, str]:
    try:
        evidence = check.run("quick")
    except RuntimeError as error:
        return "undecided", str(error)
    return ("refuted" if evidence.verdict == "refuted" else "accepted"), evidence.reason
