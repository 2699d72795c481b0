"""The picture of claims against the catalogue and the recorded verdicts themselves."""

from collections import Counter

import pytest
from matplotlib.colors import to_hex
from matplotlib.patches import Rectangle

from nearsight.figures import SIZES, picture_named
from nearsight.figures.looks import VERDICTS
from nearsight.verify import catalogue
from nearsight.verify.recorded import recorded


@pytest.fixture(scope="module")
def table():
    picture = picture_named("claim-graph")
    return picture.compute(picture.subject, lambda text: None)


def test_every_claim_is_in_one_box_with_its_recorded_verdict(table):
    rows, known = table.where(kind="claim").records(), recorded()
    assert [row["key"] for row in rows] != []
    assert Counter(row["key"] for row in rows) == Counter(claim.key for claim in catalogue())
    for row in rows:
        assert row["verdict"] == known.get(row["key"], "not recorded")
        assert row["key"].startswith(row["box"])
    assert set(table.where(kind="box").values("box")) == {row["box"] for row in rows}


def test_lines_are_the_uses_between_boxes(table):
    box = {row["key"]: row["box"] for row in table.where(kind="claim").records()}
    pairs = {}
    for claim in catalogue():
        for key in claim.uses:
            if box[key] != box[claim.key]:
                pairs.setdefault((box[key], box[claim.key]), []).append(recorded().get(key))
    edges = table.where(kind="edge").records()
    assert {(row["box"], row["user"]) for row in edges} == set(pairs)
    place = {row["box"]: (row["column"], row["row"]) for row in table.where(kind="box").records()}
    for row in edges:
        assert row["broken"] == ("refuted" in pairs[row["box"], row["user"]])
        passed = [tuple(map(float, at.split(":"))) for at in row["path"].split()]
        ends = place[row["box"]], place[row["user"]]
        assert (passed[0], passed[-1]) == ends
        assert ends[0][0] <= ends[1][0]


def test_boxes_stand_apart(table):
    places = [(row["column"], row["row"]) for row in table.where(kind="box").records()]
    for i, (column, row) in enumerate(places):
        assert all(abs(row - other) >= 1 - 1e-9 for at, other in places[:i] if at == column)


def test_cells_have_the_colours_of_their_verdicts(table):
    picture = picture_named("claim-graph")
    figure = picture.draw(table, picture.subject, SIZES["paper"])
    boxes = [p for p in figure.axes[0].patches if isinstance(p, Rectangle) and p.get_width() > 0]
    drawn = Counter(to_hex(box.get_facecolor()).upper() for box in boxes)
    words = Counter(table.where(kind="claim").values("verdict"))
    for word, colour in VERDICTS.items():
        assert drawn[colour] == words[word] > 0
