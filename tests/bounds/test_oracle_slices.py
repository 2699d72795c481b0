"""Decay over whole time steps: the sharp bound holds and is attained, the stated one fails."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.optimize import minimize

from nearsight.bounds.decay import gamma_T, slice_decay

from . import oracles as oracle
from .oracle_support import GUARD, graph, result


@settings(max_examples=100)
@given(
    spec=st.sampled_from(["path:1", "path:3", "ring:5", "star:5"]),
    a=st.floats(-3, 2).map(lambda e: 10.0**e),
    x=st.floats(-3, 2).map(lambda e: 10.0**e),
    steps=st.integers(2, 7),
    n=st.integers(1, 2),
    style=st.sampled_from(oracle.STYLES),
    seed=st.integers(0, 2**32 - 1),
)
def test_slices_decay_as_promised(spec, a, x, steps, n, style, seed):
    rng, small = np.random.default_rng(seed), graph(spec)
    instance = oracle.random_instance(
        rng, small, steps, a, x / max(small.degree, 1), l_f=3.0, n=n, style=style
    )
    M, C = instance.gradient
    width, bottom = instance.slice, slice(0, instance.slice)
    until_end = -np.linalg.solve(M, C[:, bottom])
    inner = slice(0, (steps - 1) * width)
    ends = np.hstack([C[inner, bottom], M[inner, inner.stop :]])
    between = -np.linalg.solve(M[inner, inner], ends)
    for t in range(1, steps + 1):
        rows = slice((t - 1) * width, t * width)
        assert np.linalg.norm(until_end[rows], 2) <= slice_decay(a, t) * GUARD
        if t < steps:
            assert np.linalg.norm(between[rows, :width], 2) <= slice_decay(a, t) * GUARD
            assert np.linalg.norm(between[rows, width:], 2) <= slice_decay(a, steps - t) * GUARD


def chain(a, phi):
    """Sensitivities of scalar steps 1, 2, ... to step 0; edge t leans by ``phi[t-1]``."""
    M, first = np.eye(len(phi)), np.zeros(len(phi))
    for t, (c, s) in enumerate(zip(np.cos(phi), np.sin(phi), strict=True)):
        M[t, t] += a * s * s
        if t:
            M[t - 1, t - 1] += a * c * c
            M[t, t - 1] -= a * c * s
            M[t - 1, t] -= a * c * s
        else:
            first[0] = a * c * s
    return np.linalg.solve(M, first)


def steepest(a, d):
    """The largest sensitivity at distance d over chains of d edges of full strength."""
    found = minimize(
        lambda phi: -chain(a, phi)[-1],
        np.full(d, np.arctan(1 / np.sqrt(1 + a))),
        method="BFGS",
        options={"gtol": 1e-9},
    )
    return -found.fun


@pytest.mark.parametrize("a", [0.01, 0.3, 1.0, 7.0, 100.0])
def test_slice_decay_is_attained(a):
    sharp = result("thm:global-exp-decay", "sharp", "path:1", a, 0.0, k=2)
    for d in (1, 2, 4):
        assert steepest(a, d) == pytest.approx(slice_decay(a, d), rel=1e-6)
    assert sharp.values["s_k_minus_1"] == pytest.approx(steepest(a, 1), rel=1e-6)
    assert sharp.values["s_k"] == pytest.approx(steepest(a, 2), rel=1e-6)
    assert sharp.guarantee


@pytest.mark.parametrize("a", [0.05, 1.0, 20.0])
def test_uniform_path_decays_like_gamma(a):
    # steps 1 .. 300 between two fixed ends, (a/4)(x_t - x_{t-1})^2
    M = np.diag(np.full(300, 1 + a)) - a / 2 * (np.eye(300, k=1) + np.eye(300, k=-1))
    moved = np.linalg.solve(M, a / 2 * np.eye(300)[0])
    d = np.arange(1, 9)
    np.testing.assert_allclose(moved[d - 1], gamma_T(a) ** d, rtol=1e-10)


@pytest.mark.parametrize(
    ("a", "holds"), [(0.05, False), (0.6108, False), (0.6110, True), (4.0, True)]
)
def test_stated_global_bound_fails_for_weak_couplings(a, holds):
    stated = result("thm:global-exp-decay", "stated", "path:1", a, 0.0)
    assert stated.guarantee is holds
    C, rate = stated.values["C_G"], stated.values["rho_G"]
    for d in (1, 2):
        assert bool(steepest(a, d) <= C * rate**d) is holds
