"""Lower bounds in space against a long ring of blocks in extended precision."""

import numpy as np
import pytest
from mpmath import mp, mpf

from nearsight.bounds.lower import spatial_excess


def exactly(strength, d, r, blocks):
    """The bound on ``CR - 1`` by its definition, dense, on the quotient of the ring.

    Classes: vertex j, the other d - 1 of its block, then one class for each other block;
    a class function y solves ``(1 + 2 d l) y - l sum over neighbours = e_j``, l the strength.
    """
    others = list(range(1, blocks))
    classes = ["j", *(["own"] if d > 1 else []), *others]

    def solve(kept):
        M = mp.matrix(len(kept), len(kept))
        for i, here in enumerate(kept):
            M[i, i] = 1 + 2 * d * strength
            for m, there in enumerate(kept):
                block = [0 if c in ("j", "own") else c for c in (here, there)]
                if (block[0] - block[1]) % blocks in (1, blocks - 1):
                    M[i, m] -= strength * {"j": 1, "own": d - 1}.get(there, d)
        return mp.lu_solve(M, mp.matrix([1] + [0] * (len(kept) - 1)))[0]

    def seen(c):
        return c == "j" or (c == "own" and r >= 2) or (c != "own" and min(c, blocks - c) <= r)

    whole, ball = solve(classes), solve([c for c in classes if seen(c)])
    return (whole - ball) / (1 - whole)


@pytest.mark.parametrize("d", [1, 2, 3])
@pytest.mark.parametrize("r", [1, 2, 3])
@pytest.mark.parametrize(("x", "blocks"), [(0.01, 16), (0.8, 26), (6.0, 56)])
def test_spatial_bound_to_twelve_digits(d, r, x, blocks):
    a_S = x / (2 * d)
    with mp.workdps(60):
        exact = exactly(mpf(a_S) / 2, d, r, blocks)
        longer = exactly(mpf(a_S) / 2, d, r, blocks + 6)
        assert abs(longer / exact - 1) < mpf(10) ** -14  # N is large enough
        assert abs(spatial_excess(a_S, d, r) / exact - 1) < 1e-12


def test_spatial_bound_does_not_subtract():
    x, d, r = 0.01, 1, 6
    with mp.workdps(60):
        exact = exactly(mpf(x) / 4, d, r, 30)
    assert spatial_excess(x / 2, d, r) == pytest.approx(float(exact), rel=1e-12)
    # the definition in floats: nothing is left
    M = np.eye(41) * (1 + x / 2) - x / 4 * (np.eye(41, k=1) + np.eye(41, k=-1))
    M[0, -1] = M[-1, 0] = -x / 4
    ball = slice(20 - r, 21 + r)
    gap = np.linalg.inv(M)[20, 20] - np.linalg.inv(M[ball, ball])[r, r]
    assert abs(gap) < 1e-15
    assert 1e-40 < exact < 1e-20


def test_quotient_is_the_ring():
    # the dense matrix of all vertices, 7 blocks of 3: whole ring and the ball of radius 2
    d, N, strength, r = 3, 7, mpf("0.21"), 2
    block = np.repeat(np.arange(N), d)
    apart = np.minimum((block[:, None] - block) % N, (block - block[:, None]) % N)
    kept = np.flatnonzero(apart[0] <= r)
    with mp.workdps(40):
        values = []
        for chosen in (np.arange(N * d), kept):
            M = mp.matrix(len(chosen), len(chosen))
            for i, u in enumerate(chosen):
                for m, w in enumerate(chosen):
                    joined = strength * int(apart[u, w] == 1)
                    M[i, m] = 1 + 2 * d * strength if u == w else -joined
            values.append((M**-1)[0, 0])
        direct = (values[0] - values[1]) / (1 - values[0])
        assert abs(exactly(strength, d, r, N) / direct - 1) < mpf(10) ** -25
