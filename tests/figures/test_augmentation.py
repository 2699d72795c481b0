"""Resource augmentation: what is needed is enough, and one less is not."""

import numpy as np
import pytest

import nearsight as ns
from nearsight.figures import picture_named

PICTURE = picture_named("augmentation")
GIVEN = {"mu": 1.0, "l_f": 1.0, "l_T": 0.6, "l_S": 0.4}
FAR = 500  # steps or hops after which nothing changes


@pytest.fixture(scope="module")
def table():
    typed = {"graph": ns.parse_graph("path:5"), "horizon": 4, "k": 3, "r": 3, **GIVEN}
    return PICTURE.compute(PICTURE.subject.with_typed(typed, PICTURE.takes), lambda text: None)


def certificate(k, r):
    found = ns.bound(
        graph="path:5", **GIVEN, k=k, r=r, unconstrained=True, label="nearsight:sharp-cr"
    )
    values = [one.values["cr_minus_one"] for one in found]
    return min((v for v in values if v is not None), default=np.inf)


@pytest.mark.parametrize("direction", ["time", "space"])
def test_what_is_needed_is_enough_and_one_less_is_not(table, direction):
    rows = table.where(kind="finite", direction=direction).records()
    assert [row["star"] for row in rows] == [1, 2, 3]
    for row in rows:
        for name, least in (("certified", 2 if direction == "time" else 1), ("measured", 2)):
            seen = row[name]
            values = []
            for one in (seen, seen - 1):
                k, r = (one, FAR) if direction == "time" else (FAR, one)
                if name == "certified":
                    values.append(certificate(k, r) if one >= least else np.inf)
                else:
                    given = {
                        "graph": "path:5",
                        **GIVEN,
                        "horizon": 4,
                        "k": min(k, 5),
                        "r": min(r, 5),
                    }
                    values.append(ns.worst_case(**given).cr_minus_one if one >= 1 else np.inf)
            enough, less = values
            assert enough <= row["lower"] < less


def test_floors_are_those_of_the_command(table):
    for row in table.where(kind="finite", direction="time").records():
        k = row["star"]
        found = ns.lower_bound(graph="path:5", **GIVEN, k=k, r=5)
        assert row["lower"] == pytest.approx(found.temporal.cr_minus_one, rel=1e-12)
    for row in table.where(kind="finite", direction="space").records():
        found = ns.lower_bound(graph="path:5", **GIVEN, k=9, r=row["star"])
        assert row["lower"] == pytest.approx(found.spatial.cr_minus_one, rel=1e-12)


def test_what_would_take_too_long_is_refused(tmp_path):
    with pytest.raises(ns.InputError, match="horizon = 200: at most 1000 actions over all steps"):
        ns.draw("augmentation", out=tmp_path, graph="ring:9", horizon=200)
