"""As in `textbook`, the lower bounds: in time, in space, and their rates in the paper."""

from mpmath import mp, mpf

from .textbook import digits, g


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
