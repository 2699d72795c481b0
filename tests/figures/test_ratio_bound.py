"""The map of the certified ratio against the theorem itself, its borders against brute force."""

import numpy as np
import pytest

import nearsight as ns
from nearsight.figures import SIZES, picture_named

PICTURE = picture_named("ratio-bound")
GIVEN = {"graph": "ring:31", "l_f": 2.0, "l_T": 1.5, "l_S": 0.75, "target": (1.5, 1.01)}


def subject(**changes):
    return PICTURE.subject.with_typed({**GIVEN, **changes}, PICTURE.takes)


@pytest.fixture(scope="module")
def table():
    return PICTURE.compute(subject(), lambda text: None)


def promised(k, r):
    costs = {"mu": 1, "l_f": 2.0, "l_T": 1.5, "l_S": 0.75}
    results = ns.bound(**costs, graph="ring:31", k=k, r=r, label="nearsight:sharp-cr")
    return results[0]  # for any constraints


def test_cells_are_the_theorem(table):
    rows = table.where(kind="cell").records()
    for row in rows[::9]:
        result = promised(row["k"], row["r"])
        if row["excess"] is None:
            assert not result.guarantee
        else:
            assert row["excess"] == pytest.approx(result.values["cr_minus_one"], rel=1e-12)
    assert {(row["k"], row["r"]) for row in rows} >= {(2, 1), (6, 5)}


@pytest.mark.parametrize("target", GIVEN["target"])
def test_the_border_is_that_of_the_cells_that_reach_the_target(table, target):
    cells = {(c["k"], c["r"]): c["excess"] for c in table.where(kind="cell").records()}
    good = {at for at, e in cells.items() if e is not None and e <= target - 1}
    least = {
        (k, r) for k, r in good if not any((i, j) != (k, r) and i <= k and j <= r for i, j in good)
    }
    rows = table.where(tier="sharp", target=target)
    assert {(f["k"], f["r"]) for f in rows.where(kind="frontier").records()} == least
    (pair,) = rows.where(kind="pair").records()
    assert (pair["k"], pair["r"]) == min(least, key=lambda p: (sum(p), p[0]))


def test_the_bound_falls_in_k_and_its_top_is_the_least_sight(table):
    rows = table.where(kind="cell")
    for r in rows.distinct("r"):
        values = rows.where(r=r).numbers("excess")
        assert np.all(np.diff(values[~np.isnan(values)]) <= 1e-15)


def test_no_coupling_and_no_reach_are_said():
    def texts(**changes):
        at = subject(**changes)
        figure = PICTURE.draw(PICTURE.compute(at, lambda text: None), at, SIZES["paper"])
        said = [t.get_text() for axes in figure.axes for t in axes.texts]
        return " ".join(said + [t.get_text() for one in figure.legends for t in one.get_texts()])

    assert "nothing is coupled" in texts(l_T=0.0, l_S=0.0)
    assert "stated (no guarantee)" in texts(l_T=0.001, l_S=0.001)
