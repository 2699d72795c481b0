"""A theorem is an object: label, tier, hypotheses with margins, values."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, ClassVar, Literal

import numpy as np

from ..graphs.errors import InputError
from .arithmetic import Number, kind_of, one_plus
from .formula import rounded_once
from .setting import Setting

Tier = Literal["stated", "repaired", "sharp"]
Kind = Literal["upper", "lower", "exact"]


@dataclass(frozen=True)
class Hypothesis:
    """One hypothesis of a theorem.

    Attributes
    ----------
    text : str
        What must hold.
    holds : bool, array of bool or None
        None: not decidable from the setting; the user answers for it.
    margin : float, array or None
        By how much it holds (negative: fails), in the units of the text.
    masks : bool or tuple of str
        Which conditional values of the theorem need it: all, none, or those named. The
        guarantee needs every hypothesis.
    """

    text: str
    holds: Any = None
    margin: Any = None
    masks: bool | tuple[str, ...] = True

    def covers(self, name: str) -> bool:
        """Whether a conditional value needs this hypothesis."""
        return self.masks if isinstance(self.masks, bool) else name in self.masks

    @property
    def fails(self) -> bool:
        """Whether it is known to fail (for arrays: somewhere)."""
        return self.holds is not None and not bool(np.all(self.holds))


def margin_of(s: Setting, function: Callable[[Setting], Number]) -> Any:
    """Return a margin computed wide and rounded once: its sign is right."""
    return rounded_once(function, s.converted("wide"))


def at_least_zero(text: str, margin: Any, *, masks: bool | tuple[str, ...] = True) -> Hypothesis:
    """Return the hypothesis that a margin is ``>= 0``."""
    holds = np.greater_equal(margin, 0)
    return Hypothesis(text, bool(holds) if np.ndim(holds) == 0 else holds, margin, masks)


def once(found: Sequence[Hypothesis], then: Hypothesis) -> Hypothesis:
    """Return a hypothesis that means something only where the others hold."""
    if not any(h.fails for h in found):
        return then
    if all(np.ndim(h.holds) == 0 for h in (*found, then)):
        return Hypothesis(f"{then.text} (not evaluated: see above)", None, None, then.masks)
    good = np.logical_and.reduce([np.asarray(h.holds) for h in found if h.holds is not None])
    return Hypothesis(then.text, good & then.holds, np.where(good, then.margin, np.nan), then.masks)


def above_zero(text: str, margin: Any) -> Hypothesis:
    """Return the hypothesis that a margin is ``> 0``; an undefined one fails."""
    holds = np.greater(margin, 0)
    return Hypothesis(text, bool(holds) if np.ndim(holds) == 0 else holds, margin)


@dataclass(frozen=True)
class Result:
    """What a theorem says in a setting.

    Attributes
    ----------
    label, tier, kind, variant : str
        Which statement; ``kind`` is "upper", "lower" or "exact".
    guarantee : bool
        True only if the statement is known to be true here: every hypothesis that can be
        decided holds, and the statement is a theorem as written (or is implied by one).
    hypotheses : tuple of Hypothesis
        Each with its margin.
    values : mapping from str to number, array or None
        None where the statement gives no number; `reasons` says why.
    reasons : mapping from str to str
        Why a value is None.
    """

    label: str
    tier: Tier
    kind: Kind
    guarantee: bool
    hypotheses: tuple[Hypothesis, ...]
    values: Mapping[str, Any]
    reasons: Mapping[str, str] = field(default_factory=dict)
    variant: str = ""


class Bound(ABC):
    """One theorem in one tier. Subclass it in a file of `bounds.theorems` to add one.

    Class attributes
    ----------------
    label : the LaTeX label of the paper, or ``nearsight:...``
    tier, kind : see `Result`
    variant : tells apart statements of one label and tier
    title : one line for tables
    sound : whether the statement is a theorem as written
    conditional : names of values that are no numbers where a hypothesis fails
    """

    label: ClassVar[str]
    tier: ClassVar[Tier]
    kind: ClassVar[Kind] = "upper"
    variant: ClassVar[str] = ""
    title: ClassVar[str]
    sound: ClassVar[bool] = True
    conditional: ClassVar[tuple[str, ...]] = ()

    @abstractmethod
    def values(self, s: Setting) -> dict[str, Number]:
        """Return the values in the arithmetic of the setting."""

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the hypotheses; ``values`` are those of `values`, rounded."""
        return ()

    def evaluate(self, s: Setting) -> Result:
        """Return what the theorem says, in floats, each correctly computed and rounded once.

        Raises
        ------
        InputError
            If the parameters are not floats: `values` serves the other arithmetics.
        """
        p = s.parameters
        if kind_of(p.mu, p.l_f, p.l_T, p.l_S) != "float":
            raise InputError("evaluate takes floats; for other arithmetics call values(setting)")
        values = {name: v for name, v in self.in_floats(s).items() if v is not None}
        if "cr" in values:
            values["cr"] = one_plus(values["cr_minus_one"], up=self.kind != "lower")
        hypotheses = self.hypotheses(s, values)
        guarantee = self.sound and not any(h.fails for h in hypotheses)
        reasons = {n: why for n, why in self.missing(s).items() if n not in values}
        for name in self.conditional:
            for h in hypotheses:
                if values.get(name) is not None and h.fails and h.covers(name):
                    values[name] = _masked(values[name], h.holds)
                    reasons[name] = f"hypothesis fails: {h.text}"
        for name, value in list(values.items()):
            if isinstance(value, np.generic):
                values[name] = value = value.item()
            if value is not None and np.ndim(value) == 0 and not np.isfinite(value):
                values[name] = None
                too_large = "infinite, or too large for a float"
                reasons.setdefault(name, "undefined" if np.isnan(value) else too_large)
        values.update({name: None for name in reasons if name not in values})
        return Result(
            self.label, self.tier, self.kind, guarantee, hypotheses, values, reasons, self.variant
        )

    def in_floats(self, s: Setting) -> dict[str, Any]:
        """Return `values` for a float setting, computed wide and rounded once."""
        return dict(rounded_once(self.values, s.converted("wide")))

    def missing(self, s: Setting) -> dict[str, str]:
        """Return values that cannot be given in this setting, with the reason."""
        return (
            {}
            if s.sized or not self.conditional
            else dict.fromkeys(self.conditional, "needs a horizon k and a radius r")
        )


def _masked(value: Any, holds: Any) -> Any:
    return None if np.ndim(holds) == 0 else np.where(holds, value, np.nan)
