import json
import math

import pytest
from click.testing import CliRunner

import nearsight as ns
from nearsight.cli import cli

COSTS = ["--mu", "2", "--l-f", "2", "--l-t", "2", "--l-s", "1"]


def run(*words):
    return CliRunner().invoke(cli, ["bound", *words])


def bound(*words):
    done = run(*words, "--json")
    assert done.exit_code == 0, done.output
    return json.loads(done.output)


def test_every_theorem_is_there_in_every_tier_it_has():
    document = bound("--growth", "line", *COSTS, "-k", "4", "-r", "3")
    found = [(r["label"], r["tier"], r["variant"]) for r in document["results"]]
    assert found == [(b.label, b.tier, b.variant) for b in ns.catalogue()]
    assert len(set(found)) == len(found)


def test_the_fixed_fields():
    document = bound("--graph", "ring:9", *COSTS)
    assert document["parameters"] == {"mu": 2.0, "l_f": 2.0, "l_T": 2.0, "l_S": 1.0}
    graph = document["graph"]
    assert (graph["vertices"], graph["edges"], graph["max_degree"]) == (9, 9, 2)
    assert graph["growth"] == [1, 2, 2, 2, 2]
    for result in document["results"]:
        assert result["kind"] in ("upper", "lower", "exact")
        assert isinstance(result["guarantee"], bool)
        for h in result["hypotheses"]:
            assert h.keys() == {"text", "holds", "margin"}
        for name, value in result["values"].items():
            assert value is None or math.isfinite(value)
            assert (value is None) == (name in result["reasons"])


def test_textbook_rates():
    document = bound("--growth", "line", *COSTS, "--label", "thm:networked-exp-decay")
    for result in document["results"]:
        values = result["values"]
        rho_T = math.sqrt(1 - 2 / (math.sqrt(1 + 2) + 1))
        rho_S = math.sqrt(1 - 2 / (math.sqrt(1 + 1) + 1))
        assert values["rho_T"] == pytest.approx(rho_T, rel=1e-14)
        assert values["rho_S"] == pytest.approx(rho_S, rel=1e-14)
        assert values["one_minus_rho_T"] == pytest.approx(1 - rho_T, rel=1e-13)


def test_a_failed_hypothesis_gives_no_number_and_no_guarantee():
    document = bound("--growth", "line", *COSTS, "-k", "2", "-r", "1", "--label", "coro:CR-LPC")
    printed = document["results"][0]
    failed = [h for h in printed["hypotheses"] if h["holds"] is False]
    assert [h["margin"] < 0 for h in failed] == [True]
    assert printed["values"]["cr"] is None
    assert failed[0]["text"] in printed["reasons"]["cr"]
    assert not printed["guarantee"]


def test_given_b_and_a_diverging_series():
    words = ["--growth", "tree:3", *COSTS, "--label", "thm:networked-exp-decay-tight"]
    values = bound(*words, "--b", "1,1")["results"][0]["values"]
    assert (values["b_1"], values["b_2"]) == (1.0, 1.0)
    assert values["a_tilde"] is None  # sum (1/2)^q 3 2^(q-1)
    values = bound(*words, "--b", "2,9")["results"][0]["values"]
    assert values["a_tilde"] == pytest.approx(4.0)  # (1 + z)/(1 - 2z) at z = 1/3
    assert values["a"] == pytest.approx(2.5)  # at z = 1/4


def test_unconstrained_brings_two_more_certificates():
    words = ["--growth", "line", *COSTS, "-k", "4", "-r", "3", "--label", "nearsight:sharp-cr"]
    closed = {r["variant"]: r["values"]["cr"] for r in bound(*words)["results"]}
    opened = {r["variant"]: r["values"]["cr"] for r in bound(*words, "--unconstrained")["results"]}
    assert (closed["mix"], closed["smooth"]) == (None, None)
    assert opened["mix"] - 1 == pytest.approx(3.4717e-3, rel=1e-4)
    assert opened["vi"] == closed["vi"]


def test_explain_says_what_fails_once():
    words = ("--growth", "line", "--mu", "1", "--l-f", "1", "--l-t", "0.1", "--l-s", "0.05")
    text = run(*words, "--label", "thm:global-exp-decay", "--explain").output
    assert text.count("fails: C_G is at least the sharp constant") == 1


def test_explain_lists_the_hypotheses():
    text = run("--growth", "line", *COSTS, "--explain").output
    assert "assumed: the costs obey Assumption 2.1" in text
    assert "holds: C_G is at least the sharp constant" in text
