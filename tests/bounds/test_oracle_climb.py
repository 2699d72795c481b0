"""Hill climbing over the couplings comes near the certificate and stays below it."""

import numpy as np
import pytest

from nearsight.graphs import network_growth

from . import oracles as oracle
from .oracle_support import GUARD, certificates, graph, network

HARD = [
    ("path:2", 4, 2, 1, 1.0, 0.1, 0.25),
    ("path:3", 4, 2, 1, 0.3, 0.3, 0.25),
    ("complete:4", 3, 3, 1, 0.3, 0.03, 0.1),
    ("ring:5", 4, 2, 1, 0.1, 0.1, 0.4),
    ("star:5", 4, 2, 1, 0.1, 0.1, 0.25),
    ("ring:6", 5, 3, 2, 1.0, 1.0, 0.06),
]


def climbed(spec, H, k, r, a, x, rounds):
    """The worst couplings that hill climbing finds, and the least certificate."""
    rng = np.random.default_rng(7)
    here = graph(spec)
    cut = H * here.vertices
    size = cut + H * len(here.edges)

    def value(phi):
        temporal, spatial = phi[:cut].reshape(H, -1), phi[cut:].reshape(H, -1)
        return oracle.angles(here, H, a, x / here.degree, temporal, spatial).worst(k, r)[0]

    lean = np.arctan(np.sqrt(1 + a))  # as in the worst single step
    starts = [np.full(size, phi) for phi in (np.pi / 4, lean, np.pi / 2 - lean)]
    worst, _ = oracle.climb(rng, value, max(starts, key=value), rounds)
    return worst, min(certificates(network_growth(network(spec)), a, x, k, r).values())


@pytest.mark.parametrize(("spec", "H", "k", "r", "a", "x", "near"), HARD)
def test_climbing_stays_below_the_certificate(spec, H, k, r, a, x, near):
    worst, promised = climbed(spec, H, k, r, a, x, 60)
    assert near * promised < worst <= promised * GUARD


@pytest.mark.slow
@pytest.mark.parametrize(("spec", "H", "k", "r", "a", "x", "near"), HARD)
def test_climbing_long_stays_below_the_certificate(spec, H, k, r, a, x, near):
    worst, promised = climbed(spec, H, k, r, a, x, 3000)
    assert near * promised < worst <= promised * GUARD


def test_uniform_couplings_are_not_the_worst():
    ring = graph("ring:6")
    even, _ = oracle.uniform(ring, 5, 1.0, 0.5).worst(3, 2)
    worst, promised = climbed("ring:6", 5, 3, 2, 1.0, 1.0, 300)
    assert 1.3 * even < worst <= promised * GUARD
