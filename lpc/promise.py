"""What the theory promises of one problem, beside what a simulation measures."""

from __future__ import annotations

from typing import NamedTuple

from ..bounds import Result, Setting, bounds_for
from ..graphs import network_growth
from .checks import check_claims
from .constants import Constants, constants
from .problem import Problem

FURTHEST = 10_000  # steps; a bound at more is hardly better
LABELS = ("nearsight:sharp-cr", "coro:CR-LPC")


class Promise(NamedTuple):
    """Bounds on the competitive ratio at the constants of one problem.

    Parameters
    ----------
    constants : Constants
        Derived from the problem.
    results : tuple of Result
        The competitive ratios of the paper and of this project, in all tiers.
    cr_minus_one : float or None
        The least of those that are guarantees, minus 1; None if there is none.
    reason : str or None
        Why there is none.
    """

    constants: Constants
    results: tuple[Result, ...]
    cr_minus_one: float | None
    reason: str | None


def promise(problem: Problem, k: int, r: int) -> Promise:
    """Return the guarantees that hold for LPC with k and r on this problem.

    The constants are derived from the problem, raised or lowered by what rounding may hide. What
    the author of a cost claims, and that it is nonnegative, is tested at random points first.

    Raises
    ------
    InputError
        If a claim about a cost is refuted.
    """
    found = constants(problem)
    if not problem.quadratic:  # a quadratic cost is nonnegative by its form, nothing is claimed
        check_claims(problem)
    if k < 2 or r < 1:
        return Promise(found, (), None, "at k = 1 or r = 0 nothing is free: no theorem")
    # LPC is the same for all k > H, and for all r at which everybody sees all of its component
    k, r = min(k, max(problem.H + 1, FURTHEST)), min(r, problem.N)
    setting = Setting(
        found.parameters(), network_growth(problem.network), k, r, problem.feasible.everywhere
    )
    results = tuple(bound.evaluate(setting) for label in LABELS for bound in bounds_for(label))
    values = [
        float(result.values["cr_minus_one"])
        for result in results
        if result.guarantee and result.values.get("cr_minus_one") is not None
    ]
    if values:
        return Promise(found, results, min(values), None)
    failing = [
        h.text for result in results if result.tier == "sharp" for h in result.hypotheses if h.fails
    ]
    reason = failing[-1] if failing else "no theorem speaks to this k and r"
    return Promise(found, results, None, f"fails: {reason}" if failing else reason)
