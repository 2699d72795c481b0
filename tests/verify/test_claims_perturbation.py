"""Claims on perturbations: verdicts, mutants, and the counterexamples redone by other means."""

from fractions import Fraction
from functools import cache

import mpmath
import numpy as np
import pytest
from scipy.optimize import minimize_scalar

from nearsight.graphs import InputError
from nearsight.verify import catalogue
from nearsight.verify.claims import (
    _rational,
    adding_constraints,
    b1b2_choice,
    banded_inverse,
    final_step,
    first_order,
    global_exp_decay,
    joint_decay,
    networked_exp_decay,
    networked_exp_decay_columns,
    networked_exp_decay_lines,
    networked_exp_decay_slices,
    networked_exp_decay_text,
    networked_exp_decay_tight,
    networked_soco,
    networked_soco_steps,
    products,
    slice_decay,
    slice_decay_weights,
)
from nearsight.verify.engines.search import Search

MODULES = (
    networked_exp_decay, networked_exp_decay_slices, networked_exp_decay_columns,
    networked_exp_decay_lines, networked_exp_decay_text, networked_exp_decay_tight, b1b2_choice,
    networked_soco, networked_soco_steps, banded_inverse, global_exp_decay, slice_decay,
    slice_decay_weights, joint_decay, first_order, products, final_step, adding_constraints,
)  # fmt: skip
CLAIMS = {claim.key: claim for module in MODULES for claim in module.CLAIMS}
T = "thm:networked-exp-decay"
REFUTED = {
    T, f"{T}[a]", f"{T}:meta[a]", f"{T}:e1", f"{T}:e1[a]", f"{T}:e1[b]", f"{T}:e2", f"{T}:e2[a]",
    f"{T}:e2[b]", f"{T}:e2[c]", f"{T}:e3", f"{T}:e3[c]", f"{T}:e4", f"{T}-tight[e]",
    "sec:main:perturb#averaging", "sec:main:perturb#b1b2-choice[d]",
    "sec:main:perturb#b1b2-choice[e]", "prop:exp-decay-networked-SOCO",
    "prop:exp-decay-networked-SOCO[a]", "prop:exp-decay-networked-SOCO[b]",
    "prop:exp-decay-networked-SOCO[e]", "equ:thm:SOCO-sensitivity:e1",
    "thm:global-exp-decay", "thm:global-exp-decay[a]",
    "thm:global-exp-decay[b]", "thm:global-exp-decay[c]", "le:foc[a]",
    "sec:outline-network-perturbation-bound#special-case", "le:final-step[b]", "le:final-step[d]",
    "apx:adding-constraints", "apx:adding-constraints[b]", "apx:adding-constraints[c]",
}  # fmt: skip


@cache
def judged(key):
    return CLAIMS[key].judge("quick")


@pytest.mark.parametrize("key", CLAIMS)
def test_verdicts(key):
    claim, found = CLAIMS[key], judged(key)
    assert (found.verdict == "refuted") == (key in REFUTED)
    if not any(isinstance(check, Search) for check in claim.checks):
        assert found.verdict != "supported"
    assert bool(claim.repaired) == (key in REFUTED)
    if found.verdict == "refuted":
        assert found.engine == "exact"
        assert found.measured > found.bound


def test_keys_are_there_and_the_uses_form_no_circle():
    assert len(CLAIMS) == sum(len(module.CLAIMS) for module in MODULES)
    left = {claim.key: set(claim.uses) for claim in catalogue()}
    assert set().union(*left.values()) <= set(left)
    while left:
        free = {key for key, uses in left.items() if not uses & set(left)}
        assert free
        left = {key: uses for key, uses in left.items() if key not in free}


def g(y):
    s = mpmath.sqrt(1 + mpmath.mpf(y))
    return (s - 1) / (s + 1)


@pytest.mark.parametrize(
    ("key", "moved"), [(T, "l_T"), (f"{T}[a]", "l_S"), (f"{T}:e3", "l_T"), (f"{T}:e4", "l_T")]
)
def test_two_agents_in_floats(key, moved):
    i = judged(key).instance
    mu, l_T, l_S = (float(Fraction(i[name])) for name in ("mu", "l_T", "l_S"))
    c = {"l_T": l_T, "l_S": l_S}[moved]
    assert judged(key).measured == pytest.approx(c / 2 / (mu + l_T + l_S / 2))
    rate = float(mpmath.sqrt(g(2 * l_T / mu if moved == "l_T" else l_S / mu)))
    assert judged(key).bound == pytest.approx(2 * np.sqrt(l_S * l_T) / mu * rate)


def test_steps_in_floats():
    assert judged(f"{T}:e1").bound == pytest.approx(float(2 * 16 / 49 * g(32 / 49)))
    assert judged(f"{T}:e2").bound == pytest.approx(9 / 16 * (1 - 2 / np.sqrt(1 + 9 / 16)))
    assert judged(f"{T}:e2[c]").bound == pytest.approx(float(64 / 49 * g(32 / 49)))
    assert judged(f"{T}:e3[c]").measured == pytest.approx(1 - 2 / np.sqrt(1 + 2 * 24))
    assert judged(f"{T}:e3[c]").bound == pytest.approx(float(g(24)))


def test_the_helpers_with_all_their_vertices():
    m = networked_soco.HELPERS
    M, C = np.eye(m + 1), np.zeros(m + 1)  # helpers, then u0
    for i in range(m):
        v = np.zeros(m + 1)
        v[i], v[m] = 399 / 401, -40 / 401
        assert v @ v == pytest.approx(1)
        M += np.outer(v, v)
        M[i, i] += 0.36
        C[i] = 0.48
    moved = np.linalg.solve(M, C)[m]
    found = judged("prop:exp-decay-networked-SOCO")
    assert found.measured == pytest.approx(moved)
    assert found.bound == pytest.approx(float(2 * g(m)))
    assert moved > found.bound


def test_five_helpers_by_numpy():
    M = np.eye(6)
    for i in range(5):  # helper i with v, and with u0 = 5
        M[i, i] += 1
        M[5, 5] += 0.5
        M[i, 5] = M[5, i] = -0.5
    inverse = np.linalg.inv(M)
    found = judged("equ:thm:SOCO-sensitivity:e1")
    assert found.measured == pytest.approx((inverse[5, :5].sum() / 2) ** 2)
    assert found.bound == pytest.approx((inverse[5, :5] ** 2).sum())


def test_a_minimiser_that_jumps():
    def psi(y):
        grid = np.linspace(-2, 2, 4001)
        x = grid[np.argmin(grid**2 / 2 + 1 / (1 + (grid - y) ** 2))]
        f = lambda x: x**2 / 2 + 1 / (1 + (x - y) ** 2)  # noqa: E731
        return minimize_scalar(f, bounds=(x - 0.01, x + 0.01), method="bounded").x

    jump = abs(psi(-0.01) - psi(0.01))
    found = judged("prop:exp-decay-networked-SOCO[a]")
    assert jump > found.measured > found.bound == pytest.approx(2 * 4 * 0.02)
    z = np.linspace(-9, 9, 10001)
    assert 2 * np.abs((6 * z**2 - 2) / (1 + z**2) ** 3).max() <= 4  # the norm of the Hessian


def test_chains_in_extended_precision():
    found = judged("thm:global-exp-decay[a]")
    b = mpmath.mpf(16) / 49 / 2
    M = mpmath.matrix(3, 3)
    for i in range(3):
        M[i, i] = 1 + 2 * b
        if i:
            M[i, i - 1] = M[i - 1, i] = -b
    assert found.measured == pytest.approx(float((M**-1)[2, 0] * b))
    assert found.bound == pytest.approx(float(4 * b * g(4 * b) ** 3))
    a, p, q = Fraction(259, 450), Fraction(624, 1000), Fraction(781, 1000)
    near = judged("thm:global-exp-decay[b]")
    assert near.measured == pytest.approx(float(a * p * q / (1 + a * p * p)))
    assert p * p + q * q <= 1


def test_sums_over_grids():
    # growth of a wide grid by breadth first search
    from nearsight.graphs import NetworkGrowth, parse_graph

    growth = NetworkGrowth(parse_graph("grid:41x41"))
    assert growth.transform(0.5) == pytest.approx(float(b1b2_choice.grid_sum(2)), rel=1e-5)
    assert judged("sec:main:perturb#b1b2-choice[d]").measured == 8 * 3**4
    for dimension, printed in ((1, 16), (2, 63), (3, 214.5)):
        D = 2 * dimension
        assert 8 * 3**dimension > max(16, D**3 * (1 - 1 / (4 * D**2))) == printed


def test_the_cube_has_no_slater_point():
    y = np.linspace(-3, 3, 601)
    value = np.maximum(np.abs(y) - 1, 0) ** 3
    assert value.min() == 0
    assert (np.diff(value, 2) >= -1e-12).all()
    assert adding_constraints.cube(Fraction(-2)) == 1


def test_rational_responses_by_numpy():
    rng = np.random.default_rng(0)
    for _ in range(20):
        l_1, l_2 = (Fraction(int(z), 7) for z in rng.integers(1, 30, 2))
        pairs = [
            _rational.difference("x", "out", l_1),
            _rational.tilted("y", "x", l_2, Fraction(3, 5), Fraction(4, 5)),
        ]
        found = _rational.response(["x", "y"], pairs, "out", Fraction(2))
        cross = -l_2 * Fraction(12, 25)
        diagonal = (2 + l_1 / 2 + l_2 * Fraction(16, 25), 2 + l_2 * Fraction(9, 25))
        M = np.array([[diagonal[0], cross], [cross, diagonal[1]]], dtype=float)
        expected = np.linalg.solve(M, [float(l_1 / 2), 0])
        assert [float(found["x"]), float(found["y"])] == pytest.approx(list(expected))


def test_costs_outside_the_class_are_rejected():
    with pytest.raises(InputError, match="Hessian"):
        _rational.tilted("x", "y", Fraction(1), Fraction(4, 5), Fraction(4, 5))
    import sympy

    with pytest.raises(InputError, match="rational"):
        _rational.exact(sympy.sqrt(2))
