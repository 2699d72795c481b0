"""Proved statements, as they are printed, tried at random in extended precision.

The checks of a claim are about a polynomial form of it; here the statement itself is evaluated, in
formulas of this file's own. Every function returns the least slack of a draw; equalities return
minus the defect.
"""

import pytest
from mpmath import chebyt, factorial, inf, loggamma, mpf, nsum, pi, rf, sqrt
from mpmath import e as euler
from mpmath import log as ln

from nearsight.verify import catalogue

from .statements import g, least, marker, share, wide

KEYS = {claim.key for claim in catalogue()}
TRIED = {}
of = marker(TRIED)
MAIN = "sec:main:perturb#b1b2-choice"
BAND, GLOBAL = "thm:graph-induced-band-mat-inverse", "thm:global-exp-decay"


@of(MAIN, f"{MAIN}[a]")
def _(r):
    D, l_S = r.randint(1, 30), wide(r)
    b_1, b_2 = 2 * D - 1, 4 * D * D - 2 * D
    a, other = 1 / (1 - mpf(1 + b_1) / (1 + b_1 + b_2) * D), 1 / (1 - mpf(D) / (1 + b_1))
    return -max(
        abs(a - 2),
        abs(other - 2),
        abs(D * (b_1 + b_2) / 4 * l_S / (D**3 * l_S) - 1 + mpf(1) / (4 * D * D)),
    )


@of(f"{MAIN}[b]")
def _(r):
    D = r.randint(1, 30)
    total = 1 + D * mpf(1) / (2 * D) / (1 - (D - 1) * mpf(1) / (2 * D))
    return min(1 + mpf(D) / (D + 1) - total, 2 - total)


@of(f"{MAIN}[c]")
def _(r):
    p, z = r.randint(0, 4), share(r, 0, 0.9)
    total = nsum(lambda q: z**q * rf(q + 1, p), [0, inf])
    return factorial(p) / (1 - z) ** (p + 1) - total


@of("sec:main:perturb#tight-scaling", "sec:main:perturb#rates[a]", "sec:main:perturb#rates[b]")
def _(r):
    y = wide(r)
    return min(g(y) - (y / 4) / (1 + y / 2), y / 4 - g(y)) / y


@of("sec:main:perturb#rates[c]", "thm:networked-exp-decay[b]")
def _(r):
    a, x = wide(r), wide(r)
    return min(g(2 * a + x) - g(2 * a), g(2 * a + x) - g(x), 1 - g(2 * a + x))


@of(f"{BAND}[b]")
def _(r):
    kappa = 1 + wide(r)
    return 2 - (1 + sqrt(kappa)) ** 2 / (2 * kappa)


@of(f"{BAND}[c]", f"{BAND}[f]")
def _(r):
    kappa, n = 1 + wide(r, -3, 3), r.randint(0, 12)
    rate = (sqrt(kappa) - 1) / (sqrt(kappa) + 1)
    both = chebyt(n, (kappa + 1) / (kappa - 1)), (rate**n + rate**-n) / 2
    return -abs(both[0] / both[1] - 1)


@of(f"{BAND}[e]")
def _(r):
    kappa = 1 + wide(r, -3, 6)  # the corner of the inverse of [[1+k, 1-k], [1-k, 1+k]]/2
    rate = (sqrt(kappa) - 1) / (sqrt(kappa) + 1)
    return -abs((kappa - 1) / (2 * kappa) / ((1 + sqrt(kappa)) ** 2 / (2 * kappa) * rate) - 1)


@of("coro:CR-LPC[polynomial]")
def _(r):
    a, x = wide(r), wide(r)
    return min((x + a - 2 * sqrt(x * a)) / (x + a), 2 + a - 1 / (1 - sqrt(g(2 * a))))


@of("coro:CR-LPC:e1")
def _(r):
    A, B, p, q = wide(r), wide(r), share(r), share(r)
    eta = p + q
    left = eta + (1 + 1 / eta) * 16 * (A * p**2 + B * q**2)
    return 1 - left / ((1 + 32 * A) * p + (1 + 32 * B) * q) + mpf(10) ** -40


@of("thm:per-step-err[O]")
def _(r):
    a, x = wide(r), wide(r)
    return 1 - 4 * x * a / g(2 * a) / (8 * x * (1 + a))


@of("sec:main:CR#iota[repaired]")
def _(r):
    z, n = share(r, 0, 0.999), r.randint(0, 400)
    return 1 / (1 - z) ** 2 - (n * z**n) ** 2


@of("sec:main:CR#degree", "sec:main:CR#degree[tight]")
def _(r):
    D = r.randint(1, 20)
    one = sqrt(g(4 * mpf(D) ** -8 * share(r)))
    return min(mpf(D) ** -4 - one, mpf(D) ** -4 - 4 * D**2 * g(mpf(D) ** -6 * share(r)))


@of("sec:main:CR#grid")
def _(r):
    m, radius = r.randint(1, 3), r.randint(0, 4)
    count = [int(q == 0) for q in range(radius + 1)]  # dimension 0
    for _ in range(m):
        count = [sum(count[q - abs(j)] for j in range(-q, q + 1)) for q in range(radius + 1)]
    return 2 * (2 * radius + 1) ** (m - 1) - count[radius]


@of("coro:pure-exp-decay:e1", "coro:pure-exp-decay:e1[chain]", "coro:pure-exp-decay[conditions]")
def _(r):
    D = r.randint(1, 20)
    l_S = mpf(D) ** -7 * share(r)
    rho, top = 4 * D * D * g(D * l_S), 2 * D**3 * sqrt((sqrt(1 + mpf(D) ** -6) - 1) / 2)
    return min(1 - D**4 * rho, top - D**2 * sqrt(rho), 1 - top, 1 - D * l_S * (4 * D * D - 1) / 4)


@of("coro:pure-exp-decay:e2", "coro:pure-exp-decay[h]")
def _(r):
    D, n = r.randint(1, 20), r.randint(0, 30)
    rho = 4 * D * D * g(mpf(D) ** -6 * share(r, 0.01, 1))
    first = sum((D * rho) ** q for q in range(n + 1))
    second = sum((sqrt(rho) / D) ** q for q in range(n + 1))
    ends = D / (D - sqrt(rho)) - second, rho ** (mpf(n) / 2) - D ** (2 * n) * rho**n
    return min(second - first, *ends) + mpf(10) ** -40


@of("le:final-step[i]", "le:final-step[j]")
def _(r):
    n = r.randint(1, 10**6)
    rest = loggamma(n + 1) - ln(sqrt(2 * pi * n)) - n * ln(n / euler)
    return min(mpf(1) / (12 * n) - rest, rest - mpf(1) / (12 * n + 1))


@of(f"{GLOBAL}[d]", f"{GLOBAL}[e]", f"{GLOBAL}[f]")
def _(r):
    sharp = lambda a: a / (2 * g(2 * a) * sqrt(1 + a))  # noqa: E731
    above, below = mpf("0.611") + wide(r, -9), mpf("0.6109") * wide(r, -9, 0)
    return min(2 * above - sharp(above), sharp(below) / below - 2, 1 - 1 / sqrt(1 + above))


@pytest.mark.parametrize("key", TRIED)
def test_the_statement_itself(key):
    assert key in KEYS
    assert least(key, TRIED[key]) > -(mpf(10) ** -35)
