r"""The sharp competitive ratio: per-step error (E3), cost gap and closing (E5).

With ``D`` the l2 size of ``x* - theta`` and ``y`` that of ``x - x*`` (over all steps
and vertices), every bound here is a linear form ``D_part D + y_part y``; the cost gap
over mu is at least ``y^2/2`` and at most a product of such forms. That closes on y,
and with (E4), ``OPT >= (mu/2)(1 + 1/(2a+x)) D^2``, on the competitive ratio.

Kinds
-----
``smooth``
    ``(Lam/2) E^2``, ``Lam = l_f/mu + x + 2a``; feasible sets all of R^n.
``mix``
    ``G E_top - E_top^2/2 + G E_lat + (Lam/2) E_lat^2``; feasible sets all of R^n.
``vi``
    ``dG E - E^2/2``, or ``dG^2/2``; any closed convex product sets, and no ``l_f``.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from .arithmetic import Number, approximate, minimum, power, select, sqrt
from .decay import slice_decay, slice_first
from .energy import NEIGHBOURS, NEXT, OWN, Couplings, Row, best_share, float_count, row_bound
from .forms import Form, Gap
from .formula import plain_floats
from .global_bound import accumulation_sharp

KINDS = ("smooth", "mix", "vi")


class Shares(NamedTuple):
    """The shares of `energy.row_bound`, one for each row."""

    own: Any
    next: Any
    neighbours: Any


class StepError(NamedTuple):
    """(E3): the error of one step of LPC, ``E = E_top + E_lat``, and its companions."""

    Z: Form
    E_top: Form
    E_lat: Form
    E_next: Form
    E_nbr: Form


def best_shares(kind: str, c: Couplings, eta: Number, k: Any, r: Any) -> Shares:
    """Return for each row the share with the least coefficient of D, found in floats.

    Only ``vi`` uses other rows than an agent's own; for the rest they are left at 1.
    """
    c, eta = Couplings(*(approximate(v) for v in c)), float_count(eta)
    with plain_floats():
        own = best_share(OWN, c, eta, k, r)
        if kind != "vi":
            return Shares(own, 1, 1)
        after = best_share(NEXT, c, eta, np.maximum(k, 3), r)
        return Shares(own, after, best_share(NEIGHBOURS, c, eta, k, np.maximum(r, 2)))


def step_error(c: Couplings, eta: Number, k: Any, r: Any, shares: Shares) -> StepError:
    """Return the forms of (E3) for horizon k and radius r.

    Raises
    ------
    ValueError
        If some ``k < 2`` or ``r < 1`` (LPC then has no free variable).
    """
    if np.any(np.less(k, 2)) or np.any(np.less(r, 1)):
        raise ValueError("LPC does something only for k >= 2 and r >= 1")
    one = 1 + 0 * c.a_T
    Z = Form(one, slice_decay(c.a_T, k))
    s_top = slice_decay(c.a_T, np.asarray(k) - 1)

    def lateral(row: Row, share: Any, horizon: Any, radius: Any) -> Form:
        bound = row_bound(row, c, eta, horizon, radius, share)
        return Form(bound.D_part + bound.Z_part, bound.y_part + bound.Z_part * Z.y)

    across = Z.times(s_top).plus(Form(one, slice_first(c.a_T)))  # what a neighbour may be off
    nbr = lateral(NEIGHBOURS, shares.neighbours, k, np.maximum(r, 2))
    direct = across.times(sqrt(c.max_degree * one))  # r = 1: a neighbour is fixed at theta
    E_next = lateral(NEXT, shares.next, np.maximum(k, 3), r)
    present, far = np.greater_equal(k, 3), np.greater_equal(r, 2)
    return StepError(
        Z,
        Z.times(s_top),
        lateral(OWN, shares.own, k, r),
        Form(*(select(present, v, 0 * v) for v in E_next)),
        Form(*(select(far, v, w) for v, w in zip(nbr, direct, strict=True))),
    )


def cost_gap(kind: str, c: Couplings, k: Any, e: StepError) -> Gap:
    """Return the bound on ``(cost(LPC) - OPT)/mu``, one of `KINDS`.

    Raises
    ------
    ValueError
        If the kind is not one of `KINDS`.
    """
    E = e.E_top.plus(e.E_lat)
    Lam = c.condition + c.x + 2 * c.a_T
    if kind == "smooth":
        square = Gap.product(E, E)
        return Gap(*(Lam / 2 * p for p in square))
    slope = c.a_T / 2 * slice_decay(c.a_T, np.asarray(k) - 2)
    s_top = slice_decay(c.a_T, np.asarray(k) - 1)
    if kind == "mix":
        # E_top <= G always: s_{k-1} <= (a/2) s_{k-2}, since gamma_T <= a/2 and s_1 <= a/2
        G = e.Z.plus(e.E_top.times(s_top)).times(slope)
        gap = Gap.product(G, e.E_top).plus(Gap.product(e.E_top, e.E_top), -_half(c))
        return gap.plus(Gap.product(G, e.E_lat)).plus(Gap.product(e.E_lat, e.E_lat), Lam / 2)
    if kind != "vi":
        raise ValueError(f"kind = {kind!r}: one of {', '.join(KINDS)}")
    return _variational_gap(variational_slope(c, k, e), E, _half(c))


def variational_slope(c: Couplings, k: Any, e: StepError) -> Form:
    """Return ``dG`` of ``vi``: what is left of the gradient of the cost at LPC's action."""
    E = e.E_top.plus(e.E_lat)
    slope = c.a_T / 2 * slice_decay(c.a_T, np.asarray(k) - 2)
    s_top = slice_decay(c.a_T, np.asarray(k) - 1)
    dG = e.Z.plus(E.times(s_top)).times(slope).plus(e.E_lat.times(c.x / 2))
    later = e.E_lat.times(slice_first(c.a_T)).plus(e.E_next).times(c.a_T / 2)
    dG = dG.plus(Form(*(select(np.greater_equal(k, 3), v, 0 * v) for v in later)))
    return dG.plus(e.E_nbr.times(sqrt(c.max_degree * (1 + 0 * c.a_S)) * c.a_S / 2))


def _half(c: Couplings) -> Number:
    return (1 + 0 * c.a_T) / 2


def _variational_gap(dG: Form, E: Form, half: Number) -> Gap:
    """Bound ``dG e - e^2/2`` over ``0 <= e <= E``."""
    inner = Gap.product(dG, E).plus(Gap.product(E, E), -half)
    outer = Gap.product(dG, dG)  # where E exceeds dG the maximum over all e: dG^2/2
    ordered = np.logical_and(E.D <= dG.D, E.y <= dG.y)  # None (undecided) counts as no
    return Gap(*(select(ordered, p, half * q) for p, q in zip(inner, outer, strict=True)))


class Closing(NamedTuple):
    """What must be positive for a bound on y: ``1/2 - P_2`` and ``1 - S E_y``; one is enough.

    The first closes ``(1/2 - P_2) y^2 <= P_1 y + P_0``. The second closes
    ``y <= S (E_D + E_y y)``, ``S = 1 + s_1/(1 - gamma_T)``: the errors of past steps add
    up to at most S times their size.
    """

    by_gap: Number
    by_errors: Number


def closing(c: Couplings, gap: Gap, e: StepError) -> Closing:
    """Return the two margins of a certificate."""
    one = 1 + 0 * (c.a_T + c.a_S)
    E_y = e.E_top.y + e.E_lat.y
    return Closing(one / 2 - gap.P_2, one - accumulation_sharp(c.a_T) * E_y)


def excess_ratio(c: Couplings, gap: Gap, e: StepError) -> Number:
    """Return the bound on ``CR - 1``, infinite where the certificate does not close.

    The gap grows with y, so the smaller of the two bounds on y of `Closing` is put into
    it: the positive root of the first, ``S E_D/(1 - S E_y)`` from the second.
    """
    one = 1 + 0 * (c.a_T + c.a_S)
    margins = closing(c, gap, e)
    by_gap, by_errors = (m > 0 for m in margins)
    rest, left = (select(m > 0, m, one) for m in margins)
    root = (gap.P_1 + sqrt(power(gap.P_1, 2) + 4 * rest * gap.P_0)) / (2 * rest)
    summed = accumulation_sharp(c.a_T) * (e.E_top.D + e.E_lat.D) / left
    y = minimum(select(by_gap, root, one * np.inf), select(by_errors, summed, one * np.inf))
    coupling = 2 * c.a_T + c.x  # 1/(1 + 1/coupling) = coupling/(1 + coupling), (E4)
    return 2 * gap.at(y) * coupling / (1 + coupling)


def sharp_excess(kind: str, c: Couplings, eta: Number, k: Any, r: Any, shares: Shares) -> Number:
    """Return the sharp bound on ``CR - 1`` for given shares, in any arithmetic.

    Parameters
    ----------
    kind : {"smooth", "mix", "vi"}
        Which bound on the cost gap.
    c : Couplings
        Strengths of the couplings.
    eta : number
        ``eta_r`` of the network at radius r.
    k, r : int or arrays of int
        Horizon and radius.
    shares : Shares
        From `best_shares`, or any on the grid.
    """
    error = step_error(c, eta, k, r, shares)
    return excess_ratio(c, cost_gap(kind, c, k, error), error)
