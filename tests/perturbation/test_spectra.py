"""Blocks stay within their class, rounding included, and fill it."""

from fractions import Fraction

import mpmath
import numpy as np
import pytest

from nearsight.graphs import InputError
from nearsight.perturbation.spectra import Spectra


@pytest.mark.parametrize("high", [1 / 3, 1.0, 97.3])
def test_blocks_of_two_numbers_are_within_the_class_exactly(high):
    rng = np.random.default_rng(3)
    angles = np.concatenate([np.pi / 4 * np.arange(-8, 9), rng.uniform(-7, 7, 200)])
    strengths = np.where(rng.random(angles.size) < 0.5, 1.0, rng.random(angles.size))
    family = Spectra(angles.size, 2, 0.0, high, 1)
    for P in family.matrices(np.stack([strengths, angles], axis=1)):
        p, q, r = (Fraction(float(P[i])) for i in ((0, 0), (0, 1), (1, 1)))
        top = Fraction(high)
        assert P[0, 1] == P[1, 0]
        assert min(p, r, top - p, top - r) >= 0
        assert p * r >= q * q
        assert (top - p) * (top - r) >= q * q


@pytest.mark.parametrize(("size", "rank"), [(2, 2), (3, 3), (4, 2), (6, 6)])
def test_spectra_of_larger_blocks_in_extended_precision(size, rank):
    mpmath.mp.dps = 40
    rng = np.random.default_rng(size)
    family = Spectra(6, size, 1.0, 3.0, rank)
    theta = rng.uniform(-4, 4, (6, family.each))
    theta[:, :rank] = rng.integers(0, 2, (6, rank))
    for P in family.matrices(theta):
        values = mpmath.eigsy(mpmath.matrix(P.tolist()), eigvals_only=True)
        assert min(values) >= 1
        assert max(values) <= 3


@pytest.mark.parametrize("size", [2, 3, 4])
def test_spectra_of_full_rank_have_no_missing_direction(size):
    family = Spectra(1, size, 0.0, 1.0, size)
    theta = np.random.default_rng(size).uniform(0.1, 0.9, (1, family.each))
    lines = []
    for i in range(size):
        for j in range(i + 1):
            bar = np.zeros((1, size, size))
            bar[0, i, j] = bar[0, j, i] = 0.5 if i != j else 1.0
            lines.append(family.gradient(theta, bar)[0])
    assert np.linalg.matrix_rank(np.array(lines)) == size * (size + 1) // 2


def test_a_class_without_room_is_met_bit_by_bit():
    assert (Spectra(3, 2, 1.1, 1.1, 2).matrices(np.zeros((3, 0))) == 1.1 * np.eye(2)).all()
    ends = Spectra(2, 1, 0.1, 0.7, 1).matrices(np.array([[0.0], [1.0]])).ravel()
    assert ends.tolist() == [0.1, 0.7]
    with pytest.raises(InputError, match="rank"):
        Spectra(1, 2, 0.0, 1.0, 3)
