"""Every picture, drawn of small networks and of what it is of by default."""

import pytest

from nearsight.figures import SIZES, picture_named, pictures
from nearsight.figures.run import draw_all

NAMES = [picture.name for picture in pictures()]
SMALL = {"horizon": 4, "k": 3, "r": 2, "t": 2, "instances": 3, "target": (2.0, 1.2)}
OTHERS = {
    "irregular": {"graph": "barabasi-albert:9x2", "l_T": 0.3, "l_S": 0.2},
    "strong": {"graph": "path:8", "mu": 2.0, "l_f": 5.0, "l_T": 9.0, "l_S": 4.0},
    "apart": {"graph": "erdos-renyi:9x0.15", "l_T": 0.05, "l_S": 0.01},
}


@pytest.mark.parametrize("name", NAMES)
def test_a_picture_says_what_it_shows(name):
    picture = picture_named(name)
    assert picture.title.endswith(".")
    assert picture.caption.endswith(".")
    assert picture.label == "" or picture_named(picture.label) is picture


@pytest.fixture(scope="session")
def folder(tmp_path_factory):
    return tmp_path_factory.mktemp("pictures")


@pytest.mark.parametrize("name", NAMES)
@pytest.mark.parametrize("other", OTHERS)
def test_any_network_is_drawn_without_flaws(name, other, folder):
    picture = picture_named(name)
    if not picture.takes and other != "irregular":
        return  # one and the same
    typed = {**SMALL, **OTHERS[other]}
    for turn, size in enumerate(SIZES):  # the second time from the data written the first time
        (drawn,) = draw_all(
            [picture], folder / other, typed, size=size, formats=("png",), reuse=turn > 0
        )
        assert (drawn.flaws, drawn.reused) == ((), turn > 0)
        assert all(path.stat().st_size > 0 for path in drawn.files)
