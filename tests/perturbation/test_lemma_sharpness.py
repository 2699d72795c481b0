"""How tight the bounds of the lemmas are, and instances made for them."""

from itertools import product
from math import cos, pi, sqrt

import mpmath
import numpy as np
import pytest

from nearsight.bounds import Parameters
from nearsight.graphs import InputError, NetworkGrowth, parse_graph
from nearsight.perturbation.lemmas import final_step, powers, products, series
from nearsight.perturbation.lemmas._hierarchy import distances
from nearsight.perturbation.lemmas._specimen import Shape, Specimen, drawn


def part(comparisons, name):
    (found,) = (c for c in comparisons if c.part == name)
    return found


def share(comparisons, name):
    found = part(comparisons, name)
    return found.measured / found.bound


# thm: l-power


@pytest.mark.parametrize("graph", ["tree:2x2", "erdos-renyi:7x0.2", "ring-of-blocks:4x2"])
def test_products_of_positive_blocks_are_sums_over_paths(graph):
    network, rng = parse_graph(graph, 2), np.random.default_rng(0)
    rate, slower = 0.6, 0.8
    factors = [products.decaying(network, 2, C, rate, rng, extreme=True) for C in (1.5, 0.5, 2.0)]
    found = products.compare(network, factors, [1.5, 0.5, 2.0], rate, slower)
    far, V = distances(network), range(network.vertices)
    h = NetworkGrowth(network)
    total = sum((rate / slower) ** q * h.h(q) for q in range(10))
    shares = [
        1.5 * sum(rate ** (far[u, s] + far[s, t] + far[t, q]) for s, t in product(V, V))
        / (1.5 * total**3 * slower ** far[u, q])
        for u, q in product(V, V)
        if np.isfinite(far[u, q])
    ]  # fmt: skip
    assert share(found, "stated") == pytest.approx(max(shares), rel=1e-8)
    assert share(found, "sharp") == pytest.approx(max(shares) * total, rel=1e-8)


@pytest.mark.parametrize("factors", [1, 2, 4])
def test_the_sharp_constant_of_products_is_attained(factors):
    network, rate = parse_graph("ring-of-blocks:5x2"), 1 - 1e-6
    made = [
        products.decaying(network, 1, 1.0, rate, np.random.default_rng(0), extreme=True)
    ] * factors
    found = products.compare(network, made, [1.0] * factors, rate, 1 - 1e-7)
    assert share(found, "sharp") == pytest.approx(1, abs=1e-4)
    assert share(found, "stated") == pytest.approx(1 / 10, abs=1e-4)


def test_products_beyond_their_bounds_are_not_held_against_the_lemma():
    network = parse_graph("path:3")
    found = products.compare(network, [np.ones((3, 3))], [1.0], 0.1, 0.2)
    assert not any(c.hypotheses or c.holds for c in found)
    assert not any(c.violates for c in found)
    with pytest.raises(InputError, match="lambda"):
        products.compare(network, [np.eye(3)], [1.0], 0.5, 0.5)


# le: H-inverse


@pytest.mark.parametrize("k", [3, 4, 12])
@pytest.mark.parametrize("a", [0.1, 0.5, 1.0, 100.0])
def test_the_exact_radius_of_difference_couplings(k, a):
    specimen = Specimen(Shape("path:1", k=k, r=1), Parameters(1.0, 1.0, a, 0.0))
    found = series.compare(specimen.hierarchy, specimen.parameters)
    radius = part(found, "radius, sharp")
    assert radius.measured == pytest.approx(a / (1 + a) * cos(pi / k), rel=1e-9)
    assert part(found, "radius, stated").hypotheses == (2 * a < 1)  # and it converges anyway
    assert all(c.holds for c in found)


def test_the_radius_of_arbitrary_convex_couplings():
    # pair costs drawn here, without the package: rho(A D^{-1}) <= a/(1+a), no condition on a
    rng = np.random.default_rng(3)
    largest = 0.0
    for _ in range(400):
        S, n, a = int(rng.integers(2, 6)), int(rng.integers(1, 4)), 10 ** rng.uniform(-2, 3)
        M = np.eye(S * n)
        for i in range(S - 1):
            Q = np.linalg.qr(rng.standard_normal((2 * n, 2 * n)))[0]
            e = a * rng.random(2 * n) ** rng.choice([0.2, 5.0])
            M[i * n : (i + 2) * n, i * n : (i + 2) * n] += Q @ np.diag(e) @ Q.T
        step = np.arange(S * n) // n
        D = np.where(step[:, None] == step, M, 0)
        radius = np.abs(np.linalg.eigvals((M - D) @ np.linalg.inv(D))).max()
        largest = max(largest, radius * (1 + a) / a)
    assert 0.5 < largest <= 1


# le:J-bound, le:final-step


def test_the_printed_powers_use_a_quarter_at_most():
    shape = Shape("path:1", k=3, r=1)
    found = powers.compare(Specimen(shape, Parameters(1.0, 1.0, 1e-6, 0.0)), 0.5)
    assert share(found, "stated") == pytest.approx(0.25, rel=1e-5)
    for seed in range(40):
        assert part(powers.measure(seed), "stated").ratio <= 0.25


def test_powers_by_hand():
    specimen = drawn(21, k=4)
    h, slower = specimen.hierarchy, 0.9
    found = part(powers.compare(specimen, slower), "stated")
    p, far, n = specimen.parameters, h.inner_distance, h.n
    x = specimen.shape.network.max_degree * p.l_S / p.mu
    rate = (sqrt(1 + x) - 1) / (sqrt(1 + x) + 1)
    b = sum((rate / slower) ** q * specimen.shape.growth.h(q) for q in range(12))
    J = h.A @ np.linalg.inv(h.D)
    shares, power = [], np.eye(len(J))
    for l in range(1, 9):  # noqa: E741 - the paper's letter
        power = power @ J
        m = len(h.agents)
        for i, j, u, q in product(h.steps, h.steps, range(m), range(m)):
            rest = l - abs(i - j)
            if rest < 0 or rest % 2:
                continue
            at, to = (i * m + u) * n, (j * m + q) * n
            paths = float(mpmath.binomial(l, rest // 2))
            bound = paths * (b * 2 * p.l_T / p.mu) ** l * slower ** far[u, q]
            shares.append(np.linalg.norm(power[at : at + n, to : to + n], 2) / bound)
    assert found.measured / found.bound == pytest.approx(max(shares), rel=1e-7)
    with pytest.raises(InputError, match="slower"):
        powers.compare(specimen, rate)


def test_the_last_step_by_hand():
    shape = Shape("path:5", v=2, k=4, r=2, style="tilted", seed=3, varying=True)
    mu, l_T, l_S, b_1, b_2 = 1.0, 0.02, 0.1, 3.0, 12.0
    specimen = Specimen(shape, Parameters(mu, mu, l_T, l_S))
    found = final_step.compare(specimen, b_1, b_2)
    h = [1, 2, 2, 1, 1]  # of the path
    a = sum(n * ((1 + b_1) / (1 + b_1 + b_2)) ** q for q, n in enumerate(h))
    a_tilde = sum(n / (1 + b_1) ** q for q, n in enumerate(h))
    gamma = (sqrt(1 + 2 * l_S) - 1) / (sqrt(1 + 2 * l_S) + 1)
    rho_T, rho_S = 4 * a_tilde * l_T / mu, (1 + b_1 + b_2) * gamma
    C = max(a**2 / (2 * a_tilde), 2 * a**2 * 2 * l_S / rho_S) / (1 - rho_T)
    matrices = specimen.hierarchy
    moved = np.abs(np.linalg.inv(matrices.M) @ matrices.cross)
    shares = {"K, stated": [], "K, as used": [], "R, stated": []}
    for row, column in product(range(9), range(len(matrices.fixed))):
        step, agent = 1 + row // 3, 1 + row % 3
        _, tau, u = matrices.local.terms.fixed[column]
        far = abs(agent - u)
        bound = C * rho_T ** abs(step - tau) * rho_S**far
        if tau in (0, 4):
            shares["R, stated"].append(moved[row, column] / bound)
        else:
            shares["K, as used"].append(moved[row, column] / bound)
            shares["K, stated"].append(moved[row, column] / bound * rho_S)
    for name, values in shares.items():
        c = part(found, name)
        assert c.hypotheses == (mu >= max(8 * a_tilde * l_T, 2 * l_S * (b_1 + b_2) / 4))
        assert share(found, name) == pytest.approx(max(values), rel=1e-7)


def test_the_last_step_outside_its_hypotheses_claims_nothing():
    specimen = Specimen(Shape("ring:5"), Parameters(1.0, 1.0, 0.1, 5.0))
    found = final_step.compare(specimen, 3.0, 12.0)
    assert not any(c.hypotheses for c in found)
    strong = Specimen(Shape("ring:5"), Parameters(1.0, 1.0, 1.0, 0.0))
    assert final_step.compare(strong, 3.0, 12.0) == ()
    with pytest.raises(InputError, match="b_1"):
        final_step.compare(specimen, 0.0, 1.0)


@pytest.mark.parametrize("graph", ["path:1", "path:2", "star:5", "complete:4"])
@pytest.mark.parametrize(("l_T", "l_S"), [(0.0, 0.0), (0.0, 0.02), (0.01, 0.0)])
@pytest.mark.parametrize(("k", "r"), [(2, 1), (2, 2), (3, 1)])
def test_the_last_step_without_couplings(graph, l_T, l_S, k, r):
    specimen = Specimen(Shape(graph, k=k, r=r), Parameters(1.0, 1.0, l_T, l_S))
    found = final_step.compare(specimen, 5.0, 30.0)
    assert all(c.hypotheses and c.holds for c in found)
