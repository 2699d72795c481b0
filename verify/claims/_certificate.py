"""What LPC is certified to reach, in intervals: refutes lower bounds that are larger."""

from __future__ import annotations

from typing import Any

BITS = 200


def certified(a_T: Any, a_S: Any, degree: int, eta: int, k: int, r: int) -> Any:
    """Return the certificate ``vi`` of nearsight:sharp-cr on ``CR - 1``, an arb.

    It holds for any convex product constraints and any l_f, as a lower bound on every algorithm
    speaks of the whole class.

    Parameters
    ----------
    a_T, a_S : Fraction
    degree : int
    eta : int
        ``eta_r`` of the largest network of the class; without effect for ``a_S = 0``.
    k, r : int
    """
    from flint import arb, ctx, fmpq

    from ...bounds.certificate import best_shares, sharp_excess
    from ...bounds.energy import Couplings

    with ctx.workprec(BITS):
        a, b = (arb(fmpq(v.numerator, v.denominator)) for v in (a_T, a_S))
        c = Couplings(a, b, arb(1), degree)
        shares = best_shares("vi", c, eta, k, r)
        return sharp_excess("vi", c, arb(eta), k, r, shares)
