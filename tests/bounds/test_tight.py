import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mpmath import mp, mpf

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.bounds.formula import plain_floats
from nearsight.bounds.tight import choice, one_away, optimise, paper_choice, sums

from . import textbook
from .support import FAMILIES, exact, growth, log_uniform, settings_of, ulps


@pytest.mark.parametrize("spec", FAMILIES)
@settings(max_examples=10)
@given(data=st.data())
def test_values_from_the_text(spec, data):
    b = data.draw(st.tuples(log_uniform(-3, 3), log_uniform(-3, 3)))
    s = data.draw(settings_of(specs=[spec], b=b))
    a, a_S, _ = exact(s)
    total = textbook.sums(spec, *b)
    (bound,) = bounds_for("thm:networked-exp-decay-tight")
    values = bound.in_floats(s)
    assert ulps(values["a"], total[0]) <= 8
    assert ulps(values["a_tilde"], total[1]) <= 8
    if mp.isinf(total[0]) or mp.isinf(total[1]):
        return
    lo = textbook.local_tight(a, a_S, s.max_degree, *b, *total)
    for name, number in lo._asdict().items():
        if name in ("C_1", "C_2") and lo.rho_T >= 1:
            continue  # outside the hypotheses: no constants
        assert ulps(values[name], number) <= 64, name
    with mp.workdps(500):
        assert ulps(values["margin_T"], 1 - 8 * total[1] * a) <= 64
        assert ulps(values["margin_S"], 1 - s.max_degree * a_S * (mpf(b[0]) + b[1]) / 4) <= 64


@pytest.mark.parametrize("spec", ["line", "tree:3", "grid2"])
def test_paper_choice_sums_to_at_most_two(spec):
    total = sums(growth(spec), *paper_choice(growth(spec).max_degree))
    assert total.a <= 2
    assert total.a_tilde <= 2


@pytest.mark.parametrize("spec", [*FAMILIES, "grid:5x7", "path:1"])
@pytest.mark.parametrize(("a_T", "a_S"), [(1e-3, 1e-3), (0.02, 1e-4), (1e-6, 0.05), (0.0, 0.0)])
def test_optimised_parameters_obey_the_conditions(spec, a_T, a_S):
    b = optimise(growth(spec), a_T, a_S)
    found = choice(growth(spec), a_T, a_S, *b)
    assert min(b) > 0
    b_1, b_2 = (v.ravel() for v in np.meshgrid(*[np.logspace(-3, 4, 40)] * 2))
    value = one_away(found) if min(found.margins) >= 0 else np.inf
    with plain_floats():
        other = choice(growth(spec), a_T, a_S, b_1, b_2)
        good = (np.minimum(*other.margins) >= 0) & np.isfinite(other.sums.a)
        rest = np.asarray(one_away(other))[good]
    assert value <= np.min(rest, initial=np.inf) * 1.02


@pytest.mark.parametrize("b", [(1e-7, 1e-6), (1e-3, 10.0), (5.0, 1e-9)])
def test_sums_next_to_the_pole_in_arrays(b):
    bound = bounds_for("thm:networked-exp-decay-tight")[0]
    numbers = bound.in_floats(Setting(Parameters(1, 1, 1e-9, 1e-9), growth("line"), b=b))
    arrays = bound.in_floats(
        Setting(Parameters(1, 1, np.array([1e-9, 1e-8]), 1e-9), growth("line"), b=b)
    )
    for name in ("a", "a_tilde"):
        entry = float(np.ravel(arrays[name])[0])
        assert abs(entry - numbers[name]) <= 8 * np.spacing(numbers[name])
