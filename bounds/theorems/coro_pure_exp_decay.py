"""``coro:pure-exp-decay``: a ratio without ``h`` and ``C_3``, for very weak couplings."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, ClassVar

import numpy as np

from ..arithmetic import Number, power, sqrt
from ..constants import whole_bound
from ..hypotheses import ASSUMPTION, NONNEGATIVE, SLATER, global_implied
from ..local_bound import local_tight
from ..ratio import smoothness
from ..setting import Setting
from ..theorem import Bound, Hypothesis, Tier, at_least_zero, margin_of, once
from ..tight import paper_choice


class Stated(Bound):
    """As printed (its ``l_c`` read as ``l_T``), with the constants of its appendix.

    ``b_1 = 2 Delta - 1, b_2 = 4 Delta^2 - 2 Delta`` and ``a = a_tilde = 2``, an upper
    bound on the sums for every graph of degree Delta. The condition, printed with
    ``O(.)``, is (e2-0) after the same substitutions: ``h(r)^2 rho_S^{2r} <= rho_S^r``
    and ``C_3 <= Delta/(Delta - sqrt(rho_S))``.
    """

    label = "coro:pure-exp-decay"
    tier: ClassVar[Tier] = "stated"
    title = "competitive ratio for very weak couplings, any graph"
    conditional = (
        "cr",
        "cr_minus_one",
        "rho_T",
        "rho_S",
        "C_1",
        "C_3",
        "condition",
        "condition_slack",
    )

    def values(self, s: Setting) -> dict[str, Number]:
        """Return the rates, constants and, for given k and r, the ratio."""
        degree = max(s.max_degree, 1)
        one = 1 + 0 * (s.a_T + s.a_S)
        b_1, b_2 = (b * one for b in paper_choice(degree))
        local = local_tight(s.a_T, s.a_S, s.max_degree, b_1, b_2, 2 * one, 2 * one)
        whole = whole_bound(self.tier, s.a_T)
        C_3 = degree / (degree - sqrt(local.rho_S))
        values = {"b_1": b_1, "b_2": b_2, "a": 2 * one, "a_tilde": 2 * one}
        values |= {"rho_T": local.rho_T, "rho_S": local.rho_S, "rho_G": whole.rho_G}
        values |= {"C_0": whole.C_0, "C_1": local.C_1, "C_3": C_3}
        if not s.sized:
            return values
        scale = power(whole.C_0 * local.C_1 / whole.one_minus_rho_G, 2)
        weight = 32 * scale * smoothness(s.parameters.condition, s.a_T, s.a_S, s.max_degree)
        lateral = (1 + weight / power(local.one_minus_rho_T, 2)) * power(sqrt(local.rho_S), s.r)
        steps = np.asarray(s.k) - 1
        top = (1 + weight * power(C_3, 2)) * power(local.rho_T, steps)
        rho_G2 = power(whole.rho_G, 2)
        side = rho_G2 * power(local.rho_S, s.r) / (1 - rho_G2 * local.rho_T)
        history = side / local.one_minus_rho_T
        history += power(C_3 * power(local.rho_T, steps) * power(whole.rho_G, s.k), 2)
        excess = lateral + top
        condition = 4 * scale * power(whole.C_0, 2) * history
        values |= {"condition": condition, "condition_slack": 0.5 - condition}
        return values | {"cr": 1 + excess, "cr_minus_one": excess}

    def hypotheses(self, s: Setting, values: Mapping[str, Any]) -> tuple[Hypothesis, ...]:
        """Return the paper's, and whether the sharp global bound covers the printed one."""
        degree = max(s.max_degree, 1)
        found = [ASSUMPTION, NONNEGATIVE, SLATER]
        found.append(
            at_least_zero(
                "Delta^7 l_S/mu <= 1",
                margin_of(s, lambda w: 1 - w.a_S * degree**7),
            )
        )
        found.append(at_least_zero("l_T/mu <= 1/16", margin_of(s, lambda w: 0.0625 - w.a_T)))
        if self.tier == "stated":
            found.append(global_implied(s))
        if s.sized:
            slack = values["condition_slack"]
            closes = at_least_zero("condition <= 1/2", slack, masks=("cr", "cr_minus_one"))
            found.append(once([h for h in found if h.masks is True], closes))
        return tuple(found)


class Repaired(Stated):
    """The same with the repaired ``C_G``."""

    tier: ClassVar[Tier] = "repaired"


BOUNDS: tuple[Bound, ...] = (Stated(), Repaired())
