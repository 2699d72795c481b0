"""(E4): what the optimum pays for leaving the targets, against the least over all data."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from . import oracles as oracle
from .oracle_support import GUARD, graph


def least_ratio(instance):
    """The least ``OPT / sum |x* - theta|^2`` over all data."""
    R, W = instance.rows
    paid = W + R @ instance.optimum
    off = instance.optimum - instance.targets
    _, s, V = np.linalg.svd(paid, full_matrices=False)
    kept = s > 1e-7 * s[0]
    return 0.5 / np.linalg.norm(off @ (V[kept].T / s[kept]), 2) ** 2


@settings(max_examples=60)
@given(
    spec=st.sampled_from(["path:2", "ring:6", "star:5", "complete:4"]),
    a=st.floats(-2, 1.5).map(lambda e: 10.0**e),
    x=st.floats(-2, 1.5).map(lambda e: 10.0**e),
    H=st.integers(1, 5),
    style=st.sampled_from(oracle.STYLES),
    seed=st.integers(0, 2**32 - 1),
)
def test_the_optimum_pays_for_leaving_the_targets(spec, a, x, H, style, seed):
    rng, found = np.random.default_rng(seed), graph(spec)
    instance = oracle.random_instance(
        rng, found, H, a, x / found.degree, l_f=2.0, style=style, shifts=bool(rng.integers(2))
    )
    assert least_ratio(instance) * GUARD >= 0.5 * (1 + 1 / (2 * a + x))


@pytest.mark.parametrize("H", [1, 4, 16])
def test_the_price_of_leaving_the_targets_is_attained(H):
    # alternating targets on an even ring; in time the ends make up for O(1/H^2)
    a, x = 0.7, 1.3
    least = 0.5 * (1 + 1 / (2 * a + x))
    found = least_ratio(oracle.uniform(graph("ring:6"), H, a, x / 2))
    assert least < found < least * (1 + 2.0 / H**2)
    alone = least_ratio(oracle.uniform(graph("ring:6"), H, 0.0, x / 2))
    assert alone == pytest.approx(0.5 * (1 + 1 / x), rel=1e-10)
