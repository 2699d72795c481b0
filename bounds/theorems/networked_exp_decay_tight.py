"""``thm:networked-exp-decay-tight``: the local bound for weak couplings."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, ClassVar

import numpy as np

from ..arithmetic import Number, approximate
from ..decay import gamma_S
from ..hypotheses import ASSUMPTION, SLATER
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier, at_least_zero
from ..tight import Choice, choice, one_away, optimise

Objective = Callable[[Choice, float, float, float], Any]


def chosen(s: Setting, objective: Objective | None = None) -> Choice:
    """Return the choice of ``b_1, b_2`` for a setting: the given one, else the optimised one.

    Parameters
    ----------
    objective : callable, optional
        Maps a `Choice` of arrays, ``l_T/mu``, ``l_S/mu`` and ``l_f/mu`` to what is to be
        minimised; by default ``C_1 rho_T rho_S``. For arrays of parameters each entry
        is optimised on its own.
    """
    zero = 0 * s.a_T  # of the arithmetic of the setting
    if s.b is not None:
        return choice(s.growth, s.a_T, s.a_S, s.b[0] + zero, s.b[1] + zero)

    def search(a_T: float, a_S: float, condition: float) -> tuple[float, float]:
        def value(found: Choice) -> Any:
            return objective(found, a_T, a_S, condition) if objective else one_away(found)

        return optimise(s.growth, a_T, a_S, value)

    ratios = (approximate(v) for v in (s.a_T, s.a_S, s.parameters.condition))
    b_1, b_2 = (v[()] for v in np.vectorize(search, otypes=[float, float])(*ratios))
    return choice(s.growth, s.a_T, s.a_S, b_1 + zero, b_2 + zero)


def conditions(found: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
    """Return the hypotheses of the theorem on mu and on the sums."""
    finite = np.isfinite(found["a"]) & np.isfinite(found["a_tilde"])
    return (
        Hypothesis("a and a_tilde are finite", finite[()] if finite.ndim else bool(finite)),
        at_least_zero("8 a_tilde l_T/mu <= 1", found["margin_T"]),
        at_least_zero("Delta l_S (b_1 + b_2)/(4 mu) <= 1", found["margin_S"]),
    )


def choice_values(found: Choice) -> dict[str, Number]:
    """Return ``b_1, b_2``, the sums and the margins of the two conditions."""
    margins = dict(zip(("margin_T", "margin_S"), found.margins, strict=True))
    return {"b_1": found.b_1, "b_2": found.b_2, **found.sums._asdict(), **margins}


class Tight(Bound):
    """As printed; a theorem as it stands (read line by line, no slip found).

    ``b_1, b_2`` are those of the setting, or minimise ``C_1 rho_T rho_S``.
    """

    label = "thm:networked-exp-decay-tight"
    tier: ClassVar[Tier] = "stated"
    title = "local perturbation bound for weak couplings"
    conditional = ("C_1", "C_2", "rho_T", "rho_S", "one_minus_rho_T", "one_minus_rho_S")

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the choice, its sums, ``C_1, C_2, rho_T, rho_S``."""
        found = chosen(s)
        return choice_values(found) | found.local._asdict() | {"gamma_S": gamma_S(s.x)}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's."""
        return (ASSUMPTION, SLATER, *conditions(values))

    def missing(self, s: Setting) -> dict[str, str]:
        """Nothing needs k or r."""
        return {}


BOUNDS: tuple[Bound, ...] = (Tight(),)
