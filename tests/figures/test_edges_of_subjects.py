"""Networks without edges, couplings of 0, files that cannot be written: said in a line."""

import matplotlib.pyplot as plt
import pytest

import nearsight as ns
from nearsight.figures import SIZES, picture_named, pictures
from nearsight.figures.parts import constants, legend_below, number
from nearsight.figures.pictures._text import log_axis
from nearsight.figures.subject import Subject

SMALL = {"horizon": 3, "k": 3, "r": 1, "t": 2, "instances": 2, "target": (1.5,)}
COUPLED = [p.name for p in pictures() if {"graph", "l_S"} <= set(p.takes)]


def typed(name, **more):
    takes = picture_named(name).takes
    return {key: value for key, value in {**SMALL, **more}.items() if key in takes}


@pytest.mark.parametrize("name", COUPLED)
def test_without_any_coupling(name, tmp_path):
    given = typed(name, graph="path:4", l_T=0.0, l_S=0.0)
    for turn, size in enumerate(SIZES):
        if name == "worst-response":  # no boundary variable can be followed
            with pytest.raises(ns.InputError, match="follows no boundary variable"):
                ns.draw(name, out=tmp_path, **given)
            return
        (drawn,) = ns.draw(name, out=tmp_path, formats=(), size=size, reuse=turn > 0, **given)
        assert drawn.flaws == ()


def test_isolated_agents_in_the_trajectory(tmp_path):
    network = ns.Network.from_edges(7, [(0, 1), (1, 2), (2, 3)])
    given = {"graph": network, "horizon": 4, "k": 3, "r": 2}
    for size in SIZES:
        (drawn,) = ns.draw("ieee118-trajectory", out=tmp_path, formats=(), size=size, **given)
        assert drawn.flaws == ()


def test_a_sandwich_of_many_horizons(tmp_path):
    given = {"graph": "path:7", "horizon": 8, "k": 7, "r": 3, "l_S": 0.1}  # too many to search
    for turn, size in enumerate(SIZES):
        how = {"formats": (), "size": size, "reuse": turn > 0}
        (drawn,) = ns.draw("sandwich", out=tmp_path, **how, **given)
        assert drawn.flaws == ()


@pytest.mark.parametrize("name", ["ring-of-blocks.csv", "ring-of-blocks.svg"])
@pytest.mark.parametrize("reuse", [False, True])
def test_a_file_that_cannot_be_written_is_refused(name, reuse, tmp_path):
    (tmp_path / name).mkdir()
    with pytest.raises(
        ns.InputError, match=r"out = .*: the files of ring-of-blocks cannot be used"
    ):
        ns.draw("ring-of-blocks", out=tmp_path, graph="path:3", formats=("svg",), reuse=reuse)
    assert not list(tmp_path.glob(".*")), "a temporary file is left"


@pytest.mark.parametrize(
    "damage",
    ["\x00", "# figure: x\n" + "x" * 200_000, "a,b\n1\n", "\udcff", "kind,x\nagent,text\n"],
)
def test_damaged_data_are_computed_again(damage, tmp_path):
    given = {"out": tmp_path, "graph": "path:3", "formats": ()}
    (first,) = ns.draw("ring-of-blocks", **given)
    whole = first.files[0].read_bytes()
    head = b"".join(line for line in whole.splitlines(True) if line.startswith(b"# "))
    first.files[0].write_bytes(head + damage.encode(errors="surrogateescape"))
    (again,) = ns.draw("ring-of-blocks", reuse=True, **given)
    assert not again.reused
    assert again.files[0].read_bytes() == whole


def test_no_legend_without_entries():
    figure = SIZES["paper"].figure("column", 1)
    assert legend_below(figure, figure.subplots()) is None


def test_numbers_in_mathematics():
    assert [number(v) for v in (1, 0.5, 1e8, 1.5e-8)] == [
        "1",
        "0.5",
        "10^{8}",
        "1.5 \\times 10^{-8}",
    ]
    assert constants(Subject(l_f=2e7), "mu", "l_f") == "$\\mu = 1$, $\\ell_f = 2 \\times 10^{7}$"


@pytest.mark.parametrize(("low", "high"), [(0.2, 0.9), (3e-3, 0.08), (1e-9, 1.0)])
def test_a_logarithmic_axis_has_two_labels_at_least(low, high):
    figure, axes = plt.subplots()
    axes.plot([1, 2], [low, high])
    log_axis(axes)
    figure.canvas.draw()
    below, above = axes.get_ylim()
    ticks = axes.yaxis.get_major_ticks()
    shown = [t.label1.get_text() for t in ticks if below <= t.get_loc() <= above]
    plt.close(figure)
    assert sum(map(bool, shown)) >= 2
    assert not any(t.label1.get_text() for t in axes.yaxis.get_minor_ticks())
