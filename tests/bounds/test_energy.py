import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp

from nearsight.bounds.energy import NEIGHBOURS, NEXT, OWN, SHARES, Couplings, best_share, row_bound
from nearsight.bounds.formula import plain_floats
from nearsight.bounds.theorems.lateral_energy import LateralEnergy

from . import textbook_sharp
from .support import exact, log_uniform, settings_of, ulps

ROWS = {"own": OWN, "next": NEXT, "neighbours": NEIGHBOURS}
small = log_uniform(-4, 1.5)


@pytest.mark.parametrize("name", ROWS)
@settings(max_examples=25)
@given(
    a=small,
    a_S=small,
    Delta=st.integers(1, 8),
    k=st.integers(2, 30),
    r=st.integers(1, 20),
    share=st.integers(1, SHARES - 1),
)
def test_rows_in_floats(name, a, a_S, Delta, k, r, share):
    k, r = max(k, 3 if name == "next" else 2), max(r, 2 if name == "neighbours" else 1)
    with plain_floats():  # the plain evaluation that searches rely on
        found = row_bound(ROWS[name], Couplings(a, a_S, 1.0, Delta), 4.0, k, r, share)
    text = textbook_sharp.row(name, a, a_S, Delta, 4, k, r, share)
    for value, number in zip(found, text, strict=True):
        if mp.isinf(number) or number > 1e100:
            assert value > 1e90
        elif number > 1e-250:
            assert value == pytest.approx(float(number), rel=1e-9)


@settings(max_examples=10)
@given(s=settings_of(k=(2, 60), r=(1, 40)))
def test_values_to_the_last_bits(s):
    a, a_S, _ = exact(s)
    values = LateralEnergy().in_floats(s)
    c = Couplings(float(a), float(a_S), 1.0, s.max_degree)
    for name, row in ROWS.items():
        if (name == "next" and s.k < 3) or (name == "neighbours" and s.r < 2):
            assert name not in values
            continue
        with plain_floats():
            share = best_share(row, c, float(s.growth.eta(s.r)), s.k, s.r)
        text = textbook_sharp.row(name, a, a_S, s.max_degree, s.growth.eta(s.r), s.k, s.r, share)
        assert ulps(values[name], text[0]) <= 64


@pytest.mark.parametrize("name", ROWS)
@pytest.mark.parametrize(("a", "a_S"), [(0.3, 0.2), (2.0, 0.05), (0.01, 3.0)])
def test_best_share_is_the_best_of_the_grid(name, a, a_S):
    c = Couplings(a, a_S, 1.0, 3)
    share = best_share(ROWS[name], c, 4.0, 5, 4)
    costs = []
    for i in range(1, SHARES):
        in_D, _, in_Z = textbook_sharp.row(name, a, a_S, 3, 4, 5, 4, i, dps=40)
        costs.append(float(in_D + in_Z))
    assert costs[share - 1] <= min(costs) * (1 + 1e-12)


def test_without_coupling_nothing_moves():
    assert row_bound(OWN, Couplings(0.5, 0.0, 1.0, 2), 2.0, 5, 3, 100).D_part == 0
    still = row_bound(OWN, Couplings(0.0, 0.5, 1.0, 2), 2.0, 5, 3, 100)
    assert still.D_part > 0
    assert still.y_part == still.Z_part == 0
    two = row_bound(OWN, Couplings(0.5, 0.5, 1.0, 2), 2.0, 2, 3, 7)
    assert two == row_bound(OWN, Couplings(0.5, 0.5, 1.0, 2), 2.0, 2, 3, 150)


def test_rows_fall_with_the_radius():
    r = np.arange(2, 40)
    for row in ROWS.values():
        found = row_bound(row, Couplings(0.4, 0.3, 1.0, 2), 2.0, 6, r, 90).D_part
        assert np.all(np.diff(found) < 0)
