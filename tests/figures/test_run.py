"""Files of pictures: the same bytes every time, whole or not at all, reused only for the same."""

import subprocess
import sys

import pytest

import nearsight as ns
from nearsight.figures import picture_named
from nearsight.figures.run import draw_all
from nearsight.perturbation import Runner

SMALL = {"graph": "path:4", "horizon": 3, "k": 3, "r": 1}
CODE = """
import nearsight as ns, sys
ns.draw("sandwich", out=sys.argv[1], graph="path:4", horizon=3, k=3, r=1)
"""


@pytest.fixture(scope="module")
def drawn(tmp_path_factory):
    folder = tmp_path_factory.mktemp("one")
    (found,) = ns.draw("sandwich", out=folder, **SMALL)
    return found


def test_another_process_writes_the_same_bytes(drawn, tmp_path):
    subprocess.run([sys.executable, "-c", CODE, str(tmp_path)], check=True)
    assert {path.suffix for path in drawn.files} == {".csv", ".pdf", ".png", ".svg"}
    for path in drawn.files:
        assert path.read_bytes() == (tmp_path / path.name).read_bytes()


def test_neither_do_the_settings_of_the_user_change_them(drawn, tmp_path):
    from matplotlib import rc_context

    with rc_context({"font.size": 30, "axes.grid": True, "savefig.bbox": "tight"}):
        (found,) = ns.draw("sandwich", out=tmp_path, **SMALL)
    for one, two in zip(drawn.files, found.files, strict=True):
        assert one.read_bytes() == two.read_bytes()


def test_data_are_reused_for_the_same_subject_only(drawn):
    folder = drawn.files[0].parent
    before = drawn.files[0].read_bytes()
    (again,) = ns.draw("sandwich", out=folder, reuse=True, formats=("svg",), **SMALL)
    assert again.reused
    assert drawn.files[0].read_bytes() == before
    (other,) = ns.draw("sandwich", out=folder, reuse=True, formats=(), **{**SMALL, "l_T": 2})
    assert not other.reused
    drawn.files[0].write_text("damaged")
    (mended,) = ns.draw("sandwich", out=folder, reuse=True, formats=(), **SMALL)
    assert not mended.reused
    assert drawn.files[0].read_bytes() == before


def test_processes_change_nothing_and_progress_is_told(drawn, tmp_path):
    told = []
    chosen = [picture_named("sandwich"), picture_named("sandwich")]
    typed = {**SMALL, "graph": ns.parse_graph("path:4")}
    found = draw_all(chosen, tmp_path, typed, runner=Runner(2), progress=lambda *a: told.append(a))
    assert [one.name for one in found] == ["sandwich", "sandwich"]
    assert told[0] == (0, 2, "")
    assert told[-1] == (2, 2, "sandwich")
    for one, two in zip(drawn.files, found[0].files, strict=True):
        assert one.read_bytes() == two.read_bytes()


@pytest.mark.parametrize(
    ("arguments", "message"),
    [
        ({"size": "poster"}, "size = 'poster': one of paper, slides"),
        ({"formats": ("gif",)}, "formats = 'gif': one of pdf, png, svg"),
        ({"instances": 3}, "instances would have no effect"),
        ({"colour": "red"}, "colour would have no effect on this; no figure takes it"),
        ({"k": 1}, "k = 1: an integer >= 2 is needed"),
        ({"target": (1.0,)}, "target would have no effect"),
        ({"clean": True}, "clean without a graph would have no effect"),
        ({"l_T": -1.0}, "l_T"),
        ({"graph": "ring:z"}, "ring:N needs an integer"),
    ],
)
def test_what_cannot_be_drawn_is_refused(arguments, message, tmp_path):
    with pytest.raises(ns.InputError, match=message):
        ns.draw("sandwich", out=tmp_path / "none", **arguments)
    assert not list(tmp_path.glob("none/*"))


def test_a_folder_that_cannot_be_is_refused(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(ns.InputError, match=r"out = .*file: no folder"):
        ns.draw("sandwich", out=tmp_path / "file", **SMALL)


def test_what_cannot_be_drawn_does_not_stop_the_others(tmp_path):
    given = {"out": tmp_path, "formats": ("svg",), **SMALL, "graph": "complete:3", "l_T": 0, "r": 2}
    failed, drawn = ns.draw(["worst-response", "sandwich"], **given)
    assert failed.failed.startswith("l_T = 0: > 0 is needed")
    assert (failed.argument, failed.files) == ("l_T", ())
    assert [path.name for path in drawn.files] == ["sandwich.csv", "sandwich.svg"]
    del given["horizon"]
    with pytest.raises(ns.InputError, match="l_T = 0: > 0 is needed"):
        ns.draw("worst-response", **given)


def test_data_of_other_verdicts_are_not_reused(tmp_path, monkeypatch):
    from nearsight.verify import recorded

    given = {"out": tmp_path, "formats": ()}
    assert not ns.draw("claim-graph", **given)[0].reused
    assert ns.draw("claim-graph", reuse=True, **given)[0].reused
    other = tmp_path / "recorded.json"
    other.write_text(recorded.PATH.read_text().replace('"refuted"', '"supported"', 1))
    monkeypatch.setattr(recorded, "PATH", other)
    assert not ns.draw("claim-graph", reuse=True, **given)[0].reused
