"""As in `textbook`, the theory's sharp results: joint decay, weighted energy, the certificate."""

from mpmath import mp, mpf

from .textbook import demko, digits, g, gamma_T, s

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
