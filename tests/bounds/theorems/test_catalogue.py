"""Every value of every bound: floats against mpmath, and what all results have in common."""

import itertools
from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from mpmath import mp, mpf

from nearsight.bounds import Parameters, Setting, bounds_for, catalogue
from nearsight.graphs import parse_growth

from ..support import growth, log_uniform, moderate, settings_of, ulps

LABELS = {
    "thm:networked-exp-decay",
    "thm:networked-exp-decay-tight",
    "nearsight:joint-decay",
    "nearsight:lateral-energy",
    "thm:global-exp-decay",
    "prop:exp-decay-networked-SOCO",
    "thm:graph-induced-band-mat-inverse",
    "thm:per-step-err",
    "thm:alg-perf-bound-err-inject",
    "coro:CR-LPC",
    "coro:pure-exp-decay",
    "nearsight:sharp-cr",
    "thm:bottleneck",
    "nearsight:temporal-lower-bound",
    "nearsight:ring-of-blocks",
    "coro:resource-augmentation",
}
GRAPHS = ["path:1", "path:2", "ring:9", "star:6", "grid:5x7", "complete:5"]
DEGENERATE = ["line", "path:1", "path:2"]
# its values with k and r are a plan, not a formula
PLANNED = "coro:resource-augmentation"
CLOSED = [b for b in catalogue() if b.label != PLANNED]
names = {b: f"{b.label} {b.tier} {b.variant}".strip() for b in catalogue()}
every_bound = pytest.mark.parametrize("bound", catalogue(), ids=names.get)
every_closed = pytest.mark.parametrize("bound", CLOSED, ids=names.get)


def unplanned(s):
    return replace(s, k=None, r=None)


def test_every_label_is_present():
    assert {b.label for b in catalogue()} == LABELS


def test_no_statement_is_listed_twice():
    keys = [(b.label, b.tier, b.variant) for b in catalogue()]
    assert len(set(keys)) == len(keys)


def test_order_of_labels_and_tiers():
    tiers = {"stated": 0, "repaired": 1, "sharp": 2}
    keys = [(b.label.startswith("nearsight"), b.label, tiers[b.tier]) for b in catalogue()]
    assert keys == sorted(keys)


def test_bounds_of_one_label():
    assert [b.tier for b in bounds_for("thm:global-exp-decay")] == ["stated", "repaired", "sharp"]
    with pytest.raises(KeyError, match="no-such") as caught:
        bounds_for("no-such")
    assert all(label in str(caught.value) for label in LABELS)


def agree(bound, s, limit=64):
    """Compare every value in floats with the same formula in mpmath, 60 digits."""
    result = bound.in_floats(s)
    with mp.workdps(60):
        exact = bound.values(s.converted("mpmath"))
        if not np.isfinite(result.get("a_tilde", 0.0) + result.get("a", 0.0)):
            return  # a series diverges: no constants, see test_divergent_series_give_no_constants
        for name, value in result.items():
            if value is None:
                continue
            number = exact[name] if isinstance(exact[name], mpf) else mpf(exact[name])
            if mp.isnan(number):
                assert np.isnan(value), name
            else:
                assert ulps(value, number) <= limit, (name, value, mp.nstr(number, 25))


@every_closed
@settings(max_examples=5)
@given(s=settings_of(b=(0.75, 3.0)))
def test_floats_agree_with_sixty_digits(bound, s):
    agree(bound, s)


@every_closed
@settings(max_examples=5)
@given(s=settings_of(ratio=moderate, k=(2, 12), r=(1, 8), b=(0.75, 3.0), unconstrained=True))
def test_floats_agree_with_sixty_digits_where_ratios_are_finite(bound, s):
    agree(bound, s)


@every_closed
@settings(max_examples=3)
@given(s=settings_of(specs=GRAPHS, ratio=moderate, k=(2, 12), r=(1, 8), b=(0.5, 2.0)))
def test_floats_agree_with_sixty_digits_on_finite_graphs(bound, s):
    agree(bound, s)


@settings(max_examples=5)
@pytest.mark.parametrize("label", ["thm:networked-exp-decay-tight", "coro:CR-LPC"])
@given(s=settings_of(ratio=log_uniform(-6, -2), k=(2, 12), r=(1, 8)))
def test_floats_agree_at_the_optimised_parameters(label, s):
    for bound in bounds_for(label):
        agree(bound, s)


@pytest.mark.parametrize("bound", bounds_for(PLANNED), ids=names.get)
@given(s=settings_of())
def test_asymptotic_ratios_agree_with_sixty_digits(bound, s):
    agree(bound, unplanned(s), 8)


@every_bound
@pytest.mark.parametrize("spec", ["grid2", "path:2"])
def test_scale_changes_no_bit(bound, spec):
    for seed in range(2):
        rng = np.random.default_rng([seed, len(spec)])
        l_T, l_S = 10.0 ** rng.uniform(-3, 1, 2)
        sizes = {"k": int(rng.integers(2, 7)), "r": int(rng.integers(1, 5))}
        s = Setting(Parameters(1.3, 2.7, l_T, l_S), growth(spec), **sizes, unconstrained=True)
        if bound.label == PLANNED:
            s = unplanned(s)
        before = bound.evaluate(s)
        for factor in (2.0**-400, 2.0**-1, 2.0**300):
            scaled = Parameters(1.3 * factor, 2.7 * factor, l_T * factor, l_S * factor)
            after = bound.evaluate(replace(s, parameters=scaled))
            assert after == before


@every_bound
def test_degenerate_settings_give_numbers_or_reasons(bound):
    couplings = [(0.0, 0.0), (0.0, 0.3), (0.3, 0.0), (0.3, 0.2)]
    sizes = [(None, None)] if bound.label == PLANNED else [(2, 1), (7, 30)]
    for spec, (l_T, l_S), (k, r) in itertools.product(DEGENERATE, couplings, sizes):
        s = Setting(Parameters(1.0, 1.0, l_T, l_S), growth(spec), k, r, unconstrained=True)
        result = bound.evaluate(s)
        assert isinstance(result.guarantee, bool)
        for name, value in result.values.items():
            if value is None:
                assert result.reasons[name]
                assert "\n" not in result.reasons[name]
            else:
                assert np.isfinite(value)
                assert name.endswith(("slack", "margin_T", "margin_S")) or value >= 0


@every_bound
@pytest.mark.parametrize("spec", ["line", "tree:3", "grid:5x7"])
def test_arrays_agree_with_a_loop(bound, spec):
    rng = np.random.default_rng(7)
    l_T, l_S = 10.0 ** rng.uniform(-3, 1, (2, 2, 3))
    mu = np.array([[1.0], [3.0]])
    sizes = {} if bound.label == PLANNED else {"k": 4, "r": 3}
    b = (0.5, 2.0)
    make = lambda *p: Setting(Parameters(*p), growth(spec), **sizes, unconstrained=True, b=b)  # noqa: E731
    together = bound.evaluate(make(mu, 4.0, l_T, l_S))
    guarantees = []
    for i, j in np.ndindex(2, 3):
        alone = bound.evaluate(make(float(mu[i, 0]), 4.0, float(l_T[i, j]), float(l_S[i, j])))
        guarantees.append(alone.guarantee)
        for name, value in together.values.items():
            number = alone.values.get(name)
            entry = np.broadcast_to(np.nan if value is None else value, (2, 3))[i, j]
            if number is None:
                assert np.isnan(entry) or np.isinf(entry), name
            else:
                assert abs(entry - number) <= 8 * np.spacing(abs(number)), name
    assert together.guarantee == all(guarantees)


@every_closed
@pytest.mark.parametrize("spec", ["line", "tree:3", "star:6"])
@pytest.mark.parametrize(("l_T", "l_S", "unconstrained"), [(0.01, 1e-4, True), (1.0, 0.5, False)])
def test_arrays_of_horizons_and_radii_agree_with_a_loop(bound, spec, l_T, l_S, unconstrained):
    p, k, r = Parameters(1.0, 3.0, l_T, l_S), np.array([[2], [3], [9]]), np.array([[1, 2, 8]])
    more = {"unconstrained": unconstrained, "b": (0.5, 2.0)}
    together = bound.evaluate(Setting(p, growth(spec), k, r, **more))
    for i, j in np.ndindex(3, 3):
        alone = bound.evaluate(Setting(p, growth(spec), int(k[i, 0]), int(r[0, j]), **more))
        for name, value in together.values.items():
            number = alone.values.get(name)
            if value is None:
                assert number is None or name in ("next", "neighbours")
                continue
            entry = np.broadcast_to(np.asarray(value, dtype=float), (3, 3))[i, j]
            if number is None:
                assert not np.isfinite(entry), name
            else:
                assert abs(entry - number) <= 8 * np.spacing(abs(number)), name


def test_values_that_fail_one_hypothesis_everywhere_and_one_somewhere():
    # l_T/mu <= 1/16 fails for all, condition <= 1/2 for some (k, r)
    s = Setting(Parameters(1.0, 1.0, 1.0, 0.5), growth("line"), np.array([2, 30]), np.array([1, 9]))
    (bound,) = bounds_for("coro:pure-exp-decay")[:1]
    ratio = bound.evaluate(s).values["cr"]
    assert ratio is None or np.isnan(np.asarray(ratio, dtype=float)).all()
    assert np.asarray(ratio).dtype == float or ratio is None


@every_bound
def test_evaluation_without_k_and_r(bound):
    s = Setting(Parameters(1.0, 2.0, 0.3, 0.2), growth("line"))
    result = bound.evaluate(s)
    for name, value in result.values.items():
        assert (value is None) == (name in result.reasons)


@every_bound
def test_parameters_at_the_ends_of_the_range(bound):
    for l_T, l_S in [(1e-150, 1e-150), (1e150, 1e150), (1e-150, 1e150), (1e150, 1e-150)]:
        s = Setting(Parameters(1.0, 1e6, l_T, l_S), growth("grid2"), 2, 1, unconstrained=True)
        result = bound.evaluate(unplanned(s) if bound.label == PLANNED else s)
        for name, value in result.values.items():
            assert value is None or np.isfinite(value), name


@pytest.mark.parametrize("label", ["thm:networked-exp-decay-tight", "coro:CR-LPC"])
def test_divergent_series_give_no_constants(label):
    s = Setting(Parameters(1.0, 1.0, 1e-3, 1e-3), growth("tree:3"), 9, 9, b=(0.75, 3.0))
    (*_, bound) = bounds_for(label)  # 1/(1 + b_1) > 1/2
    result = bound.evaluate(s)
    assert not result.guarantee
    assert result.values["a_tilde"] is result.values["C_1"] is result.values["rho_T"] is None
    assert "a_tilde" in result.reasons["C_1"]


def test_poly_of_any_exponent():
    p = Parameters(1.0, 1.0, 1e-3, 1e-3)
    s = Setting(p, parse_growth("poly:2.5,1.5", 2), 4, 3, b=(1.0, 3.0))
    for bound in CLOSED:
        assert bound.evaluate(s).label == bound.label
