"""The ring of blocks: resolvent, walks, and the lemmas about them."""

from fractions import Fraction
from math import comb

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from mpmath import mp, mpf

from nearsight.graphs import InputError
from nearsight.lowerbounds import Ring, central_binomial, entropy
from nearsight.lowerbounds.resolvent import (
    between_blocks,
    diagonal,
    entry,
    off_diagonal,
    within_block,
)

CASES = [(3, 1, 0.3), (3, 2, 1e-3), (7, 3, 0.21), (8, 2, 50.0), (9, 1, 1e3), (4, 2, 1e-7)]


def adjacency(N, d):
    block = np.repeat(np.arange(N), d)
    apart = (block[:, None] - block) % N
    return (apart == 1) | (apart == N - 1)


def exact_inverse(N, d, strength):
    A = adjacency(N, d)
    n = N * d
    M = mp.matrix(n, n)
    for i in range(n):
        for j in range(n):
            M[i, j] = 1 + 2 * d * mpf(strength) if i == j else -mpf(strength) * int(A[i, j])
    return M**-1


@pytest.mark.parametrize(("N", "d", "strength"), CASES)
def test_resolvent_to_the_last_digits(N, d, strength):
    with mp.workdps(40):
        B = exact_inverse(N, d, strength)
        for i in range(N * d):
            assert abs(entry(strength, d, 0, i, N) / B[0, i] - 1) < 1e-14
        assert abs(off_diagonal(strength, d, N) / (1 - B[0, 0]) - 1) < 1e-14


@pytest.mark.parametrize("d", [1, 2, 5])
@pytest.mark.parametrize("x", [1e-12, 0.01, 3.0, 1e8])
def test_infinite_ring_is_section_five(d, x):
    with mp.workdps(60):
        y = mpf(x / (4 * d)) * 4 * d
        s, m = mp.sqrt(1 + y), 1 + y / 2
        q = (s - 1) / (s + 1)
        strength = x / (4 * d)
        for kappa in (1, 2, 7):
            exact = q**kappa / (d * s)
            assert abs(between_blocks(strength, d, kappa) / exact - 1) < 1e-14
        own = 1 / (d * s) - 1 / (d * m)
        assert abs(within_block(strength, d) / own - 1) < 1e-14
        assert abs(diagonal(strength, d) / (own + 1 / m) - 1) < 1e-14
        assert abs(off_diagonal(strength, d) / (1 - own - 1 / m) - 1) < 1e-14


@pytest.mark.parametrize(("N", "d"), [(3, 1), (6, 2), (7, 1), (7, 2), (8, 1)])
def test_walks_are_powers_of_the_adjacency_matrix(N, d):
    A = adjacency(N, d).astype(int)
    power = np.eye(N * d, dtype=int)
    for length in range(1, 12):
        power = power @ A
        for kappa in range(1, N // 2 + 1):
            assert Ring(d, N).walks(kappa, length) == power[0, kappa * d]


def test_on_an_odd_ring_walks_of_the_other_parity_exist():
    # the proof writes (I + l L)^-1 as a sum over lengths kappa + 2m only
    assert Ring(1, 7).walks(3, 4) == 1
    assert Ring(1).walks(3, 4) == Ring(1, 8).walks(3, 4) == 0


def test_walk_counts_of_the_proof():
    for d in (1, 2, 3):
        for N in (None, 6, 7, 12):
            for kappa in range(3, (N or 12) // 2 + 1):
                for m in range(7):
                    for tier in ("stated", "sharp"):
                        assert Ring(d, N).walk_claim(kappa, m, tier).holds
    claim = Ring(2).walk_claim(4, 3, "sharp")
    assert claim.exact == claim.claimed == comb(10, 3) * 2**9


def test_first_claim_fails_at_three_quarters():
    # by hand: x = 3, s = 2, q = 1/3, so B = (3^-3 + 3^-5)/(2 (1 - 3^-8)) = 27/1312 at distance 3
    claim = Ring(1, 8).first_claim(0.75, 3)
    exact, printed = Fraction(27, 1312), 3 / Fraction(5, 2) * Fraction(3, 10) ** 3
    assert exact < printed == Fraction(81, 2500)
    assert claim.refuted
    assert claim.exact == pytest.approx(float(exact), rel=1e-15)
    assert claim.claimed == pytest.approx(float(printed), rel=1e-15)


@given(
    d=st.integers(1, 6),
    power=st.floats(-6, 5),
    kappa=st.integers(3, 30),
    more=st.none() | st.integers(0, 20),
)
def test_repaired_first_claim_and_second_claim_hold(d, power, kappa, more):
    ring = Ring(d, None if more is None else 2 * kappa + more)
    for tier in ("repaired", "sharp"):
        claim = ring.first_claim(10.0**power, kappa, tier)
        assert claim.hypotheses
        assert claim.exact * (1 + 1e-12) >= claim.claimed
    assert not ring.second_claim(10.0**power, kappa).refuted


def test_first_claim_holds_for_large_blocks_or_strong_couplings():
    assert Ring(3).first_claim(1e-9, 3).holds
    assert not Ring(3).first_claim(1e-9, 4).holds
    assert Ring(1).first_claim(10.0, 5).holds


def test_second_claim_begins_above_sixteen():
    assert not Ring(2).second_claim(8.0, 3).hypotheses
    assert Ring(2).second_claim(8.1, 3).hypotheses


def test_central_binomial_and_entropy():
    slack = [
        float(central_binomial(m, n).exact / central_binomial(m, n).claimed)
        for m in range(1, 25)
        for n in range(40)
    ]
    assert min(slack) > 1
    assert max(slack) < 1.2
    for eps in np.linspace(0.0, 1.4142, 60):
        assert entropy(float(eps)).hypotheses
        assert entropy(float(eps)).holds
    assert not entropy(1.5).hypotheses
    # the true expansion
    with mp.workdps(40):
        assert abs((1 - entropy(mpf(10) ** -4).exact) / (mpf(10) ** -8 / 8) - 1) < 1e-3


@pytest.mark.parametrize(
    "wrong",
    [
        lambda: Ring(0),
        lambda: Ring(1, 2),
        lambda: Ring(1).network,
        lambda: Ring(1, 6).first_claim(1.0, 4),
        lambda: Ring(1).walks(1, 0),
        lambda: between_blocks(1.0, 1, 7, 7),
        lambda: central_binomial(0, 1),
    ],
)
def test_bad_input(wrong):
    with pytest.raises(InputError):
        wrong()
