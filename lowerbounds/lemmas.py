"""The two technical lemmas behind the second claim on the ring of blocks."""

from __future__ import annotations

from math import comb
from typing import Any

from ..bounds.arithmetic import Number
from ..graphs import InputError
from .claimed import Claimed

DIGITS = 50


def central_binomial(m: int, n: int) -> Claimed:
    r"""Return ``binom((2+eps) m, m)``, ``n = eps m``, and the bound of the lemma.

    .. math:: \binom{2m+n}{m} > \frac{1}{\sqrt{2\pi m}}
        \frac{(2+\varepsilon)^{(2+\varepsilon)m + 1/2}}{(1+\varepsilon)^{(1+\varepsilon)m + 1/2}}
        e^{-1/(6m)}

    Both as mpmath numbers of 50 digits. It holds for all ``m >= 1, n >= 0``, by Robbins' form of
    Stirling's formula.

    References
    ----------
    Paper, ``lemma:combinatorial-number-near-center``.
    """
    from mpmath import mp, mpf

    if m < 1 or n < 0:
        raise InputError(f"m = {m}, n = {n}: integers m >= 1 and n >= 0 are needed", "m")
    with mp.workdps(DIGITS):
        eps, half = mpf(n) / m, mpf(1) / 2
        log = (2 * m + n + half) * mp.log(2 + eps) - (m + n + half) * mp.log(1 + eps)
        claimed = mp.exp(log - mpf(1) / (6 * m)) / mp.sqrt(2 * mp.pi * m)
        label = "lemma:combinatorial-number-near-center"
        return Claimed(label, "", "stated", mpf(comb(2 * m + n, m)), claimed)


def entropy(eps: Any) -> Claimed:
    r"""Return ``(2+eps)/(2 (1+eps)^{(1+eps)/(2+eps)})`` and ``1 - eps^2/2``.

    The claim is made, and true, for ``0 <= eps < sqrt(2)``; ``1 - eps^2/8 + eps^3/8 - ...`` is
    the truth. Both as mpmath numbers of 50 digits.

    References
    ----------
    Paper, ``lemma:numerical-lower-bound``.
    """
    from mpmath import mp, mpf

    with mp.workdps(DIGITS):
        e = mpf(eps)
        exact: Number = (2 + e) / (2 * mp.power(1 + e, (1 + e) / (2 + e)))
        claimed = 1 - e**2 / 2
        inside = bool(e >= 0 and e**2 < 2)
        return Claimed("lemma:numerical-lower-bound", "", "stated", exact, claimed, inside)
