"""``thm:graph-induced-band-mat-inverse``: where Demko's bound is attained, and by hand."""

from itertools import product
from math import sqrt

import mpmath
import numpy as np
import pytest

from nearsight.bounds import Parameters
from nearsight.bounds.decay import demko, g
from nearsight.graphs import parse_graph
from nearsight.perturbation.lemmas import banded_inverse
from nearsight.perturbation.lemmas._extremal import extremal_path
from nearsight.perturbation.lemmas._hierarchy import distances
from nearsight.perturbation.lemmas._specimen import Shape, Specimen


def part(comparisons, name):
    (found,) = (c for c in comparisons if c.part == name)
    return found


def share(comparisons, name):
    found = part(comparisons, name)
    return found.measured / found.bound


def line(n):
    return distances(parse_graph(f"path:{n}"))


@pytest.mark.parametrize("kappa", [1.01, 2.0, 30.0])
@pytest.mark.parametrize("d", [1, 2, 3, 7])
def test_demko_is_attained_at_every_distance(d, kappa):
    A = extremal_path(d, kappa)
    values = np.linalg.eigvalsh(A)
    assert values[[0, -1]] == pytest.approx([1, kappa])
    with mpmath.workdps(30):  # the corner of the inverse of a tridiagonal matrix
        M = mpmath.matrix(A.tolist())
        corner = mpmath.mpf(1)
        for i in range(d):
            corner *= abs(M[i, i + 1])
        corner = float(corner / mpmath.det(M))
    promised = (1 + sqrt(kappa)) ** 2 / (2 * kappa) * ((sqrt(kappa) - 1) / (sqrt(kappa) + 1)) ** d
    assert corner == pytest.approx(promised, rel=1e-10)
    banded = banded_inverse.Banded(
        line(d + 1), np.ones(d + 1, int), A, 0 * A, 2, 1.0, kappa * (1 + 1e-14)
    )
    ends = [(np.array([0]), np.array([d]))]
    found = banded_inverse.compare(banded, ends)
    assert all(c.hypotheses and c.holds for c in found)
    assert share(found, "exact") == pytest.approx(1, rel=1e-8)
    # two times Demko's constant would not be needed, half of it is too little
    assert share(found, "stated") == pytest.approx((1 + kappa**-0.5) ** 2 / 4, rel=1e-8)


def test_a_local_problem_attains_demko():
    # two agents, one step, no temporal costs: M = mu + (l_S/2) [[1, -1], [-1, 1]]
    shape = Shape("path:2", k=2, r=2)
    banded = banded_inverse.of_specimen(Specimen(shape, Parameters(2.0, 2.0, 0.0, 3.0)))
    np.testing.assert_allclose(banded.A, [[3.5, -1.5], [-1.5, 3.5]])
    found = banded_inverse.compare(banded, [(np.array([0]), np.array([1]))])
    assert share(found, "exact") == pytest.approx(1, rel=1e-8)


@pytest.mark.parametrize(("coupling", "n"), [(0.5, 60), (2.0, 80)])
def test_uniform_paths_between_halves(coupling, n):
    # A = 1 + s L on a long path: entries g(4s)^|i-j|/sqrt(1+4s) in the middle, hence
    # g^d/(sqrt(kappa)(1-g^2)) between the two half lines: half of Demko's bound
    L = 2 * np.eye(n) - np.eye(n, k=1) - np.eye(n, k=-1)
    kappa = 1 + 4 * coupling
    A = np.eye(n) + coupling * L
    banded = banded_inverse.Banded(line(n), np.ones(n, int), A, 0 * A, 2, 1.0, kappa)
    d, half = 3, n // 2
    halves = [(np.arange(half), np.arange(half + d - 1, n))]
    found = banded_inverse.compare(banded, halves)
    expected = g(4 * coupling) ** d / sqrt(kappa) / (1 - g(4 * coupling) ** 2)
    assert part(found, "sharp").measured == pytest.approx(expected, rel=1e-6)
    assert share(found, "exact") == pytest.approx(0.5, rel=1e-6)


def test_random_banded_matrices_are_what_they_claim():
    rng = np.random.default_rng(5)
    for q, graph in product((2, 4, 6), ("path:1", "ring:8", "tree:3x2", "erdos-renyi:8x0.2")):
        found = banded_inverse.random_banded(parse_graph(graph, 1), q, 50.0, rng)
        assert found.hypotheses()
        wrong = banded_inverse.Banded(
            found.distance, found.sizes, 60 * found.A, found.D, q, 1.0, 50.0
        )
        assert not wrong.hypotheses()


def test_blocks_of_the_inverse_by_hand():
    rng = np.random.default_rng(9)
    banded = banded_inverse.random_banded(parse_graph("tree:2x2"), 4, 20.0, rng)
    start = np.concatenate([[0], np.cumsum(banded.sizes)])
    with mpmath.workdps(30):
        inverse = mpmath.matrix((banded.A + banded.D).tolist()) ** -1
        inverse = np.array(inverse.tolist(), dtype=float)
    shares = []
    for i, j in product(range(7), repeat=2):
        block = inverse[start[i] : start[i + 1], start[j] : start[j + 1]]
        gamma = ((sqrt(20) - 1) / (sqrt(20) + 1)) ** (2 / 4)
        bound = 2 * gamma ** banded.distance[i, j]
        shares.append(np.linalg.svd(block, compute_uv=False)[0] / bound)
    single = [(np.array([i]), np.array([j])) for i, j in product(range(7), repeat=2)]
    found = banded_inverse.compare(banded, single)
    assert share(found, "stated") == pytest.approx(max(shares), rel=1e-7)
    assert demko(20.0) < 2
