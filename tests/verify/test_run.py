import json
import subprocess
import sys
import time

import pytest

from nearsight.graphs import InputError
from nearsight.perturbation import Runner
from nearsight.verify import Claim
from nearsight.verify.recorded import record, recorded
from nearsight.verify.run import run

from .small import ALGEBRA, DECISION, FALSE, claims


@pytest.fixture(autouse=True)
def path(tmp_path, monkeypatch):
    path = tmp_path / "recorded.json"
    path.write_text("{}")
    monkeypatch.setattr("nearsight.verify.recorded.PATH", path)
    return path


def test_verdicts_and_what_they_rest_on():
    found = run(claims=claims())
    assert found.counts == {"proved": 3, "supported": 1, "refuted": 1}
    assert found["thm:top[a]"].rests_on == ("lemma:false",)
    assert found["lemma:middle"].rests_on == ("lemma:false",)
    assert found["thm:top[b]"].rests_on == found["lemma:false"].rests_on == ()


def test_a_run_of_few_claims_takes_the_others_as_recorded():
    assert run(["thm:top"], claims=claims())["thm:top[a]"].rests_on == ()
    record(run(claims=claims()), everything=True)
    found = run(["thm:top"], claims=claims())
    assert [claim.key for claim in found.claims] == ["thm:top[a]", "thm:top[b]"]
    assert found["thm:top[a]"].rests_on == ("lemma:false",)
    assert found.good


def test_changes_against_the_record(path):
    assert len(run(claims=claims()).changes) == 5
    assert record(run(claims=claims()), everything=True) == 5
    assert run(claims=claims(), mutation=True).good
    path.write_text(json.dumps({**recorded(), "lemma:base": "refuted", "lemma:gone": "proved"}))
    changed = [str(change) for change in run(claims=claims()).changes]
    assert changed == [
        "lemma:base: proved, recorded is refuted",
        "lemma:gone: no verdict, recorded is proved",
    ]
    assert [c.key for c in run(["lemma:base"], claims=claims()).changes] == ["lemma:base"]
    assert not run(["thm:top"], claims=claims()).changes


def test_a_claim_without_verdict_is_an_error_and_not_recorded(path):
    both = Claim("lemma:both", "both", "x", "", (ALGEBRA, FALSE))
    found = run(claims=[both, *claims()])
    assert "at once" in found.errors["lemma:both"]
    assert not found.good
    with pytest.raises(InputError, match="lemma:both"):
        record(found, everything=True)
    assert path.read_text() == "{}"


def test_an_unknown_label_lists_near_ones():
    with pytest.raises(InputError, match="near it: thm:top"):
        run(["thm:tp"], claims=claims())
    many = [Claim(f"thm:{x}", x, "x", "", (ALGEBRA,)) for x in "hAgBfCeD"]
    for given, five in (("THM:D5zzzzzzzzzzz", "CDefg"), ("zzz", "Defgh"), ("!!", "ABCDe")):
        with pytest.raises(InputError) as caught:
            run([given], claims=many)
        assert str(caught.value).endswith(": " + ", ".join(f"thm:{x}" for x in five))
    with pytest.raises(InputError, match="quick or full"):
        run(level="slow", claims=claims())


KEYS = (
    "lemma:spatial-upper-and-lower",  # decisions and intervals
    "prop:exp-decay-networked-SOCO[c]",  # a decision and a search
    "lemma:temporal-upper-and-lower[difference]",
    "thm: l-power[a]",
    "nearsight:slice-decay",
    "thm:networked-exp-decay:e2[r]",  # a search only
    "coro:CR-LPC",  # refuted
)


def test_two_processes_find_the_same():
    one, two = (run(KEYS, runner=Runner(n)) for n in (1, 2))
    assert one.verdicts == two.verdicts
    assert len(one.verdicts) >= len(KEYS)
    one, two = (run(KEYS[:2], mutation=True, runner=Runner(n)) for n in (1, 2))
    assert one.mutations == two.mutations


@pytest.mark.slow
def test_a_killed_run_goes_on_to_the_same_bytes(tmp_path):
    file = tmp_path / "journal"
    script = "from nearsight.cli import cli; cli()"
    command = [sys.executable, "-c", script, "verify", *KEYS, "--json", "--workers"]
    options = {"stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    first = subprocess.Popen([*command, "1", "--checkpoint", str(file)], **options)
    while first.poll() is None and (not file.exists() or file.read_bytes().count(b"\n") < 3):
        time.sleep(0.02)
    first.kill()  # as kill -9 does
    first.communicate()
    assert 3 <= file.read_bytes().count(b"\n") <= len(KEYS) + 4
    found = [
        json.loads(subprocess.run([*command, *more], **options).stdout)["claims"]
        for more in (("2", "--checkpoint", str(file)), ("1",))
    ]
    bytes_of = [[json.dumps(c["evidence"]) for c in claims] for claims in found]
    assert bytes_of[0] == bytes_of[1]


class Counted:
    """A run that is interrupted after some results."""

    def __init__(self, stop):
        self.stop, self.calls = stop, []

    def __call__(self, done, total):
        self.calls.append(done)
        if done == self.stop:
            raise KeyboardInterrupt


@pytest.mark.parametrize("damage", ["none", "cut", "torn"])
def test_an_interrupted_run_goes_on(tmp_path, damage):
    file = tmp_path / "journal"
    with pytest.raises(KeyboardInterrupt):
        run(claims=claims(), checkpoint=file, progress=Counted(3))
    if damage == "cut":
        file.write_bytes(file.read_bytes()[:-9])
    elif damage == "torn":
        file.write_bytes(file.read_bytes() + b'{"task": ["verd')
    seen = Counted(-1)
    found = run(claims=claims(), checkpoint=file, progress=seen)
    assert seen.calls == [2 if damage == "cut" else 3, *range(3 if damage == "cut" else 4, 6)]
    assert found.verdicts == run(claims=claims()).verdicts
    again = Counted(-1)
    assert run(claims=claims(), checkpoint=file, progress=again).verdicts == found.verdicts
    assert again.calls == [5]


def test_results_of_other_code_are_not_used(tmp_path, monkeypatch):
    file = tmp_path / "journal"
    run(claims=claims(), checkpoint=file)
    monkeypatch.setattr("nearsight.verify.journal.fingerprint", lambda: "other")
    seen = Counted(-1)
    run(claims=claims(), checkpoint=file, progress=seen)
    assert seen.calls[0] == 0


def test_a_strange_checkpoint_is_refused(tmp_path):
    file = tmp_path / "notes"
    file.write_text("mine\n")
    with pytest.raises(InputError, match="no file of verdicts"):
        run(claims=claims(), checkpoint=file)
    assert file.read_text() == "mine\n"
    with pytest.raises(InputError, match="checkpoint"):
        run(claims=claims(), checkpoint=tmp_path)


def test_a_missing_library_says_what_to_install(monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "z3", None)
    z = [Claim("lemma:z", "z", "z", "", (DECISION,))]
    with pytest.raises(InputError, match=r"needs z3-solver: pip install z3-solver \(the extra"):
        run(claims=z)
    monkeypatch.setitem(__import__("sys").modules, "flint", None)
    with pytest.raises(InputError) as caught:
        run(claims=z)
    assert str(caught.value) == (
        "verification needs z3-solver and python-flint: pip install z3-solver python-flint "
        "(the extra certify)"
    )
