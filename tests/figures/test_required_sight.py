"""The required sight: plans against brute force over the theorem, lower bounds against them."""

import numpy as np
import pytest

import nearsight as ns
from nearsight.figures import SIZES, picture_named

PICTURE = picture_named("required-sight")
GIVEN = {"graph": "ring:41", "l_f": 1.0, "l_T": 0.5, "l_S": 0.25, "target": (3.0, 1.02)}


@pytest.fixture(scope="module")
def table():
    return PICTURE.compute(PICTURE.subject.with_typed(GIVEN, PICTURE.takes), lambda text: None)


def test_couplings_grow_in_proportion_from_a_hundredth_to_a_hundred(table):
    l_T = table.numbers("l_T")
    assert table.numbers("l_S") == pytest.approx(l_T / 2)
    assert (l_T[0], l_T[-1]) == pytest.approx((0.01, 100))
    assert table.numbers("scale") == pytest.approx(l_T / 0.5)


@pytest.mark.parametrize("row", [0, 4, 7])
def test_the_sharp_pair_is_the_least_that_the_theorem_allows(table, row):
    at = table.records()[row]
    k, r = (v.ravel() for v in np.meshgrid(np.arange(2, 16), np.arange(1, 21), indexing="ij"))
    costs = {"mu": 1, "l_f": 1.0, "l_T": at["l_T"], "l_S": at["l_S"]}
    (bound, *_) = ns.bound(**costs, graph="ring:41", k=k, r=r, label="nearsight:sharp-cr")
    good = bound.values["cr_minus_one"] <= 0.02  # the second target
    least = min(zip(k[good] + r[good], k[good], strict=True))
    assert (at["k_sharp"] + at["r_sharp"], at["k_sharp"]) == least


def test_no_guaranteed_pair_is_below_a_lower_bound(table):
    for row in table.records():
        for tier in ("stated", "repaired", "sharp"):
            if row[f"guarantee_{tier}"] and row[f"k_{tier}"] is not None:
                assert row[f"k_{tier}"] >= row["k_lower"]
                assert row[f"r_{tier}"] >= row["r_lower"]


def test_lower_bounds_exclude_what_is_below_and_grow_with_the_class(table):
    for row in table.records()[4:10:5]:
        costs = {"mu": 1, "l_f": 1.0, "l_T": row["l_T"], "l_S": row["l_S"]}
        if row["k_lower"] > 1:
            found = ns.lower_bound(**costs, graph="ring:41", k=row["k_lower"] - 1, r=20)
            assert found.temporal.cr_minus_one > 0.02
        found = ns.lower_bound(**costs, graph="ring:41", k=row["k_lower"], r=row["r_lower"])
        assert max(found.temporal.cr_minus_one, found.spatial.cr_minus_one) <= 0.02
    assert (np.diff(table.numbers("k_lower")) >= 0).all()
    assert (np.diff(table.numbers("r_lower")) >= 0).all()


def test_what_the_printed_bound_needs_is_marked_where_it_is_no_guarantee(table):
    assert table.records()[0]["guarantee_stated"] == 0
    assert table.records()[-1]["guarantee_stated"] == 1


def test_without_couplings_the_picture_says_what_does():
    at = PICTURE.subject.with_typed({**GIVEN, "l_T": 0.0, "l_S": 0.0}, PICTURE.takes)
    figure = PICTURE.draw(PICTURE.compute(at, lambda text: None), at, SIZES["paper"])
    said = [t.get_text() for axes in figure.axes for t in axes.texts]
    assert said == ["nothing is coupled: k = 2 does", "nothing is coupled: r = 1 does"]
