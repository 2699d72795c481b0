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


# joint decay -------------------------------------------------------------------------------


@digits
def joint_slack(a, x, p, q):
    """(J) with ``alpha = -log p``, ``beta = -log q``."""
    return 1 - ((p + 1 / p) / 2 - 1) * a - ((q + 1 / q) / 2 - 1) * x / 2


@digits
def least_entry(a, x, dt, ds, p, q):
    slack = joint_slack(a, x, p, q)
    entry = p**dt * q**ds / slack if slack > 0 else mp.inf
    in_time = demko(1 + 2 * a) * g(2 * a) ** dt
    in_space = demko(1 + x) * g(x) ** ds
    return min(entry, in_time, in_space)


# weighted energy and the sharp ratio -------------------------------------------------------

ROWS = ("own", "next", "neighbours")


@digits
def row(name, a, a_S, Delta, eta, k, r, share):
    """(E2), (E3): the coefficients of D, y and Z; infinite where the share is not admitted."""
    x, F = Delta * a_S, mpf(share) / 200
    if k == 2 or a == 0:
        F = mpf(0)
    b = {2: mpf(0), 3: mpf(1) / 2}.get(k, mpf(1))
    alpha = mp.acosh(1 + F / (b * a)) if F else mpf(0)
    beta = mp.acosh(1 + 2 * (1 - F) / x) if x else mpf(0)
    e = {
        "own": 0 if k == 2 else a,
        "next": a if k == 3 else 2 * a,
        "neighbours": 0 if k == 2 else a,
    }[name]
    x_row = max(Delta - 1, 1) * a_S if name == "neighbours" else x
    q = 2 * r - 3 if name == "neighbours" else 2 * r - 1
    j0 = 1 if name == "next" else 0
    X = e * mp.exp(alpha) + x_row * mp.exp(beta)
    below = 4 + 4 * (e + x_row) - 2 * e * x_row * (mp.cosh(alpha - beta) - 1)
    if below <= 0:
        return (mp.inf,) * 3
    A = a_S * eta / 4 * (4 * X / below) * mp.exp(-beta * q)
    # F = 0 means alpha = 0 and all weights 1
    w = [mp.exp(-2 * alpha * abs(j - j0)) for j in range(k - 1)]
    squares = [s(a, d) ** 2 for d in range(k + 1)]
    return tuple(
        mp.sqrt(A * mp.fsum(w[j] * f(j) for j in range(k - 1)))
        for f in (lambda j: 1, lambda j: squares[j + 1], lambda j: squares[k - 1 - j])
    )


class Form:
    """``D D + y y``."""

    def __init__(self, D, y):
        self.D, self.y = D, y

    def __add__(self, other):
        return Form(self.D + other.D, self.y + other.y)

    def __rmul__(self, c):
        return Form(c * self.D, c * self.y)


def _product(u, v):
    return mp.matrix([u.D * v.D, u.D * v.y + u.y * v.D, u.y * v.y])


@digits
def step_error(a, a_S, Delta, eta, k, r, shares):
    """(E3): Z, E_top, E_lat, E_next, E_nbr."""
    D, y = Form(mpf(1), mpf(0)), Form(mpf(0), mpf(1))
    Z = D + s(a, k) * y
    top = s(a, k - 1) * Z

    def lateral(name, share):
        in_D, in_y, in_Z = row(name, a, a_S, Delta, eta, k, r, share)
        return in_D * D + in_y * y + in_Z * Z

    nothing = Form(mpf(0), mpf(0))
    after = lateral("next", shares[1]) if k >= 3 else nothing
    if r >= 2:
        nbr = lateral("neighbours", shares[2])
    else:
        nbr = mp.sqrt(Delta) * (D + s(a, 1) * y + s(a, k - 1) * Z)
    return Z, top, lateral("own", shares[0]), after, nbr


@digits
def sharp_excess(kind, a, a_S, condition, Delta, eta, k, r, shares):
    """(E4), (E5): P_0, P_1, P_2 and the bound on CR - 1."""
    x = Delta * a_S
    Z, top, lat, after, nbr = step_error(a, a_S, Delta, eta, k, r, shares)
    E, Lam = top + lat, condition + x + 2 * a
    G = a / 2 * s(a, k - 2) * (Z + s(a, k - 1) * top)
    if kind == "smooth":
        P = Lam / 2 * _product(E, E)
    elif kind == "mix":
        if top.D > G.D or top.y > G.y:
            P = _product(G, E) + Lam / 2 * _product(lat, lat)
        else:
            P = _product(G, top) - _product(top, top) / 2 + _product(G, lat)
            P += Lam / 2 * _product(lat, lat)
    else:
        dG = a / 2 * s(a, k - 2) * (Z + s(a, k - 1) * E) + x / 2 * lat
        if k >= 3:
            dG += a / 2 * (s(a, 1) * lat + after)
        dG += mp.sqrt(Delta) * a_S / 2 * nbr
        if E.D <= dG.D and E.y <= dG.y:
            P = _product(dG, E) - _product(E, E) / 2
        else:
            P = _product(dG, dG) / 2
    found = mp.inf
    if P[2] < 0.5:
        half = mpf(1) / 2 - P[2]
        found = (P[1] + mp.sqrt(P[1] ** 2 + 4 * half * P[0])) / (2 * half)
    S = 1 + s(a, 1) / (1 - gamma_T(a))
    if S * E.y < 1:
        found = min(found, S * E.D / (1 - S * E.y))
    if mp.isinf(found):
        return P[0], P[1], P[2], mp.inf
    y2 = 2 * (P[0] + P[1] * found + P[2] * found**2)
    return P[0], P[1], P[2], y2 * (2 * a + x) / (1 + 2 * a + x)


# lower bounds ------------------------------------------------------------------------------


@digits
def temporal(a, k):
    return g(2 * a) ** (2 * k) / (mp.sqrt(1 + 2 * a) - 1)


@digits
def final(a, k):
    """One random target at the free end of a chain, l = a/2: by Green's functions.

    ``B_HH`` of the half line with a free end, and of the last k steps held at 0 before them;
    solutions decay like ``gamma**n`` away from the end.
    """
    ell, q = a / 2, g(2 * a)
    # next to the end u_1/u_0 is q on the half line; u_n = q**n - q**(2k - n), 0 at n = k, has less
    less = q ** (2 * k - 1) * (1 - q**2) / (1 - q ** (2 * k))
    # (1/w - 1/p)/(1 - 1/w) with w = 1 + l (1 - q), p = w + l less
    return ell * less / (1 + ell * (1 - q + less)) / (ell * (1 - q))


@digits
def spatial(a_S, d, r):
    """Section 5 on the infinite ring of blocks, by subtracting; DIGITS must suffice.

    The inverse on the ball of radius r by elimination: blocks act through their sums and the
    differences inside one block, both of which a symmetric solution keeps apart.
    """
    ell = a_S / 2
    x = 4 * d * ell
    B = 1 / (d * mp.sqrt(1 + x)) + (1 - mpf(1) / d) / (1 + 2 * d * ell)
    diagonal = 1 + 2 * d * ell
    if r == 1:  # j alone between its 2d neighbours
        return (B - 1 / (diagonal - 2 * d * ell**2 / diagonal)) / (1 - B)
    # chain of 2r + 1 blocks: on block sums I + lL is tridiagonal, off-diagonal -d l (ell here)
    side = mpf(0)
    for _ in range(r):
        side = (d * ell) ** 2 / (diagonal - side)
    chain = 1 / (diagonal - 2 * side)
    inner = chain / d + (1 - mpf(1) / d) / diagonal
    return (B - inner) / (1 - B)


@digits
def lambda_T(a):
    return (1 - 2 / (mp.sqrt(1 + 4 * a) + 1)) ** 2


@digits
def lambda_S(x):
    weak = x / (3 + 3 * x)
    return weak if x < 48 else max(weak, (1 - 4 * mp.sqrt(3) / mp.sqrt(x)) ** 2)
