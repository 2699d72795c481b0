"""Names of agents and files are shown as they are, whatever letters they have."""

import warnings

import networkx as nx
import pytest
from matplotlib.mathtext import MathTextParser

import nearsight as ns
from nearsight.figures import SIZES, Table, flaws, picture_named, pictures
from nearsight.figures.parts import network_name
from nearsight.figures.pictures._text import shown
from nearsight.figures.subject import Subject

ODD = (
    *("$2", "a_b$c", "Zürich-Süd", "x^{", "\\frac", "N" * 60, "", "12", "1e5", "nan", "$x$"),
    *("a$b$c\\%", "東京", "x\ny", "tab\there", "\x1cleft\x85", "&<b>", "\\$", "a\u0663", "# b: c"),
)
NAMED = [p.name for p in pictures() if {"graph", "agent"} <= set(p.takes)]


@pytest.fixture(scope="module")
def network():
    return ns.Network.from_edges(
        len(ODD), [(i, i + 1) for i in range(len(ODD) - 1)], names=ODD, source="odd"
    )


@pytest.mark.parametrize("name", [*NAMED, "ieee118-trajectory"])
def test_agents_may_have_any_name(name, network, tmp_path):
    takes = set(picture_named(name).takes)
    given = {"horizon": 4, "k": 3, "r": 2, "t": 2, "seed": 1, "agent": ODD[3]}
    given = {key: value for key, value in given.items() if key in takes}
    for turn, size in enumerate(SIZES):
        (drawn,) = ns.draw(
            name, out=tmp_path, graph=network, size=size, formats=(), reuse=turn > 0, **given
        )
        assert (drawn.flaws, drawn.reused) == ((), turn > 0)


@pytest.mark.parametrize("name", ["$x^{$", "\\frac{", "東京", "z" * 120, "zwei\nZeilen"])
def test_files_may_have_any_name(name, tmp_path):
    file = tmp_path / f"{name}.graphml"
    nx.write_graphml(nx.path_graph(3), file)
    given = {"out": tmp_path, "graph": file, "formats": (), "horizon": 2, "k": 2, "r": 1}
    for turn, size in enumerate(SIZES):
        drawn = ns.draw(["sandwich", "decision-boundary"], reuse=turn > 0, size=size, t=1, **given)
        assert [one.flaws for one in drawn] == [()] * 2
        assert {one.reused for one in drawn} == {turn > 0}


def test_what_is_shown_is_the_name():
    assert shown("u12") == "$u_{12}$"
    assert shown("Zürich-Süd") == "Zürich-Süd"
    parser = MathTextParser("agg")
    for name in ODD:
        for text in (shown(name), network_name(Subject(ns.Network.from_edges(1, [], source=name)))):
            parser.parse(f"{text}, $k = 2$")  # as in a heading: with mathematics beside it
            assert len(text) <= 70
            assert "\n" not in text
    assert shown("a_b$c").replace(r"\$", "$") == "a_b$c"


def test_letters_that_no_font_has_are_replaced_without_a_warning():
    size = SIZES["paper"]
    figure = size.figure("column", 0.5)
    figure.text(0.5, 0.5, shown("東京 Łódź"))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert flaws(figure) == ()
    assert shown("東京 Łódź").endswith(" Łódź")


@pytest.mark.parametrize("name", ODD)
def test_a_table_keeps_every_name(name):
    table = Table.of([{"kind": "agent", "name": f"<{name}>"}, {"kind": "edge", "name": None}])
    again, head = Table.from_csv(table.to_csv({"graph": name, "k": "2"}))
    assert again == table
    assert head["k"] == "2"
    assert table.to_csv(head) == table.to_csv({"graph": name, "k": "2"})
