"""Measured against promised decay: measured by other means, promised as typed anew."""

import numpy as np
import pytest

from nearsight.figures import SIZES, picture_named
from nearsight.figures.pictures.measured_decay import worst_parts
from nearsight.figures.table import Table
from nearsight.perturbation import Spec

PICTURE = picture_named("measured-decay")
GIVEN = {"graph": "ring:9", "l_f": 2.0, "l_T": 0.5, "l_S": 0.01, "k": 3, "r": 2, "instances": 4}


def subject(**changes):
    return PICTURE.subject.with_typed({**GIVEN, **changes}, PICTURE.takes)


def compute(**changes):
    return PICTURE.compute(subject(**changes), lambda text: None)


@pytest.fixture(scope="module")
def table():
    return compute()


def test_the_printed_promise_as_typed_anew(table):
    gamma = {y: 1 - 2 / (np.sqrt(1 + y) + 1) for y in (2 * 0.5, 2 * 0.01)}
    rho_T, rho_S = np.sqrt(gamma[1.0]), np.sqrt(gamma[0.02])
    C = 2 * np.sqrt(2 * 0.01 * 0.5)
    for row in table.records():
        printed = C * rho_T ** row["dt"] * rho_S ** row["ds"]
        assert row["stated"] == pytest.approx(printed, rel=1e-12)


def test_guarantees_hold_and_the_printed_bound_fails_at_weak_couplings(table):
    rows = table.records()
    assert all(row["measured"] <= row[tier] for row in rows for tier in ("repaired", "sharp"))
    worst = worst_parts(table)
    assert worst.where(dt=1, ds=0).numbers("stated")[0] < 1


def test_the_largest_of_the_instances_and_no_more(table):
    at = subject()
    spec = Spec(at.network, at.parameters, 3, 2, seed=0)
    largest = np.fmax.reduce([spec.cells(i)[: np.prod(spec.shape)] for i in range(4)])
    parts = ("top", "bottom", "lateral")
    for row in table.records():
        found = largest.reshape(spec.shape)[:, row["dt"], row["ds"]]
        assert row["measured"] in found
    assert set(table.distinct("part")) <= set(parts)


def test_the_worst_part_has_the_least_ratio():
    columns = ("part", "dt", "ds", "measured", "stated", "repaired", "sharp")
    rows = (("top", 1, 0, 0.5, 0.25, 1.0, 0.5), ("bottom", 1, 0, 0.1, 0.2, 0.3, 0.4))
    more = (("lateral", 0, 1, 0.0, 0.0, 1.0, 1.0),)
    found = worst_parts(Table(columns, rows + more)).records()
    assert found[0] == {
        "dt": 1, "ds": 0, "measured": 0.5, "stated": 0.5, "repaired": 2.0, "sharp": 1.0
    }  # fmt: skip
    assert found[1]["stated"] is None  # nothing measured: no ratio


def test_violations_are_crossed_out():
    at = subject()
    figure = PICTURE.draw(compute(), at, SIZES["paper"])
    said = [t.get_text() for one in figure.legends for t in one.get_texts()]
    assert said == ["promise violated"]


def test_one_agent_and_no_couplings_are_drawn():
    assert compute(graph="path:1").distinct("ds") == [0]
    at = subject(l_T=0.0, l_S=0.0)
    figure = PICTURE.draw(PICTURE.compute(at, lambda text: None), at, SIZES["paper"])
    assert "nothing is\ncoupled" in [t.get_text() for axes in figure.axes for t in axes.texts]
