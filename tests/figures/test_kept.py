"""The pictures of README and documentation are those that `nearsight figures` makes."""

import re
from importlib.metadata import version
from pathlib import Path

import numpy as np
import pytest
from matplotlib import image

import nearsight as ns
from nearsight.figures import Table, pictures

ROOT = Path(__file__).resolve().parents[2]
KEPT = ROOT / "docs" / "figures"
NAMES = [picture.name for picture in pictures()]
KINDS = ("csv", "png", "svg")
PINS = dict(
    re.findall(r"^([\w.-]+)==([\w.]+)", (ROOT / "requirements.lock").read_text("utf-8"), flags=re.M)
)


def test_every_picture_is_kept_and_nothing_else():
    expected = {f"{name}.{kind}" for name in NAMES for kind in KINDS}
    assert {path.name for path in KEPT.iterdir()} == expected


@pytest.mark.parametrize("name", NAMES)
def test_the_command_draws_what_is_kept(name, tmp_path):
    for kind in KINDS:
        (tmp_path / f"{name}.{kind}").write_bytes((KEPT / f"{name}.{kind}").read_bytes())
    (drawn,) = ns.draw(name, out=tmp_path, formats=("png", "svg"), reuse=True)
    assert drawn.flaws == ()
    assert drawn.reused, "computed by another version, or of another subject: draw it again"
    if version("matplotlib") == PINS["matplotlib"]:
        for path in drawn.files:
            assert path.read_bytes() == (KEPT / path.name).read_bytes(), path.name
    else:  # other versions may place a glyph a pixel off
        one, two = (image.imread(folder / f"{name}.png") for folder in (KEPT, tmp_path))
        assert one.shape == two.shape
        assert np.mean(np.abs(one - two)) < 0.01


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_data_kept_are_the_data_computed(name, tmp_path):
    (drawn,) = ns.draw(name, out=tmp_path, formats=())
    (one, head), (two, other) = (
        Table.from_csv(path.read_text("utf-8")) for path in (KEPT / f"{name}.csv", drawn.files[0])
    )
    assert (one.columns, head) == (two.columns, other)
    for a, b in zip(one.rows, two.rows, strict=True):
        for x, y in zip(a, b, strict=True):
            assert x == (pytest.approx(y, rel=1e-6, abs=1e-12) if isinstance(y, float) else y)


def test_pages_show_pictures_that_are_kept():
    pages = [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]
    shown = [
        (page.parent / name).resolve()
        for page in pages
        for name in re.findall(
            r"(?:\]\(|\{figure\} )([^)\s]+\.(?:png|svg))", page.read_text("utf-8")
        )
    ]
    assert KEPT / "sandwich.png" in shown
    assert [path for path in shown if not path.is_file()] == []
