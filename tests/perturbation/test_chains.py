"""The sharp bound on slices is attained, and where the printed one breaks."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest
from mpmath import mp

from nearsight.bounds.decay import slice_decay
from nearsight.graphs import InputError
from nearsight.lpc.constants import constants
from nearsight.perturbation.chains import (
    best_chain,
    best_tangents,
    chain,
    chain_sensitivity,
    search_chain,
    threshold,
)
from nearsight.perturbation.search import Climb
from nearsight.perturbation.target import Target

GRID = (0.05, 0.15, 0.5, 1.0, 3.0, 10.0, 30.0, 100.0)
FEW = (0.05, 1.0, 100.0)


def solved(a, strengths, angles, tail=0):
    """dx_d/dx_0 of a chain with d couplings, and a dense solve in mpmath."""
    d = len(angles)
    M, right = mp.eye(d), mp.zeros(d, 1)
    M[d - 1, d - 1] += tail
    for i, (s, phi) in enumerate(zip(strengths, angles, strict=True)):
        before, now = mp.cos(phi), -mp.sin(phi)
        M[i, i] += a * s * now * now
        if i == 0:
            right[0] = -a * s * now * before
        else:
            M[i - 1, i - 1] += a * s * before * before
            M[i, i - 1] += a * s * now * before
            M[i - 1, i] += a * s * now * before
    return mp.lu_solve(M, right)[d - 1]


@pytest.mark.parametrize("a", FEW)
@pytest.mark.parametrize("d", [1, 2, 3, 9])
def test_the_best_chain_attains_the_bound_to_forty_digits(a, d):
    mp.dps = 50
    a = mp.mpf(a)
    promised = slice_decay(a, d)
    tangents = best_tangents(a, d)
    assert abs(chain_sensitivity(a, tangents) / promised - 1) < mp.mpf(10) ** -40
    dense = solved(a, [1] * d, [mp.atan(t) for t in tangents])
    assert abs(dense / promised - 1) < mp.mpf(10) ** -40


@pytest.mark.parametrize("d", [1, 2, 5])
def test_no_chain_near_the_best_or_far_from_it_is_better(d):
    mp.dps = 30
    a, rng = mp.mpf(2), np.random.default_rng(d)
    best = [mp.atan(t) for t in best_tangents(a, d)]
    promised = slice_decay(a, d)
    for scale in (1e-6, 1e-3, 0.1, 3.0):
        for _ in range(10):
            angles = [b + mp.mpf(m) for b, m in zip(best, rng.normal(0, scale, d), strict=True)]
            strengths = [1 - mp.mpf(s) * min(scale, 1) for s in rng.uniform(0, 1, d)]
            tail = mp.mpf(rng.exponential(scale))
            assert abs(solved(a, strengths, angles, tail)) <= promised


@pytest.mark.parametrize("until_end", [False, True])
@pytest.mark.parametrize("a", FEW)
def test_random_starts_alone_reach_the_bound(a, until_end):
    for d in range(1, 10):
        found = search_chain(a, d, until_end=until_end, structured=False, starts=3, seed=d)
        assert 1 - 1e-6 <= found.ratios["sharp"] <= 1 + 1e-9
        assert found.value <= slice_decay(a, d) * (1 + 1e-9)
        assert found.measured() == pytest.approx(found.value, rel=1e-10)
        assert constants(found.problem).parameters().l_T <= a


@pytest.mark.slow
@pytest.mark.parametrize("until_end", [False, True])
@pytest.mark.parametrize("a", GRID)
def test_the_search_reaches_the_bound_on_the_whole_grid(a, until_end):
    for d in range(1, 10):
        for known, beyond in ((False, 0), (True, 0), (False, 3)):
            found = search_chain(a, d, until_end=until_end, known=known, beyond=beyond)
            assert 1 - 1e-6 <= found.ratios["sharp"] <= 1 + 1e-9


@pytest.mark.parametrize("until_end", [False, True])
def test_a_longer_chain_gives_nothing(until_end):
    for beyond in (1, 4):
        found = search_chain(2.0, 4, until_end=until_end, beyond=beyond, structured=False)
        assert 1 - 1e-6 <= found.ratios["sharp"] <= 1 + 1e-9


@pytest.mark.parametrize(("d", "beyond"), [(1, 0), (2, 0), (6, 0), (3, 2)])
def test_the_known_start_is_the_best_chain(d, beyond):
    for until_end in (False, True):
        window = chain(d, until_end=until_end, beyond=beyond)
        found = search_chain(1.5, d, until_end=until_end, beyond=beyond, known=True, starts=0)
        climb = Climb.of(window, Target((d, 0), (0, 0)), found.parameters)
        start = best_chain(window, found.parameters, d)
        assert climb.value(start) == pytest.approx(slice_decay(1.5, d), rel=1e-12)


@pytest.mark.parametrize("d", [1, 4])
def test_the_printed_bound_breaks_where_it_should(d):
    seen = []
    found = threshold(d, tolerance=1e-9, progress=lambda *call: seen.append(call))
    mp.dps = 30

    def gap(a):  # the supremum beside 2 a gamma^d
        root = mp.sqrt(1 + 2 * a)
        return 4 * (root - 1) / (root + 1) * mp.sqrt(1 + a) - 1

    exact = mpmath.findroot(gap, 0.6)
    assert abs(exact - mp.mpf("0.6109052767")) < 1e-9
    assert found.violated <= exact * (1 + 1e-9)
    assert abs(found.violated / exact - 1) < 2e-9
    assert abs(found.survived / exact - 1) < 2e-9
    assert found.found.ratios["stated"] > 1
    assert seen[-1][0] == seen[-1][1]


def test_a_violation_in_exact_arithmetic():
    """The instance's own doubles, as fractions: in the class, and above the printed bound."""
    a, d = 0.25, 4
    problem = search_chain(a, d, starts=2, seed=3).problem
    blocks = [
        [[Fraction(float(x)) for x in row] for row in P] for P in problem.temporal.matrix[:, 0]
    ]
    moved = Fraction(1)
    assert (problem.node.matrix == 1).all()
    for (p, q), (same, r) in blocks:
        top = Fraction(a)
        assert q == same
        assert min(p, r, top - p, top - r, p * r - q * q, (top - p) * (top - r) - q * q) >= 0
    kappa = 1 + blocks[d][1][1]  # the coupling to the last, fixed step
    for (p, q), (_, r) in reversed(blocks[:d]):
        moved *= -q / (kappa + p)
        kappa = 1 + r - q * q / (kappa + p)
    mp.dps = 40
    root = mp.sqrt(1 + 2 * mp.mpf(a))
    printed = 2 * mp.mpf(a) * ((root - 1) / (root + 1)) ** d
    assert abs(mp.mpf(moved.numerator) / moved.denominator) > mp.mpf("1.2") * printed


def test_the_repaired_bound_has_no_threshold():
    with pytest.raises(InputError, match="no threshold"):
        threshold(2, tier="repaired")
    with pytest.raises(InputError, match="tier"):
        threshold(2, tier="nonsense")
    with pytest.raises(InputError, match="d = 0"):
        chain(0)
    with pytest.raises(InputError, match="d = 0"):
        best_tangents(1.0, 0)
