import numpy as np
import pytest

from nearsight.bounds import Parameters, Setting, bounds_for
from nearsight.graphs import InputError

from .support import growth

P = Parameters(1.0, 1.0, 1.0, 0.5)


def evaluate(label, tier, parameters=P, variant="", spec="line", **more):
    (bound,) = (b for b in bounds_for(label) if (b.tier, b.variant) == (tier, variant))
    return bound.evaluate(Setting(parameters, growth(spec), **more))


@pytest.mark.parametrize(("name", "least"), [("k", 2), ("r", 1)])
@pytest.mark.parametrize("bad", [0, -3, 2.5, "3", np.array([4, 0]), np.array([2.0]), np.nan])
def test_bad_horizons_and_radii(name, least, bad):
    with pytest.raises(InputError, match=rf"^{name} = [^\n]*integer >= {least}[^\n]*$"):
        Setting(P, growth("line"), **{name: bad})


@pytest.mark.parametrize("b", [(0.0, 1.0), (1.0, -1.0), (np.inf, 1.0), (1.0, np.nan)])
def test_bad_parameters_of_the_tight_theorem(b):
    with pytest.raises(InputError, match=r"^b = [^\n]*> 0[^\n]*$"):
        Setting(P, growth("line"), b=b)


def test_horizons_as_long_arrays_still_give_one_line():
    with pytest.raises(InputError, match=r"^k = [^\n]*$"):
        Setting(P, growth("line"), k=np.zeros(300, dtype=int))


@pytest.mark.parametrize(
    ("l_T", "l_S", "holds"), [(1.0, 1e-6, False), (1.0, 0.5, True), (1e-6, 0.5, False)]
)
def test_stated_local_bound_is_a_guarantee_only_where_implied(l_T, l_S, holds):
    result = evaluate("thm:networked-exp-decay", "stated", Parameters(1.0, 1.0, l_T, l_S))
    assert result.guarantee is holds
    assert result.values["C_1"] == pytest.approx(2 * np.sqrt(2 * l_T * l_S), rel=1e-15)
    assert evaluate("thm:networked-exp-decay", "repaired", Parameters(1, 1, l_T, l_S)).guarantee


@pytest.mark.parametrize(("a", "holds"), [(0.6109052766, False), (0.6109052768, True), (0.0, True)])
def test_threshold_of_the_stated_global_bound(a, holds):
    assert evaluate("thm:global-exp-decay", "stated", Parameters(1, 1, a, 0.1)).guarantee is holds


def test_sharp_global_constant():
    value = evaluate("thm:global-exp-decay", "sharp").values["C_G"]
    # 1/(2 gamma_T sqrt 2) with gamma_T = 2 - sqrt 3
    assert value == pytest.approx((2 + np.sqrt(3)) / (2 * np.sqrt(2)), rel=1e-15)
    assert f"{value:.2f}" == "1.32"


@pytest.mark.parametrize("tier", ["stated", "repaired"])
def test_a_failed_condition_gives_no_number(tier):
    result = evaluate("coro:CR-LPC", tier, k=3, r=2)
    assert not result.guarantee
    assert result.values["condition"] > 0.5
    for name in ("cr", "cr_minus_one", "lateral", "top"):
        assert result.values[name] is None
        assert "condition" in result.reasons[name]


def test_where_the_condition_holds_there_is_a_number():
    result = evaluate("coro:CR-LPC", "repaired", k=30, r=20)
    assert result.guarantee
    assert result.values["condition"] <= 0.5
    assert result.values["cr"] == pytest.approx(1 + result.values["cr_minus_one"])
    assert not result.reasons


def test_failed_hypotheses_of_the_tight_theorem():
    result = evaluate("thm:networked-exp-decay-tight", "stated", b=(1.0, 1.0))
    assert not result.guarantee
    assert result.values["margin_T"] == pytest.approx(1 - 8 * 3)  # a_tilde = 1 + 2/2 + 2/4 + ..
    assert result.values["C_1"] is result.values["rho_T"] is None
    weak = evaluate(
        "thm:networked-exp-decay-tight", "stated", Parameters(1, 1, 0.01, 0.01), b=(1.0, 1.0)
    )
    assert weak.guarantee
    assert weak.values["a_tilde"] == 3
    assert weak.values["rho_T"] == pytest.approx(4 * 3 * 0.01)


@pytest.mark.parametrize("variant", ["mix", "smooth"])
def test_certificates_for_free_decisions_only(variant):
    bound = evaluate("nearsight:sharp-cr", "sharp", variant=variant, k=4, r=3)
    assert not bound.guarantee
    assert bound.values["cr"] is None
    assert "R^n" in bound.reasons["cr"]
    free = evaluate("nearsight:sharp-cr", "sharp", variant=variant, k=4, r=3, unconstrained=True)
    assert free.guarantee
    assert free.values["cr"] > 1


def test_a_certificate_that_does_not_close():
    strong = Parameters(1.0, 1.0, 50.0, 50.0)
    result = evaluate("nearsight:sharp-cr", "sharp", strong, "vi", k=2, r=1)
    assert not result.guarantee
    assert result.values["cr"] is None
    assert "closes" in result.reasons["cr"]


def test_masked_entries_of_arrays():
    k, r = np.array([3, 30]), np.array([2, 20])
    result = evaluate("coro:CR-LPC", "repaired", k=k, r=r)
    assert not result.guarantee
    assert np.isnan(result.values["cr"][0])
    alone = evaluate("coro:CR-LPC", "repaired", k=30, r=20)
    assert result.values["cr"][1] == alone.values["cr"]
    assert "condition" in result.reasons["cr"]


def test_guarantee_over_an_array_needs_every_entry():
    both = evaluate("thm:global-exp-decay", "stated", Parameters(1.0, 1.0, np.array([0.5, 1]), 0.1))
    assert not both.guarantee
    fine = evaluate("thm:global-exp-decay", "stated", Parameters(1.0, 1.0, np.array([0.7, 1]), 0.1))
    assert fine.guarantee


def test_growth_condition_over_an_array_needs_its_strongest_coupling():
    def guarantee(l_S):
        return evaluate(
            "coro:resource-augmentation", "repaired", Parameters(1, 1, 0.1, l_S), spec="tree:3"
        ).guarantee

    weak, strong = 1e-6, 10.0
    assert guarantee(weak)
    assert not guarantee(strong)
    assert not guarantee(np.array([weak, strong]))


def test_lower_bounds_say_so():
    for label in ("thm:bottleneck", "nearsight:temporal-lower-bound", "nearsight:ring-of-blocks"):
        assert {b.kind for b in bounds_for(label)} == {"lower"}
    assert evaluate("thm:global-exp-decay", "sharp").kind == "exact"


@pytest.mark.parametrize("label", ["thm:bottleneck"])
def test_printed_temporal_rate_is_never_a_guarantee(label):
    for a in (1e-3, 1.0, 1e3):
        assert not evaluate(label, "stated", Parameters(1.0, 1.0, a, 1e-3), spec="tree:3").guarantee
