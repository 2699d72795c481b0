import json
import re
from html.parser import HTMLParser
from itertools import pairwise

import networkx as nx
import pytest
from hypothesis import given
from hypothesis import strategies as st

from nearsight.graphs import InputError
from nearsight.verify import Claim
from nearsight.verify.recorded import record
from nearsight.verify.report.layout import layout
from nearsight.verify.report.markdown import plain
from nearsight.verify.report.mathml import mathml_of
from nearsight.verify.report.page import page
from nearsight.verify.report.prose import coded, html_of
from nearsight.verify.report.write import write
from nearsight.verify.run import run

from .small import ALGEBRA, FALSE, SEARCH, claims

VOID = {"meta", "br", "hr", "img", "input", "link"}


class Page(HTMLParser):
    """All elements, with every tag closed in order."""

    def __init__(self, text):
        super().__init__(convert_charrefs=True)
        self.open, self.elements, self.words = [], [], []
        self.feed(text)
        self.close()
        assert not self.open

    def handle_starttag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))
        if tag not in VOID:
            self.open.append(tag)

    def handle_startendtag(self, tag, attrs):
        self.elements.append((tag, dict(attrs)))

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.words.append(data)


@pytest.fixture
def report(tmp_path, monkeypatch):
    path = tmp_path / "recorded.json"
    path.write_text("{}")
    monkeypatch.setattr("nearsight.verify.recorded.PATH", path)
    record(run(claims=claims()), everything=True)
    both = Claim("lemma:both", "both", "x <y", "z", (ALGEBRA, FALSE))
    return run(claims=[*claims(), both], mutation=True)


def test_the_page_is_whole_and_needs_nothing_from_outside(report, tmp_path):
    html, *_ = write(report, tmp_path / "new" / "folder")
    text = html.read_text(encoding="utf-8")
    page = Page(text)
    ids = {attrs["id"] for _, attrs in page.elements if "id" in attrs}
    links = {attrs["href"] for _, attrs in page.elements if "href" in attrs}
    assert all(link.startswith("#") and link[1:] in ids for link in links)
    assert not any("src" in attrs for _, attrs in page.elements)
    assert not {"script", "link", "img", "iframe"} & {tag for tag, _ in page.elements}
    assert not re.search(r"url\(|@import", text)
    assert set(re.findall(r"https?://[^\"' ]+", text)) == {"http://www.w3.org/2000/svg"}
    assert "$" not in "".join(page.words)


def test_every_claim_has_a_card_a_row_and_a_box(report, tmp_path):
    page = Page(write(report, tmp_path)[0].read_text(encoding="utf-8"))
    classes = [attrs.get("class", "").split() for _, attrs in page.elements]
    for name in ("card", "node"):
        words = [c[1] for c in classes if c[:1] == [name]]
        assert len(words) == 6
        assert sorted(words) == sorted(["proved"] * 3 + ["supported", "refuted", "undecided"])
    rows = [tag for tag, _ in page.elements if tag == "tr"]
    assert len(rows) == 7
    assert sum(c == ["ring"] for c in classes) == 2  # what rests on the refuted claim
    assert sum(c[:1] == ["erratum"] for c in classes) == 1
    for claim in report.claims:
        assert claim.key in page.words


def test_markdown_and_json_say_the_same(report, tmp_path):
    _, text, data = (path.read_text(encoding="utf-8") for path in write(report, tmp_path))
    found = json.loads(data, parse_constant=pytest.fail)
    assert found["counts"] == report.counts
    assert [c["key"] for c in found["claims"]] == [v.key for v in report.verdicts]
    assert found["errors"][0]["key"] == "lemma:both"
    assert found["changes"] == [{"key": "lemma:both", "recorded": None, "found": None}]
    assert found["mutation"]["rejected"] == found["mutation"]["mutants"] > 0
    one = next(c for c in found["claims"] if c["key"] == "thm:top[a]")
    assert (one["label"], one["part"], one["verdict"]) == ("thm:top", "a", "supported")
    assert one["rests_on"] == ["lemma:false"]
    assert one["replay"] == "nearsight verify 'thm:top[a]'"
    for claim in report.claims:
        assert f"`{claim.key}`" in text
    assert "Holds instead: 1/2 <= 1" in text
    assert "0.5 > 0.333333" in text


def test_a_folder_that_cannot_be_written(report, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="file"):
        write(report, tmp_path / "file")


@given(
    st.integers(1, 12).flatmap(
        lambda n: st.tuples(
            st.just(n),
            st.sets(st.tuples(st.integers(0, n - 1), st.integers(0, n - 1)), max_size=20),
        )
    )
)
def test_what_is_used_stands_to_the_left_and_no_boxes_overlap(drawn):
    n, pairs = drawn
    graph = nx.DiGraph()
    graph.add_nodes_from(map(str, range(n)))
    graph.add_edges_from((str(max(p)), str(min(p))) for p in pairs if p[0] != p[1])
    found = layout(graph)
    assert {*found.places, *found.alone} == set(graph)
    for user, used in graph.edges:
        assert found.places[used][0] < found.places[user][0]
    for used, user, path in found.edges:
        assert path[0] == found.places[used]
        assert path[-1] == found.places[user]
    spots = sorted({p for _, _, path in found.edges for p in path})
    for (c, y), (d, z) in pairwise(spots):
        assert c != d or z - y > 1 - 1e-9


def test_claims_that_use_each_other_are_drawn_all_the_same():
    found = layout(nx.DiGraph([("a", "b"), ("b", "a"), ("c", "a")]))
    assert found.places["a"][0] == found.places["b"][0] < found.places["c"][0]


@pytest.mark.parametrize(
    ("text", "drawn"),
    [
        ("rho_T^{2r} <= 1", "ρ<sub>T</sub><sup>2r</sup> ≤ 1"),
        ("delta_{x_t} < oo", "δ<sub>x<sub>t</sub></sub> &lt; ∞"),
        ("see `lemma:a_b`", "see <code>lemma:a_b</code>"),
        ("(A B)^T, 2^(d-1)", "(A B)<sup>T</sup>, 2<sup>d-1</sup>"),
        ("$5 a piece", "$5 a piece"),
        ("a~ = x_t* + theta~_t", "a\u0303 = x<sub>t</sub>* + θ\u0303<sub>t</sub>"),
        ("sum_{tau=t} sqrt(1+2a)", "Σ<sub>τ=t</sub> √(1+2a)"),
    ],
)
def test_plain_text_is_set_as_it_is_read(text, drawn):
    assert html_of(text) == drawn


@pytest.mark.parametrize(
    ("formula", "part"),
    [
        (r"\frac{a}{2}", "<mfrac><mrow><mi>a</mi></mrow><mrow><mn>2</mn></mrow></mfrac>"),
        (r"\rho_T^d", "<msubsup><mi>ρ</mi><mi>T</mi><mi>d</mi></msubsup>"),
        (r"\sqrt[3]{x}", "<mroot>"),
        (r"\text{if all } x", "<mtext>if all </mtext>"),
        (r"\left( x \right.", "<mo>(</mo><mi>x</mi></mrow>"),
        (r"\max\{a\}", "<mi>max</mi><mo>{</mo>"),
        (r"\unknown", "<mo>unknown</mo>"),
        (r"{x", "<mi>x</mi>"),
        ("x_", "<msub><mi>x</mi>"),
    ],
)
def test_formulas_become_mathml(formula, part):
    found = mathml_of(formula)
    assert part in found
    Page(found)


def test_texts_keep_their_signs():
    assert plain("|x_t*|^2 <= b_1 `a_b`") == r"\|x\_t\*\|^2 <= b\_1 `a_b`"
    keys = ("thm:all[a]", "thm:all", "sec:x#y_z")
    text = "by thm:all[a], thm:all and sec:x#y_z, not xthm:all"
    assert coded(text, keys) == "by `thm:all[a]`, `thm:all` and `sec:x#y_z`, not xthm:all"
    assert coded(text, ()) == text


def test_several_checks_are_shown_one_by_one():
    both = Claim("lemma:two", "two", "x <= 1", "", (ALGEBRA, SEARCH))
    found = run(claims=[both])
    evidence = found["lemma:two"].evidence
    assert (evidence.verdict, evidence.engine) == ("proved", "symbolic + search")
    assert [part["engine"] for part in evidence.details["parts"]] == ["symbolic", "search"]
    text = page(found)
    assert "<b>symbolic</b>" in text
    assert "<b>search</b>" in text
    assert "&quot;engine&quot;" not in text
