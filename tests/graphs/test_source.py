import networkx as nx
import pytest

from nearsight.graphs import SUFFIXES, InputError, modules, parse_graph, parse_growth


def test_what_is_neither_lists_what_is_accepted():
    with pytest.raises(InputError, match="--graph 'rng:5' is neither a file nor a family") as e:
        parse_graph("rng:5")
    for family in modules("families").values():
        assert family.SYNTAX in str(e.value)
    assert all(suffix in str(e.value) for suffix in SUFFIXES)


@pytest.mark.parametrize("spec", ["", "x" * 5000, "a\0b", "."])
def test_odd_names(spec):
    with pytest.raises(InputError, match="neither a file nor a family"):
        parse_graph(spec)


def test_a_file_goes_before_a_family(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    nx.write_edgelist(nx.path_graph(4), "ring:5.edgelist")
    (tmp_path / "ring:7").write_text("0 1\n")
    assert parse_graph("ring:5.edgelist").edges == 3
    with pytest.raises(InputError, match="ends in one of"):
        parse_graph("ring:7")
    assert parse_graph("ring:8").edges == 8


def test_a_path_is_a_file(tmp_path):
    nx.write_gml(nx.path_graph(3), tmp_path / "a.gml")
    assert parse_graph(tmp_path / "a.gml").edges == 2
    assert parse_graph(str(tmp_path / "a.gml")).edges == 2
    with pytest.raises(InputError, match="no such file"):
        parse_graph(str(tmp_path / "b.gml"))


def test_cleaning_is_passed_on(tmp_path):
    (tmp_path / "a.edgelist").write_text("a a\na b\n")
    with pytest.raises(InputError, match="self-loop"):
        parse_graph(tmp_path / "a.edgelist")
    assert parse_graph(tmp_path / "a.edgelist", clean=True).edges == 1


def test_a_seed_is_not_negative():
    with pytest.raises(InputError, match="--seed is an integer >= 0, not -1"):
        parse_graph("ring:5", seed=-1)


@pytest.mark.parametrize(
    ("spec", "degree", "message"),
    [
        ("rng", None, "--growth 'rng' is no known family; accepted: .*grid2.*tree:DELTA"),
        ("line:2", None, r"line takes 0 argument\(s\), not 1 argument\(s\): 2"),
        ("line:", None, r"line takes 0 argument\(s\)"),
        ("grid2", 5, "--max-degree 5 contradicts --growth grid2, whose degree is 4; leave it out"),
        ("grid3", 4, "--max-degree 4 contradicts --growth grid3, whose degree is 6"),
        ("line", 1, "--max-degree 1 contradicts --growth line"),
        ("tree:3", 4, "--max-degree 4 contradicts --growth tree:3"),
        ("ring-of-blocks:2", 2, "--max-degree 2 contradicts --growth ring-of-blocks:2"),
        ("tree:1", None, "tree:DELTA needs DELTA >= 2, not 1"),
        ("tree:x", None, "tree:DELTA needs an integer, not 'x'"),
        ("ring-of-blocks:0", None, "ring-of-blocks:D needs D >= 1, not 0"),
        ("poly:4,1", None, "--growth poly needs --max-degree D"),
        ("poly:4,1", 0, "--max-degree of poly is at least 1, not 0"),
        ("poly:4", 4, r"poly:C,P takes 2 argument\(s\)"),
        ("poly:0.5,1", 4, "poly:C,P needs C >= 1, not 0.5"),
        ("poly:4,-1", 4, "poly:C,P needs P between 0 and 64, not -1"),
        ("poly:4,65", 4, "poly:C,P needs P between 0 and 64, not 65"),
        ("poly:inf,1", 4, "poly:C,P needs a finite number, not 'inf'"),
        ("poly:4,nan", 4, "poly:C,P needs a finite number, not 'nan'"),
        ("poly:1/0,1", 4, "poly:C,P needs a finite number, not '1/0'"),
        ("values:1,4", None, "--growth values needs --max-degree D"),
        ("values", 4, r"values:1,H1,H2,... takes 1 argument"),
        ("values:2,4", 4, "begins with h.0. = 1"),
        ("values:1,4,-3", 4, "needs positive integers, not -3"),
        ("values:1,4,2.5", 4, "needs an integer, not '2.5'"),
        ("values:1,5", 4, r"--max-degree 4 contradicts values:1,5: h\(1\) = 5"),
        ("values:1", -1, "--max-degree of values is at least 0, not -1"),
    ],
)
def test_bad_growth(spec, degree, message):
    with pytest.raises(InputError, match=message) as caught:
        parse_growth(spec, degree)
    assert caught.match(f"^--growth '{spec}'")
    assert "\n" not in str(caught.value)


def test_a_degree_that_agrees_is_accepted():
    assert parse_growth("grid2", 4) == parse_growth("grid2")
