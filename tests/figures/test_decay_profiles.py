"""Profiles: what is promised as typed anew, what is searched between measured and promised."""

import mpmath
import numpy as np
import pytest

from nearsight.figures import SIZES, picture_named

PICTURE = picture_named("decay-profiles")
GIVEN = {"graph": "complete:4", "l_f": 2.0, "l_T": 0.8, "l_S": 0.3, "k": 4, "r": 1, "instances": 4}


def subject(**changes):
    return PICTURE.subject.with_typed({**GIVEN, **changes}, PICTURE.takes)


def compute(**changes):
    return PICTURE.compute(subject(**changes), lambda text: None)


@pytest.fixture(scope="module")
def table():
    return compute()


def test_one_profile_for_each_network_and_direction(table):
    assert table.distinct("network") == ["complete:4", "ring-of-blocks:6x1"]
    for place in (0, 1):
        assert table.where(place=place, direction="time").values("distance") == [1, 2, 3]


def test_printed_and_repaired_promises_as_typed_anew(table):
    """Both decay like rho^distance; the constants, with Delta = 3, a = 0.8, x = 0.9."""
    g = {y: (mpmath.sqrt(1 + y) - 1) / (mpmath.sqrt(1 + y) + 1) for y in (1.6, 0.9)}
    rho_T, rho_S = (mpmath.sqrt(g[y]) for y in (1.6, 0.9))
    c = [max(1, (1 + mpmath.sqrt(q)) ** 2 / (2 * q)) for q in (2.6, 1.9)]
    repaired = mpmath.sqrt(c[0] * c[1]) / 2
    repaired *= max(0.8 / rho_T, mpmath.sqrt(3) * 0.3 / rho_S)
    stated = 2 * mpmath.sqrt(3 * 0.3 * 0.8)
    rows = table.where(place=0, direction="time").records()
    for row in rows:
        assert row["stated"] == pytest.approx(float(stated * rho_T ** row["distance"]), rel=1e-12)
        assert row["repaired"] == pytest.approx(
            float(repaired * rho_T ** row["distance"]), rel=1e-12
        )


def test_searched_exceeds_measured_and_stays_below_the_sharp_promise(table):
    for row in table.records():
        assert row["measured"] <= row["sharp"] * (1 + 1e-9)
        assert row["searched"] is not None
        assert row["searched"] <= row["sharp"] * (1 + 1e-9)
        if row["direction"] == "time":
            assert row["searched"] >= row["measured"] * (1 - 1e-9)


def test_the_search_in_time_reaches_the_sharp_slice_rate(table):
    """One agent alone attains a/(2 sqrt(1+a)) gamma_T^(d-1), and its neighbours cannot help."""
    rows = table.where(place=1, direction="time").records()
    gamma = (np.sqrt(2.6) - 1) / (np.sqrt(2.6) + 1)
    for row in rows:
        wanted = 0.8 / (2 * np.sqrt(1.8)) * gamma ** (row["distance"] - 1)
        assert row["searched"] == pytest.approx(wanted, rel=1e-6)


@pytest.mark.parametrize("changes", [{"l_S": 0.0}, {"l_T": 0.0}, {"l_T": 0.0, "l_S": 0.0}])
def test_panels_without_influence_say_so(changes):
    at = subject(**changes)
    figure = PICTURE.draw(PICTURE.compute(at, lambda text: None), at, SIZES["paper"])
    said = [t.get_text() for axes in figure.axes for t in axes.texts]
    assert said.count("no influence") == 2 * len(changes)
