"""The formulas as the paper and the theory print them, in mpmath with digits to spare.

Written straight from the text, cancellation and all: 500 digits absorb it. Nothing here is
imported from the code under test.
"""

from collections import namedtuple
from functools import wraps

from mpmath import mp, mpf

DIGITS = 500
Local = namedtuple("Local", "C_1 C_2 rho_T rho_S one_minus_rho_T one_minus_rho_S")
Whole = namedtuple("Whole", "C_G rho_G C_0 one_minus_rho_G")


def digits(function):
    """Run with the arguments taken exactly and `DIGITS` digits."""

    @wraps(function)
    def call(*args, dps=DIGITS):
        with mp.workdps(dps):
            return function(*(mpf(a) if isinstance(a, float) else a for a in args))

    return call


# decay -------------------------------------------------------------------------------------


@digits
def g(y):
    return (mp.sqrt(1 + y) - 1) / (mp.sqrt(1 + y) + 1)


@digits
def gamma_T(a):
    return 1 - 2 / (mp.sqrt(1 + 2 * a) + 1)


@digits
def rho(y):
    return mp.sqrt(1 - 2 / (mp.sqrt(1 + y) + 1))


@digits
def demko(kappa):
    return max(mpf(1), (1 + mp.sqrt(kappa)) ** 2 / (2 * kappa))


@digits
def s(a, d):
    """(E1)."""
    return mpf(1) if d == 0 else a / (2 * mp.sqrt(1 + a)) * g(2 * a) ** (d - 1)


@digits
def over(y, rate):
    """``y/rate(y)``, 0 in the limit of ``y = 0`` when rate is rho; for g see `over_g`."""
    return y / rate if y else mpf(0)


# perturbation bounds -----------------------------------------------------------------------


def _whole(a, C_G):
    return Whole(C_G, gamma_T(a), max(mpf(1), C_G), 2 / (mp.sqrt(1 + 2 * a) + 1))


@digits
def whole(tier, a):
    """``thm:global-exp-decay`` (stated), sections 2 and 4 of the theory."""
    if tier == "stated":
        return _whole(a, 2 * a)
    ratio = a / gamma_T(a) if a else mpf(2)  # a/g(2a) -> 2
    if tier == "repaired":
        return _whole(a, demko(1 + 2 * a) * ratio / 2)
    return _whole(a, ratio / (2 * mp.sqrt(1 + a)))


@digits
def local(tier, a, a_S, Delta):
    """``thm:networked-exp-decay``."""
    x = Delta * a_S
    rho_T, rho_S = rho(2 * a), rho(x)
    if tier == "stated":
        C_1 = C_2 = 2 * mp.sqrt(Delta * a_S * a)
    else:
        c2 = mp.sqrt(demko(1 + 2 * a) * demko(1 + x))
        in_time = over(a, rho_T)
        in_space = mp.sqrt(Delta) * over(a_S, rho_S) if x else mpf(0)
        C_1, C_2 = c2 / 2 * max(in_time, in_space), c2 * in_time / 2
    return Local(C_1, C_2, rho_T, rho_S, 1 - rho_T, 1 - rho_S)


@digits
def local_tight(a_T, a_S, Delta, b_1, b_2, a, a_tilde):
    """``thm:networked-exp-decay-tight``."""
    x = Delta * a_S
    gamma_S = g(x)
    rho_T, rho_S = 4 * a_tilde * a_T, (1 + b_1 + b_2) * gamma_S
    ratio = x / gamma_S if x else mpf(4)  # x/g(x) -> 4
    C = max(
        a**2 / (2 * a_tilde * (1 - 4 * a_tilde * a_T)),
        2 * a**2 * ratio / ((1 + b_1 + b_2) * (1 - 4 * a_tilde * a_T)),
    )
    return Local(C, C, rho_T, rho_S, 1 - rho_T, 1 - rho_S)


SERIES = {  # sum_q h(q) z^q
    "line": lambda z: (1 + z) / (1 - z),
    "grid2": lambda z: 1 + 4 * z / (1 - z) ** 2,
    "tree:3": lambda z: 1 + 3 * z / (1 - 2 * z) if z < mpf(1) / 2 else mp.inf,
    "ring-of-blocks:2": lambda z: 1 + 4 * z + 5 * z**2 + 4 * z**3 / (1 - z),
    "poly:3,2": lambda z: 1 + 3 * z * (1 + z) / (1 - z) ** 3,
}


@digits
def sums(spec, b_1, b_2):
    series = SERIES[spec]
    return series((1 + b_1) / (1 + b_1 + b_2)), series(1 / (1 + b_1))


# the paper's competitive ratio -------------------------------------------------------------


@digits
def C_3(h, rho_S):
    """``h`` lists h(0), ..., h(r)."""
    return mp.fsum(n * rho_S**q for q, n in enumerate(h))


def _history(lo, wh, h, k):
    r = len(h) - 1
    return h[r] ** 2 * wh.rho_G**2 / ((1 - lo.rho_T) * (1 - wh.rho_G**2 * lo.rho_T)) * (
        lo.rho_S ** (2 * r)
    ) + C_3(h, lo.rho_S) ** 2 * lo.rho_T ** (2 * (k - 1)) * wh.rho_G ** (2 * k)


@digits
def per_step(lo, wh, h, k):
    """(thm:per-step-err:e0): history, lateral, top."""
    r = len(h) - 1
    return (
        4 * lo.C_1**2 * wh.C_0**2 * _history(lo, wh, h, k),
        8 * lo.C_1**2 * h[r] ** 2 / (1 - lo.rho_T) * lo.rho_S ** (2 * r),
        8 * lo.C_1**2 * C_3(h, lo.rho_S) ** 2 * lo.rho_T ** (2 * (k - 1)),
    )


@digits
def ratio(lo, wh, weight, h, k):
    """(coro:CR-LPC:e1) and (e2-0): lateral, top, condition; weight = (l_f + D l_S + 2 l_T)/mu."""
    r = len(h) - 1
    big = 32 * wh.C_0**2 * lo.C_1**2 * weight
    lateral = 1 + big * h[r] ** 2 / ((1 - wh.rho_G) ** 2 * (1 - lo.rho_T) ** 2)
    top = 1 + big * C_3(h, lo.rho_S) ** 2 / (1 - wh.rho_G) ** 2
    condition = 4 * lo.C_1**2 * wh.C_0**4 / (1 - wh.rho_G) ** 2 * _history(lo, wh, h, k)
    return lateral * lo.rho_S**r, top * lo.rho_T ** (k - 1), condition


@digits
def pure_ratio(lo, wh, weight, Delta, k, r):
    """The two parts of the last display of the appendix on ``coro:pure-exp-decay``."""
    big = 32 * wh.C_0**2 * lo.C_1**2 * weight
    lateral = 1 + big / ((1 - wh.rho_G) ** 2 * (1 - lo.rho_T) ** 2)
    top = 1 + big * Delta**2 / ((1 - wh.rho_G) ** 2 * (Delta - mp.sqrt(lo.rho_S)) ** 2)
    return lateral * lo.rho_S ** (mpf(r) / 2), top * lo.rho_T ** (k - 1)
