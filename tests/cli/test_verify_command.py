import importlib
import json

import pytest
from click.testing import CliRunner

import nearsight as ns
from nearsight.cli import cli
from nearsight.verify import Claim
from nearsight.verify.engines.exact import Counterexample
from nearsight.verify.engines.search import Search
from nearsight.verify.engines.symbolic import Identity

TRUE = Identity(lambda: (1, 1), "as it stands")
FALSE = Counterexample(lambda: (2, 1), {"x": 2}, "x = 2")
BLIND = Search(lambda rng: (0.0, 1.0, {}), "zeros", quick=3)
CLAIMS = (
    Claim("lemma:one", "one is one", "1 = 1", "nothing", (TRUE,)),
    Claim("lemma:two", "two", "2 <= 1", "", (FALSE,), repaired="2 <= 2"),
    Claim("thm:all", "all", "x <= 1", "", (BLIND,), "a", uses=("lemma:two",)),
)


@pytest.fixture(autouse=True)
def path(tmp_path, monkeypatch):
    path = tmp_path / "recorded.json"
    path.write_text(json.dumps({c.key: w for c, w in zip(CLAIMS, WORDS, strict=True)}))
    monkeypatch.setattr("nearsight.verify.recorded.PATH", path)
    module = importlib.import_module("nearsight.verify.run")
    monkeypatch.setattr(module, "catalogue", lambda: CLAIMS)
    return path


WORDS = ("proved", "refuted", "supported")


def run(*words):
    return CliRunner().invoke(cli, ["verify", "--workers", "1", *map(str, words)])


def test_the_fields():
    done = run("--json")
    assert (done.exit_code, done.stderr) == (0, "")
    found = json.loads(done.stdout, parse_constant=pytest.fail)
    assert [c["verdict"] for c in found["claims"]] == list(WORDS)
    for one in found["claims"]:
        assert {"label", "part", "verdict", "rests_on", "evidence"} <= set(one)
    assert found["claims"][2]["rests_on"] == ["lemma:two"]
    assert found["claims"][1]["evidence"]["instance"] == {"x": 2}


def test_a_table_for_people():
    done = run()
    assert done.exit_code == 0
    for word in (*WORDS, "thm:all[a]", "3 claims: 1 proved, 1 supported, 1 refuted"):
        assert word in done.stdout


def test_one_claim_with_its_evidence():
    done = run("lemma:two")
    assert done.exit_code == 0
    for text in ("2 <= 1", "x = 2", "2 > 1", "2 <= 2"):
        assert text in done.stdout
    assert "lemma:one" not in done.stdout


def test_keys_are_never_broken(monkeypatch, path):
    long = Claim("sec:a-section-with-a-rather-long-name#and-a-part-of-it", "x", "x", "", (FALSE,))
    blanks = Claim("thm: with blanks", "x", "x", "", (BLIND,), "one of its many parts, no less")
    user = Claim("thm:user", "x", "x", "", (TRUE,), uses=(long.key,))
    module = importlib.import_module("nearsight.verify.run")
    monkeypatch.setattr(module, "catalogue", lambda: (long, blanks, user))
    for terminal in (False, True):  # of 100 columns
        monkeypatch.setattr("rich.console.Console.is_terminal", terminal)
        lines = run().stdout.splitlines()
        for claim in (long, blanks, user):
            assert any(claim.key in line for line in lines)
        assert not any("\N{HORIZONTAL ELLIPSIS}" in line for line in lines)
        (row,) = (line for line in lines if user.key in line)
        assert long.key in row


def test_one_is_no_plural(tmp_path):
    assert "\n1 claim: 1 proved" in run("lemma:one").stdout
    costs = "--mu 1 --l-f 2 --l-t 1 --l-s 0.1 -k 3 -r 1"
    for command in ("bound", "simulate --horizon 3", "worst-case --horizon 3"):
        words = f"{command} --graph path:2 {costs}".split()
        assert "2 agents, 1 edge" in (out := CliRunner().invoke(cli, words).stdout)
        assert "1 edges" not in out


def test_a_changed_verdict_is_named_and_exits_1(path):
    path.write_text(json.dumps({"lemma:one": "refuted", "lemma:two": "refuted"}))
    done = run("--json")
    assert done.exit_code == 1
    assert "lemma:one: proved, recorded is refuted" in done.stderr
    assert "thm:all[a]: supported, recorded is none" in done.stderr
    assert "lemma:two" not in done.stderr
    assert len(json.loads(done.stdout)["changes"]) == 2
    assert run("lemma:two").exit_code == 0


def test_recording_makes_them_the_verdicts_to_compare_with(path):
    path.write_text("{}")
    assert run("lemma:one", "--record").exit_code == 0
    assert json.loads(path.read_text()) == {"lemma:one": "proved"}
    assert run().exit_code == 1
    assert run("--record").exit_code == 0
    assert run().exit_code == 0


def test_a_check_that_cannot_fail_exits_1():
    done = run("--mutation")
    assert done.exit_code == 1
    assert "cannot fail: thm:all[a], check 0 (Search): accepted" in done.stderr
    assert run("--mutation", "lemma:one").exit_code == 0


def test_an_unknown_label_exits_2_and_names_near_ones():
    done = run("lemma:on")
    assert done.exit_code == 2
    assert "lemma:one" in done.stderr
    assert run("--workers", "-1").exit_code == 2
    assert run("--level", "slow").exit_code == 2


def test_the_report_lands_in_a_folder(tmp_path):
    done = run("--report", tmp_path / "report")
    assert done.exit_code == 0
    assert done.stdout.endswith(f"\nreport: {tmp_path / 'report' / 'report.html'} .md .json\n")
    names = {path.name for path in (tmp_path / "report").iterdir()}
    assert names == {"report.html", "report.md", "report.json"}


def test_a_checkpoint_is_kept(tmp_path):
    assert run("--checkpoint", tmp_path / "kept").exit_code == 0
    assert len((tmp_path / "kept").read_text().splitlines()) == 4
    assert run("--checkpoint", tmp_path / "kept").exit_code == 0


def test_everything_can_be_done_from_python(tmp_path):
    found = ns.verify_claims("thm:all", report=tmp_path)
    assert found["thm:all[a]"].rests_on == ("lemma:two",)
    assert ns.verify_claims(["lemma:one"], "full").good
    with pytest.raises(ns.InputError, match="lemma:none"):
        ns.verify_claims("lemma:none")
