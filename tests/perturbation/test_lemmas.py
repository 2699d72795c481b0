"""Every lemma against its bound, and the comparisons themselves."""

import math
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from nearsight.graphs import InputError
from nearsight.perturbation import lemmas as package
from nearsight.perturbation.comparison import Comparison, worst
from nearsight.perturbation.lemmas import lemmas, measure_lemma

LABELS = (
    "thm: l-power",
    "thm:graph-induced-band-mat-inverse",
    "le: H-inverse",
    "le:J-properties",
    "le:J-bound",
    "le:final-step",
    "le:foc",
)
PARTS = {
    "thm: l-power": {"stated", "sharp"},
    "thm:graph-induced-band-mat-inverse": {
        f"{where}{tier}" for where in ("", "Hessian, ") for tier in ("stated", "sharp", "exact")
    },
    "le: H-inverse": {f"{a}, {b}" for a in ("radius", "remainder") for b in ("stated", "sharp")},
    "le:J-properties": {
        "zero pattern",
        "number of terms",
        "number of terms, away from the ends",
    },
    "le:J-bound": {"stated", "sharp"},
    "le:final-step": {"K, stated", "K, as used", "R, stated", "product"},
    "le:foc": {"derivative", "first level"},
}


def test_every_file_of_the_folder_is_a_lemma():
    files = {p.stem for p in Path(package.__file__).parent.glob("[!_]*.py")}
    assert len(files) == len(lemmas())
    assert set(lemmas()) == set(LABELS)
    assert all(lemma.title for lemma in lemmas().values())


@pytest.mark.parametrize("label", LABELS)
def test_no_random_instance_violates_a_lemma(label):
    found = measure_lemma(label, 60, seed=500)
    assert {c.part for c in found if c.hypotheses} == PARTS[label]
    assert [c for c in found if c.violates] == []


@pytest.mark.slow
@pytest.mark.parametrize("label", LABELS)
def test_no_instance_of_a_long_search_violates_a_lemma(label):
    assert [c for c in measure_lemma(label, 1500, seed=10_000) if c.violates] == []


@pytest.mark.parametrize("label", LABELS)
def test_a_bound_below_what_was_measured_is_a_violation(label):
    for c in measure_lemma(label, 20, seed=7):
        beyond = c.measured + 2 * c.tolerance + 1 if c.relation == "==" else 0.999 * c.measured
        shrunk = replace(c, bound=beyond)
        if c.measured or c.relation == "==":
            assert not shrunk.holds
            assert shrunk.violates == c.hypotheses
            assert shrunk.ratio > 1


@pytest.mark.parametrize("label", LABELS)
def test_a_seed_gives_the_same_comparisons_again(label):
    for c in measure_lemma(label, 10, seed=3, keep=2):
        assert c in lemmas()[label].measure(c.seed)
        assert c.label == label


def test_the_worst_come_first_and_are_the_worst():
    all_of_them = [c.ratio for s in range(30) for c in lemmas()["le:J-bound"].measure(s)
                   if c.part == "sharp"]  # fmt: skip
    kept = [c.ratio for c in measure_lemma("le:J-bound", 30, keep=4) if c.part == "sharp"]
    assert kept == sorted(all_of_them, reverse=True)[:4]


@pytest.mark.parametrize(
    ("arguments", "named"),
    [
        (("le:nothing", 1, 0), "label"),
        (("le:foc", 0, 0), "instances"),
        (("le:foc", 1, -1), "seed"),
    ],
)
def test_measure_lemma_rejects(arguments, named):
    with pytest.raises(InputError, match=named) as caught:
        measure_lemma(*arguments)
    assert caught.value.argument == named


def test_ratio_and_holds_agree():
    rng = np.random.default_rng(1)
    for _ in range(300):
        measured, bound, tolerance = 10.0 ** rng.uniform(-3, 3, 3)
        for relation in ("<=", "=="):
            c = Comparison("x", "y", measured, bound, relation, tolerance)
            assert c.holds == (c.ratio <= 1)
            assert not replace(c, hypotheses=False).violates


def test_zero_beside_zero():
    assert Comparison("x", "y", 0.0, 0.0).holds
    assert Comparison("x", "y", 0.0, 0.0).ratio == 0
    assert Comparison("x", "y", 1.0, 0.0).ratio == math.inf
    assert not Comparison("x", "y", 1.0, 0.0).holds
    assert Comparison("x", "y", 1.0, math.inf).ratio == 0


@pytest.mark.parametrize(
    "wrong",
    [
        {"measured": math.nan},
        {"measured": math.inf},
        {"bound": math.nan},
        {"tolerance": -1.0},
        {"relation": "<"},
    ],
)
def test_comparison_rejects(wrong):
    with pytest.raises(InputError, match=next(iter(wrong))):
        Comparison(**{"label": "x", "part": "y", "measured": 1.0, "bound": 1.0} | wrong)


def test_worst_takes_the_largest_share():
    (c,) = worst("x", "y", np.array([1.0, 0.0, 3.0]), np.array([2.0, 0.0, 4.0]), seed=5)
    assert (c.measured, c.bound, c.seed) == (3.0, 4.0, 5)
    (c,) = worst("x", "y", np.array([1.0, 1e-300]), np.array([2.0, 0.0]))
    assert not c.holds
    assert worst("x", "y", np.zeros((0, 3)), 1.0) == ()
