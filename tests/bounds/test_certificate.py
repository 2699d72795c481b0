import numpy as np
import pytest
from hypothesis import given, settings
from mpmath import mp

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.bounds.certificate import Form, Gap, best_shares, cost_gap, step_error
from nearsight.bounds.energy import Couplings

from . import textbook_sharp
from .support import exact, growth, log_uniform, settings_of, ulps

KINDS = ["vi", "mix", "smooth"]
weak = log_uniform(-4, 0.5)


def compare(kind, s, limit=64):
    (bound,) = (b for b in bounds_for("nearsight:sharp-cr") if b.variant == kind)
    values = bound.in_floats(s)
    a, a_S, condition = exact(s)
    eta = s.growth.eta(s.r)
    floats = Couplings(float(a), float(a_S), float(condition), s.max_degree)
    shares = best_shares(kind, floats, eta, s.k, s.r)
    text = textbook_sharp.sharp_excess(kind, a, a_S, condition, s.max_degree, eta, s.k, s.r, shares)
    for name, number in zip(("P_0", "P_1", "P_2", "cr_minus_one"), text, strict=True):
        assert ulps(values[name], number) <= limit, name
    return values, text


@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=8)
@given(s=settings_of(ratio=weak, k=(2, 40), r=(1, 30)))
def test_ratio_from_the_text(kind, s):
    compare(kind, s)


@pytest.mark.parametrize("kind", KINDS)
@settings(max_examples=6)
@given(s=settings_of(ratio=log_uniform(-150, 2), k=(2, 8), r=(1, 6)))
def test_ratio_from_the_text_over_the_whole_range(kind, s):
    compare(kind, s)


@pytest.mark.parametrize("kind", KINDS)
@pytest.mark.parametrize(("k", "r"), [(2, 1), (2, 4), (3, 1), (3, 3), (4, 1), (4, 2), (9, 6)])
@pytest.mark.parametrize("spec", ["tree:3", "path:2"])
def test_ratio_at_every_case_of_k_and_r(kind, k, r, spec):
    compare(kind, Setting(Parameters(1.0, 2.0, 0.3, 0.11), growth(spec), k, r))


@settings(max_examples=8)
@given(s=settings_of(ratio=weak, k=(2, 30), r=(1, 20)))
def test_step_error_from_the_text(s):
    a, a_S, condition = exact(s)
    eta = s.growth.eta(s.r)
    c = Couplings(float(a), float(a_S), float(condition), s.max_degree)
    shares = best_shares("smooth", c, eta, s.k, s.r)
    (bound,) = (b for b in bounds_for("thm:per-step-err") if b.tier == "sharp")
    values = bound.in_floats(s)
    _, top, lat, *_ = textbook_sharp.step_error(a, a_S, s.max_degree, eta, s.k, s.r, shares)
    for name, form in (("top", top), ("lateral", lat)):
        assert ulps(values[f"{name}_D"], form.D) <= 64
        assert ulps(values[f"{name}_y"], form.y) <= 64
    with mp.workdps(60):
        assert ulps(values["E_D"], (top + lat).D) <= 64


def test_closing_solves_its_equation():
    s = Setting(Parameters(1.0, 1.0, 1.0, 0.5), growth("line"), 4, 3)
    values, _ = compare("vi", s)
    y2 = values["cr_minus_one"] * (1 + 1 / 3.0)  # 2a + x = 3
    y = np.sqrt(y2)
    bound = 2 * (values["P_0"] + values["P_1"] * y + values["P_2"] * y2)
    assert y2 <= bound * (1 + 1e-12)  # y is at most the root of y^2/2 = gap


def test_forms():
    u, v = Form(2.0, 3.0), Form(5.0, 7.0)
    assert Gap.product(u, v) == (10.0, 29.0, 21.0)
    assert Gap.product(u, v).at(2.0) == (2 + 3 * 2) * (5 + 7 * 2)
    assert u.plus(v.times(2.0)) == (12.0, 17.0)


@pytest.mark.parametrize(("k", "r"), [(1, 1), (2, 0), (np.array([1, 2]), 3)])
def test_too_little_look_ahead(k, r):
    c = Couplings(0.1, 0.1, 1.0, 2)
    with pytest.raises(ValueError, match=r"k >= 2 and r >= 1"):
        step_error(c, 2, k, r, best_shares("vi", c, 2, 2, 1))


def test_unknown_kind():
    c = Couplings(0.1, 0.1, 1.0, 2)
    e = step_error(c, 2, 3, 2, best_shares("vi", c, 2, 3, 2))
    with pytest.raises(ValueError, match="smooth, mix, vi"):
        cost_gap("sharp", c, 3, e)


@settings(max_examples=8)
@given(s=settings_of(ratio=log_uniform(-3, 0.3), k=(5, 60), r=(4, 40)))
def test_sharp_is_at_most_repaired(s):
    (sharp,) = (b for b in bounds_for("nearsight:sharp-cr") if b.variant == "vi")
    value = sharp.evaluate(s).values["cr_minus_one"]
    for paper in bounds_for("coro:CR-LPC"):
        if paper.tier == "repaired":
            other = paper.evaluate(s)
            if other.values["cr_minus_one"] is not None:
                assert value is not None
                assert value <= other.values["cr_minus_one"]
