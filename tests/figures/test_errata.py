"""The errata: sides redone by hand, ratios of made-up evidence, what is left out."""

from fractions import Fraction

import pytest

from nearsight.figures import SIZES, picture_named
from nearsight.figures.pictures.errata import _sides
from nearsight.figures.table import Table
from nearsight.verify import Evidence
from nearsight.verify.recorded import recorded

PICTURE = picture_named("errata")


@pytest.fixture(scope="module")
def table():
    return PICTURE.compute(PICTURE.subject, lambda text: None)


def test_every_recorded_refutation_has_its_row(table):
    refuted = {key for key, word in recorded().items() if word == "refuted"}
    assert refuted <= set(table.values("claim"))


def test_the_global_bound_between_slices_by_hand(table):
    """Free steps 1, 2, 3 between two fixed ones, l_T = 16/49: three linear equations."""
    a = Fraction(16, 49)
    on, off = 1 + a, a / 2
    # the first column of the inverse of tridiag(-off, on, -off), its last entry, times off
    determinant = on * (on * on - off * off) - off * off * on
    moved = off**2 / determinant * off
    gamma = Fraction(1, 8)  # sqrt(1 + 2 a) = 9/7
    printed = 2 * a * gamma**3
    (row,) = table.where(claim="thm:global-exp-decay[a]").records()
    assert row["left"] == pytest.approx(float(moved), rel=1e-12)
    assert row["right"] == pytest.approx(float(printed), rel=1e-12)
    assert row["ratio"] == pytest.approx(float(printed / moved), rel=1e-12)


def test_ratios_are_of_printed_bounds_below_the_truth(table):
    for row in table.records():
        if row["ratio"] is not None:
            assert 0 <= row["ratio"] < 1
            assert row["right"] < row["left"]


@pytest.mark.parametrize(
    ("measured", "bound", "ratio"),
    [(4.0, 1.0, 0.25), (2.0, -1.0, 0.0), (-1.0, -2.0, None), (None, 1.0, None), (1.0, 2.0, None)],
)
def test_sides_that_cannot_be_compared_have_no_ratio(measured, bound, ratio):
    evidence = Evidence("refuted", "exact", "made up", {"x": 1}, measured=measured, bound=bound)
    assert _sides(evidence)["ratio"] == ratio


def test_the_worst_come_first_and_those_without_sides_are_counted():
    group = next(iter(PICTURE.draw.__globals__["_GROUPS"]))
    columns = ("claim", "group", "title", "left", "right", "ratio")
    rows = tuple((name, group, "", 1.0, r, r) for name, r in (("b", 0.5), ("a", 0.0), ("c", None)))
    figure = PICTURE.draw(Table(columns, rows), PICTURE.subject, SIZES["paper"])
    names = [t.get_text() for axes in figure.axes for t in axes.get_yticklabels()]
    assert names == ["a", "b"]
    assert "1 more without sides" in figure.get_suptitle()
