"""The free parameters ``b_1, b_2`` of ``thm:networked-exp-decay-tight`` and its sums."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from ..graphs.growth import Growth
from .arithmetic import Number, kind_of
from .formula import plain_floats
from .local_bound import LocalBound, Sums, local_tight, tight_margins

_GRID = 24  # points an axis of the coarse search; two refinements by the same number


class Choice(NamedTuple):
    """``b_1, b_2`` with their sums and the bound they give."""

    b_1: Number
    b_2: Number
    sums: Sums
    margins: tuple[Number, Number]
    local: LocalBound


def sums(growth: Growth, b_1: Number, b_2: Number) -> Sums:
    r"""Return ``a = sum_q ((1+b_1)/(1+b_1+b_2))^q h(q)``, ``a_tilde = sum_q (1+b_1)^{-q} h(q)``.

    Exact polynomials for finite graphs, closed forms for infinite families; infinite
    where a series diverges.
    """
    ratios = ((1 + b_1) / (1 + b_1 + b_2), 1 / (1 + b_1))
    if kind_of(b_1, b_2) == "wide":
        return Sums(*(z.map(growth.transform) for z in ratios))
    return Sums(*(growth.transform(z) for z in ratios))


def choice(
    growth: Growth,
    a_T: Number,
    a_S: Number,
    b_1: Number,
    b_2: Number,
    total: Sums | None = None,
) -> Choice:
    """Return sums, margins and bound for given ``b_1, b_2``, in their arithmetic."""
    total = total or sums(growth, b_1, b_2)
    x = growth.max_degree * a_S
    margins = tight_margins(a_T, x, b_1, b_2, total.a_tilde)
    local = local_tight(a_T, a_S, growth.max_degree, b_1, b_2, *total)
    return Choice(b_1, b_2, total, margins, local)


def paper_choice(max_degree: int) -> tuple[float, float]:
    """Return ``b_1 = 2 Delta - 1, b_2 = 4 Delta^2 - 2 Delta``: ``a, a_tilde <= 2`` on any graph.

    References
    ----------
    Paper, the text below ``thm:networked-exp-decay-tight``.
    """
    degree = max(max_degree, 1)
    return 2.0 * degree - 1.0, 4.0 * degree**2 - 2.0 * degree


def one_away(c: Choice) -> Any:
    """Return ``C_1 rho_T rho_S``, what is promised one step and one hop away."""
    return c.local.C_1 * c.local.rho_T * c.local.rho_S


def optimise(
    growth: Growth, a_T: float, a_S: float, objective: Callable[[Choice], Any] = one_away
) -> tuple[float, float]:
    """Return ``(b_1, b_2)`` with the least objective among those that obey the conditions.

    A logarithmic grid over ``b_1`` and ``u = b_2/(1+b_1)``, on which the two sums depend
    one each, refined twice around its best point; any point gives a valid bound. Where
    no point obeys the conditions, `paper_choice`.

    Parameters
    ----------
    growth : Growth
        The network's.
    a_T, a_S : float
        ``l_T/mu`` and ``l_S/mu``.
    objective : callable
        Maps a `Choice` of arrays to the array to minimise.
    """
    start = paper_choice(growth.max_degree)
    if 8 * a_T > 1:  # a_tilde >= 1: no choice obeys the conditions, the network is not asked
        return start
    x = growth.max_degree * a_S
    ceiling = min(4.0 / x if x > 0 else np.inf, 1e6 * start[1])
    low, high = np.log([ceiling * 1e-8] * 2), np.log([ceiling] * 2)
    best, best_value = start, np.inf
    for _ in range(3):
        b_1, u = (np.exp(np.linspace(low[i], high[i], _GRID)) for i in (0, 1))
        with plain_floats():
            total = Sums(growth.transform(1 / (1 + u)), growth.transform(1 / (1 + b_1))[:, None])
            b_2 = u * (1 + b_1[:, None])
            found = choice(growth, a_T, a_S, b_1[:, None], b_2, total)
            value = np.broadcast_to(objective(found), b_2.shape)
        good = (found.margins[0] >= 0) & (found.margins[1] >= 0)
        good &= np.isfinite(total.a) & np.isfinite(value)
        if not good.any():
            break
        i, j = np.unravel_index(np.argmin(np.where(good, value, np.inf)), b_2.shape)
        if value[i, j] < best_value:
            best, best_value = (float(b_1[i]), float(b_2[i, j])), float(value[i, j])
        centre, step = np.log([b_1[i], u[j]]), (high - low) / (_GRID - 1)
        low, high = centre - step, np.minimum(centre + step, np.log(ceiling))
    return best
