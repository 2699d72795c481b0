"""``nearsight lower-bound``: fields, files, and bad input."""

import json

import pytest
from click.testing import CliRunner

import nearsight as ns
from nearsight.cli import cli

COSTS = "--mu 1 --l-f 2 --l-t 1 --l-s 1"


def run(text):
    return CliRunner().invoke(cli, ["lower-bound", *text.split()])


def found(text):
    done = run(f"{text} --json")
    assert done.exit_code == 0, done.output
    assert done.stderr == ""
    return json.loads(done.stdout, parse_constant=pytest.fail)


def test_the_fields():
    document = found(f"--graph ring:13 {COSTS} -k 3 -r 2")
    assert list(document) == [
        *("parameters", "graph", "k", "r", "cr_minus_one", "instance"),
        *("temporal", "spatial", "joint", "stated"),
    ]
    parts = [document[name] for name in ("temporal", "spatial", "joint")]
    assert all(part["guarantee"] and part["cr_minus_one"] > 0 for part in parts)
    assert document["cr_minus_one"] == max(part["cr_minus_one"] for part in parts)
    assert document["temporal"]["cr_minus_one"] == pytest.approx(0.00354394, rel=1e-5)
    stated = document["stated"]
    assert stated["label"] == "thm:bottleneck"
    assert stated["guarantee"] is False
    assert stated["temporal"]["guarantee"] is True
    assert stated["spatial"]["cr_minus_one"] is None
    assert "Omega" in stated["spatial"]["reason"]


@pytest.mark.parametrize("family", ["line", "grid2", "tree:3", "ring-of-blocks:2"])
def test_infinite_networks(family):
    document = found(f"--growth {family} {COSTS} -k 4 -r 3")
    assert document["spatial"]["cr_minus_one"] > 0
    assert document["joint"]["cr_minus_one"] is None
    assert document["joint"]["reason"]


def test_a_growth_alone_has_no_spatial_bound():
    document = found(f"--growth poly:2,1 --max-degree 4 {COSTS} -k 2 -r 1")
    assert document["spatial"]["cr_minus_one"] is None
    assert "line" in document["spatial"]["reason"]
    assert document["cr_minus_one"] == document["temporal"]["cr_minus_one"]


@pytest.mark.parametrize(
    ("costs", "instance"),
    [
        ("--mu 1 --l-f 1 --l-t 1 --l-s 1", "temporal"),
        ("--mu 0.5 --l-f 1 --l-t 0.01 --l-s 3", "spatial"),
    ],
)
def test_lpc_pays_the_bound_on_the_saved_instance(costs, instance, tmp_path):
    file = tmp_path / "worst.npz"
    document = found(f"--graph grid:3x4 {costs} -k 2 -r 1 --save {file}")
    assert document["instance"] == instance
    played = ns.simulate(file, k=2, r=1)
    assert played.ratio_minus_one >= document["cr_minus_one"] * (1 - 1e-9)
    assert ns.load_problem(file).metadata["lower_bound"]["instance"] == instance


def test_for_people():
    done = run(f"--graph star:6 {COSTS} -k 2 -r 1")
    assert done.exit_code == 0
    assert "* in space" in done.stdout or "* in time" in done.stdout
    assert "thm:bottleneck" in done.stdout


def test_from_python():
    bound = ns.lower_bound(graph="ring:9", mu=1, l_f=1, l_T=10, l_S=0, k=1, r=0)
    assert bound.cr_minus_one == 10
    assert bound.spatial.cr_minus_one == 0
    assert bound.problem().H == 2


@pytest.mark.parametrize(
    ("text", "parts"),
    [
        (f"{COSTS} -k 2 -r 1", ("graph", "growth", "exactly one")),
        (f"--graph ring:5 --growth line {COSTS} -k 2 -r 1", ("exactly one",)),
        (f"--graph ring:5 {COSTS} -k 0 -r 1", ("-k", "0", ">= 1")),
        (f"--graph ring:5 {COSTS} -k 2 -r -1", ("-r", "-1", ">= 0")),
        (f"--graph ring:5 {COSTS} -k 9999999 -r 1", ("-k", "9999999", "<=")),
        (f"--graph ring:5 {COSTS} -k 2.5 -r 1", ("-k", "2.5", "integer")),
        ("--graph ring:5 --mu -1 --l-f 1 --l-t 1 --l-s 1 -k 2 -r 1", ("--mu", "-1", "> 0")),
        (f"--graph ring:2 {COSTS} -k 2 -r 1", ("--graph", "ring:2")),
        (f"--growth line {COSTS} -k 2 -r 1 --save x.npz", ("--save", "finite graph")),
        (
            "--graph ring:5 --mu 1 --l-f 1 --l-t 1 --l-s 0 -k 900000 -r 1 --save x.npz",
            ("-k", "900000", "at most"),
        ),
        (f"--graph ring:5 {COSTS} -k 2 -r 1 --save no/where/x.npz", ("--save", "no/where/x.npz")),
        (f"--graph ring:5 {COSTS} -k 2", ("-r", "Missing")),
    ],
)
def test_bad_input(text, parts, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run(text)
    assert done.exit_code == 2
    assert done.stdout == ""
    for part in parts:
        assert part in done.stderr
    assert "Traceback" not in done.stderr


@pytest.mark.parametrize("strength", ["1e17", "1e18", "1e300"])
def test_couplings_that_leave_no_digit_of_node_costs(strength):
    # the floor in time is a closed form; the others factorise a matrix
    document = found(f"--graph ring:5 --mu 1 --l-f 1 --l-t {strength} --l-s {strength} -k 2 -r 1")
    assert document["cr_minus_one"] == document["temporal"]["cr_minus_one"] > 0
    for part in (document["spatial"], document["joint"]):
        assert part["cr_minus_one"] is None
        assert "no digit" in part["reason"]
    grid = found(f"--growth grid2 --mu 1 --l-f 1 --l-t 1 --l-s {strength} -k 2 -r 100")
    assert "1e8" in grid["spatial"]["reason"]
