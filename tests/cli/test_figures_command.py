import json
import subprocess
import sys

import pytest

SMALL = ["--graph", "path:4", "--horizon", "3", "-k", "3", "-r", "1"]


def run(*words, cwd):
    return subprocess.run(
        [sys.executable, "-c", "from nearsight.cli import main; main()", "figures", *words],
        cwd=cwd,
        capture_output=True,
        text=True,
        check=False,
    )


def test_a_figure_of_ones_own_network(tmp_path):
    done = run("sandwich", *SMALL, "--json", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    (found,) = json.loads(done.stdout)["figures"]
    assert found["name"] == "sandwich"
    assert (found["flaws"], found["reused"]) == ([], False)
    names = [f"nearsight-figures/sandwich.{kind}" for kind in ("csv", "pdf", "png", "svg")]
    assert found["files"] == names
    assert all((tmp_path / name).stat().st_size > 0 for name in names)
    # and again as a slide, from the data
    done = run("sandwich", *SMALL, "--reuse", "--size", "slides", "--formats", "png", cwd=tmp_path)
    assert (done.returncode, done.stderr) == (0, "")
    assert done.stdout == "nearsight-figures/sandwich  .csv .png  (from the data kept)\n"


def test_one_that_cannot_be_drawn_is_named_beside_those_that_are(tmp_path):
    words = ["--graph", "complete:3", "--horizon", "3", "-k", "3", "-r", "2", "--l-t", "0"]
    done = run("worst-response", "sandwich", *words, "--formats", "svg", cwd=tmp_path)
    assert (done.returncode, done.stdout) == (1, "nearsight-figures/sandwich  .csv .svg\n")
    assert done.stderr.startswith("worst-response was not drawn: --l-t: l_T = 0: > 0 is needed")


def test_a_figure_goes_by_its_label_in_the_paper(tmp_path):
    done = run("fig:none", cwd=tmp_path)
    assert done.returncode == 2
    assert done.stderr.startswith("nearsight: no figure 'fig:none'; there are: ")


@pytest.mark.parametrize(
    ("words", "message"),
    [
        (["sandwhich"], "no figure 'sandwhich'; near it: sandwich"),
        (["sandwich", "--instances", "3"], "--instances: instances would have no effect on this"),
        (["sandwich", "--target", "x"], "--target: 'x': ratios such as 1.1,1.01 are needed"),
        (["sandwich", "--formats", "gif"], "--formats: formats = 'gif': one of pdf, png, svg"),
        (["sandwich", "-k", "1"], "-k: k = 1: an integer >= 2 is needed"),
        (["sandwich", "--l-s", "-1"], "l_S = -1"),
        (["sandwich", "--out", "file"], "--out: out = file: no folder: File exists"),
    ],
)
def test_bad_input_ends_with_one_line(words, message, tmp_path):
    (tmp_path / "file").write_text("")
    done = run(*words, cwd=tmp_path)
    assert (done.returncode, done.stdout) == (2, "")
    assert done.stderr.count("\n") == 1
    assert message in done.stderr


def test_the_help_lists_every_figure(tmp_path):
    from nearsight.figures import pictures

    shown = " ".join(run("--help", cwd=tmp_path).stdout.split())
    for picture in pictures():
        assert f"{picture.name} {picture.title}" in shown
