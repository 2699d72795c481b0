"""Decision of a polynomial statement over the real numbers, by z3."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from fractions import Fraction
from typing import Any

from ...graphs import InputError
from ..check import Check
from ..evidence import Evidence, Level
from .exact import plain

Statement = Callable[..., tuple[Sequence[Any], Any, Any]]
_GRIDS = (1, 2, 4, 10, 100, 2**10, 2**20, 2**40)  # denominators, easiest instance first
_BITS = 400  # with which roots are evaluated


@dataclass(frozen=True)
class Decision(Check):
    """``left <= right`` for all real numbers that satisfy the hypotheses.

    The hypotheses and ``left > right`` go to z3. No solution: proved. A solution: refuted, after
    its numbers are rounded to rational ones, as simple as possible, at which the violation is
    evaluated again without z3, in fractions (or, where a root is irrational, in intervals).

    Parameters
    ----------
    variables : tuple of str
        Names of the real variables.
    statement : callable
        ``statement(*variables, *roots) -> (hypotheses, left, right)``: comparisons that all hold
        and the two sides. Made of ``+ - *``, integer powers, integers and comparisons only, so
        that it runs on z3 terms, fractions and intervals alike; clear denominators of known sign
        by hand. To conclude ``left <= max(p, q)``, suppose ``left > p`` and conclude
        ``left <= q``.
    reason : str
        What was multiplied or substituted to come to this form.
    roots : dict
        Name -> radicand, a function of the variables and of the roots before it. The root is
        nonnegative and its square is the radicand.
    false : tuple of callable
        Statements near this one, of the same variables and roots, that do not hold; at least one.
    strict : bool
        The conclusion is ``left < right``.
    steps : int
        Work that z3 may do at level ``"quick"``, in its own unit, the sixfold at level ``"full"``.
        Work is counted, not timed, so that the answer does not depend on how busy the machine is.

    Raises
    ------
    RuntimeError
        By `run`: if z3 does not decide in time, if the hypotheses contradict each other, or if
        its solution cannot be confirmed.

    Examples
    --------
    ``(1+s)**2 <= 2 (1 + s**2)`` with ``s = sqrt(1+2a)``:

    >>> Decision(
    ...     ("a",),
    ...     lambda a, s: ([a >= 0], (1 + s) ** 2, 2 * (1 + s * s)),
    ...     "s = sqrt(1+2a)",
    ...     roots={"s": lambda a: 1 + 2 * a},
    ...     false=(lambda a, s: ([a >= 0], (1 + s) ** 2, 1 + s * s),),
    ... ).run("quick").verdict
    'proved'
    """

    variables: tuple[str, ...]
    statement: Statement
    reason: str
    roots: Mapping[str, Callable[..., Any]] = field(default_factory=dict)
    false: tuple[Statement, ...] = ()
    strict: bool = False
    steps: int = 10_000_000

    def __post_init__(self) -> None:
        names = [*self.variables, *self.roots]
        if not self.variables or len(set(names)) != len(names) or self.steps < 1:
            raise InputError("a decision needs distinct variables, and steps >= 1")

    def run(self, level: Level) -> Evidence:
        """Ask z3 for a violation."""
        import z3

        steps = self.steps * (1 if level == "quick" else 6)
        context = z3.Context()  # of its own: the answer does not depend on what was asked before
        solver = z3.SolverFor("QF_NRA", ctx=context)
        solver.set("rlimit", steps)
        free = [z3.Real(name, context) for name in self.variables]
        terms = list(free)
        for name, radicand in self.roots.items():
            root = z3.Real(name, context)
            solver.add(root >= 0, root * root == radicand(*terms))
            terms.append(root)
        hypotheses, left, right = self.statement(*terms)
        solver.add(*(z3.BoolVal(h, context) if isinstance(h, bool) else h for h in hypotheses))
        if solver.check() == z3.unsat:
            raise RuntimeError(f"the hypotheses contradict each other ({self.reason})")
        solver.add(left >= right if self.strict else left > right)
        answer = solver.check()
        if answer == z3.unknown:
            raise RuntimeError(
                f"z3 does not decide within {steps} steps: {solver.reason_unknown()} "
                f"({self.reason}); clear denominators, or give it more steps"
            )
        if answer == z3.sat:
            model = solver.model()
            return self._refutation(
                [_fraction(model.eval(term, model_completion=True)) for term in free]
            )
        return Evidence(
            "proved",
            "decision",
            f"{self.reason}: z3 finds that the hypotheses and the negated conclusion have no "
            "common real solution.",
            details={"smt2": solver.to_smt2()},
        )

    def mutants(self) -> tuple[Check, ...]:
        """Return the decisions of the false statements."""
        return tuple(
            Decision(
                self.variables,
                statement,
                f"mutant of: {self.reason}",
                self.roots,
                (),
                self.strict,
                self.steps,
            )
            for statement in self.false
        )

    def _refutation(self, found: list[Fraction]) -> Evidence:
        """Confirm a solution of z3, at a simple rational point near it if there is one."""
        for point in _nearby(found):
            sides = self._violated(point)
            if sides is not None:
                instance = dict(zip(self.variables, point, strict=True))
                return Evidence(
                    "refuted",
                    "decision",
                    f"{self.reason}: z3 finds a solution of the hypotheses and the negated "
                    "conclusion; rounded to these numbers it is confirmed exactly.",
                    plain(instance),
                    float(sides[0]),
                    float(sides[1]),
                )
        raise RuntimeError(f"a solution of z3 is not confirmed: {found} ({self.reason})")

    def _violated(self, point: Sequence[Fraction]) -> tuple[Any, Any] | None:
        """Return the two sides at a point that certainly violates the statement, else None."""
        from flint import ctx

        with ctx.workprec(_BITS):
            values: list[Any] = list(point)
            for radicand in self.roots.values():
                root = _root(radicand(*values))
                if root is None:
                    return None
                if not isinstance(root, Fraction):
                    values = [_ball(value) for value in values]
                values.append(root if isinstance(values[0], Fraction) else _ball(root))
            hypotheses, left, right = self.statement(*values)
            wrong = left >= right if self.strict else left > right
            return (left, right) if wrong and all(bool(h) for h in hypotheses) else None


def _nearby(point: list[Fraction]) -> Iterator[list[Fraction]]:
    for grid in _GRIDS:
        yield [Fraction(round(x * grid), grid) for x in point]
    yield point


def _fraction(value: Any) -> Fraction:
    """Return a rational number equal to a value of a model, or within 1e-30 of it."""
    import z3

    rational = value.approx(30) if z3.is_algebraic_value(value) else value
    return Fraction(rational.numerator_as_long(), rational.denominator_as_long())


def _ball(value: Any) -> Any:
    from flint import arb, fmpq

    if isinstance(value, int | Fraction):
        return arb(fmpq(value.numerator, value.denominator))
    return value


def _root(radicand: Any) -> Any:
    """Return the nonnegative root: a fraction, else an interval, else None."""
    from math import isqrt

    if not isinstance(radicand, int | Fraction):
        return radicand.sqrt() if radicand >= 0 else None
    if radicand < 0:
        return None
    top, bottom = isqrt(radicand.numerator), isqrt(radicand.denominator)
    if (top * top, bottom * bottom) == (radicand.numerator, radicand.denominator):
        return Fraction(top, bottom)
    return _ball(radicand).sqrt()
