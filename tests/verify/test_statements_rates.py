"""Proved statements about rates and lower bounds, tried at random: see `test_statements`."""

import pytest
from mpmath import binomial, exp, floor, mpf, pi, sqrt
from mpmath import log as ln

from nearsight.verify import catalogue

from .statements import g, least, marker, share, wide

KEYS = {claim.key for claim in catalogue()}
TRIED = {}
of = marker(TRIED)
RING, WALK = "lemma:inverse-graph-lower-bound", "equ:graph-Laplacian-inverse"


@of(f"{RING}[repaired]", f"{RING}[strong]")
def _(r):
    d, kappa = r.randint(1, 6), r.randint(3, 40)
    weak, strong = wide(r), mpf(16) / d + wide(r, -6)
    entry = lambda z: g(4 * d * z) ** kappa / (d * sqrt(1 + 4 * d * z))  # noqa: E731
    first = (d * weak / (2 * d * weak + 1)) ** kappa / (d * d * (2 * d * weak + 1))
    t = sqrt(d * strong)
    second = (1 - 4 / t) ** kappa / (4 * sqrt(pi * kappa * t) * d * d * (2 * d * strong + 1))
    return min(1 - first / entry(weak), 1 - second / entry(strong))


@of(f"{WALK}:e3")
def _(r):
    D, eps = wide(r, -5, 6), share(r, 1e-6)
    return 1 - ((1 - eps**2 / 2) * (1 - 1 / (2 * D + 1))) ** (2 / eps + 1) / g(4 * D)


@of(f"{WALK}:e4", f"{WALK}:e4[Bernoulli]", f"{WALK}:e4[eps]")
def _(r):
    D = 16 + wide(r, -6, 6)
    t = sqrt(D)
    eps, p = 1 / floor(2 * t), 4 * t + 1
    start = ((1 - eps**2 / 2) * (1 - 1 / (2 * D + 1))) ** (2 / eps + 1)
    second = (1 - 1 / (2 * D)) ** p * (1 - 1 / (2 * D + 1)) ** p
    third = (1 - p / (2 * D)) * (1 - p / (2 * D + 1))
    return min(start - second, second - third, third - (1 - 4 / t))


@of("thm:networked-exp-decay-tight[b]")
def _(r):
    x = wide(r)
    return 1 - (1 + 4 / x * share(r)) * g(x)


@of("lemma:temporal-upper-and-lower", "lemma:temporal-upper-and-lower[difference]")
def _(r):
    a = wide(r)
    rho, lam, s, w = g(2 * a), g(4 * a) ** 2, sqrt(1 + 2 * a), sqrt(1 + 4 * a)
    defect = abs((lam - rho) / (4 * s * (s - w) / ((s + 1) * (w + 1) ** 2)) - 1)
    return min(1 - rho**2 / lam, 1 - lam / rho, -defect)


def lam_S(x):
    return max(x / (3 + 3 * x), (1 - sqrt(48 / x)) ** 2 if x >= 48 else 0)


SPATIAL = "lemma:spatial-upper-and-lower"


@of(SPATIAL, "thm:spatial_lower_bound:decay_factor", "coro:resource-augmentation[rates]")
def _(r):
    x, D, y = wide(r), r.randint(3, 30), 18 + wide(r, -3)
    proven = lambda z: g(2 * (D // 2) * z / D) ** 2  # noqa: E731
    return min(1 - g(x) ** 16 / lam_S(x), proven(y) - lam_S(y), 1 - g(x) ** 4 / proven(x))


@of(f"{SPATIAL}:e1", f"{SPATIAL}[case 1 lines]", f"{SPATIAL}[case 2]", f"{SPATIAL}[case 3]")
def _(r):
    n, one, two, three = r.randint(1, 60), 224 + wide(r), 1 + 223 * share(r), share(r)
    z, line = share(r) / (2 * n), 1 - 8 / (sqrt(1 + one) + 1)
    first = min(1 - n * z - (1 - z) ** (2 * n), line - g(one) ** 8, 1 - sqrt(48 / one) - line)
    second = min((mpf(7) / 8) ** 14 - g(two) ** 14, mpf(1) / 6 - (mpf(7) / 8) ** 14)
    third = min(sqrt(three) / 4 - g(three), three / 16 - g(three) ** 2, lam_S(three) - three / 16)
    return min(first, second, third)


@of("lemma:combinatorial-number-near-center", f"{WALK}[binomial]")
def _(r):
    m, n = r.randint(1, 200), r.choice([0, 1, r.randint(0, 2000)])
    eps = mpf(n) / m
    top, bottom = (2 + eps) ** ((2 + eps) * m + 0.5), (1 + eps) ** ((1 + eps) * m + 0.5)
    short = exp(-mpf(1) / (6 * m)) * sqrt((2 + eps) / (1 + eps)) - 0.5
    return min(
        1 - top / bottom * exp(-mpf(1) / (6 * m)) / sqrt(2 * pi * m) / binomial(2 * m + n, m), short
    )


@of(
    "lemma:numerical-lower-bound",
    "lemma:numerical-lower-bound[first]",
    "lemma:numerical-lower-bound[chain]",
)
def _(r):
    z = sqrt(mpf(2)) * share(r, 0, 0.999999)
    main = (2 + z) / (2 * (1 + z) ** ((1 + z) / (2 + z))) - (1 - z**2 / 2)
    slope = 1 / (2 + z) - mpf(1) / 2 - ln(1 + z) / 2 + z / (1 - z**2 / 2)
    last = (z + z**2) / (2 * (2 + z))
    defect = abs(1 / (2 + z) - mpf(1) / 2 + z / 2 - last)
    return min(main, slope - last, (1 + z) * ln(1 + z) * (mpf(1) / 2 - 1 / (2 + z)), -defect)


@of("nearsight:slice-decay[e]", "nearsight:slice-decay[f]")
def _(r):
    a, d = wide(r, -3, 3), r.randint(1, 9)
    ends = [1 / sqrt(1 + 2 * a)] + [mpf(1)] * (d - 2) + [sqrt(1 + 2 * a) / (1 + a)]
    moved, stiff = mpf(1), mpf(0)
    for t in reversed([1 / (1 + a)] if d == 1 else ends):  # tangents squared, from the last step
        p, q = a / (1 + t), a * t / (1 + t)
        p, q = q, p
        whole = 1 + p + stiff
        moved, stiff = moved * sqrt(p * q) / whole, q * (1 + stiff) / whole
    return -abs(moved / (a / (2 * sqrt(1 + a)) * g(2 * a) ** (d - 1)) - 1)


@pytest.mark.parametrize("key", TRIED)
def test_the_statement_itself(key):
    assert key in KEYS
    assert least(key, TRIED[key]) > -(mpf(10) ** -35)
