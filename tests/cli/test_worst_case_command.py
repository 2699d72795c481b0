import json
import subprocess
import sys
import time

import pytest
from click.testing import CliRunner

import nearsight as ns
from nearsight.cli import cli
from nearsight.lpc import load_problem

GIVEN = {"graph": "ring:6", "mu": 1, "l_f": 1, "l_T": 1, "l_S": 0.5, "horizon": 5}
WORDS = [
    "--graph",
    "ring:6",
    "--mu",
    "1",
    "--l-f",
    "1",
    "--l-t",
    "1",
    "--l-s",
    "0.5",
    "--horizon",
    "5",
]
SIGHT = ["-k", "3", "-r", "2"]


def run(*words):
    return CliRunner().invoke(cli, ["worst-case", *map(str, words)])


def worst(*words):
    done = run(*words, "--json")
    assert done.exit_code == 0, done.output
    assert done.stderr == ""
    assert done.stdout.count("\n") == 1
    return json.loads(done.stdout, parse_constant=pytest.fail)


def test_the_fields():
    found = worst(*WORDS, *SIGHT)
    assert list(found) == [
        *("graph", "parameters", "k", "r", "horizon", "dimension", "cr_minus_one", "residual"),
        *("method", "evidence", "kernel", "promised_cr_minus_one", "certificates", "seconds"),
    ]
    assert found["graph"] == {"source": "ring:6", "vertices": 6, "edges": 6, "max_degree": 2}
    assert found["parameters"] == pytest.approx({"mu": 1, "l_f": 1, "l_T": 1, "l_S": 0.5})
    assert (found["k"], found["r"], found["horizon"], found["dimension"]) == (3, 2, 5, 1)
    assert found["method"] == "dense"
    api = ns.worst_case(**GIVEN, k=3, r=2)
    assert found["cr_minus_one"] == api.worst.cr_minus_one == api.cr_minus_one
    sharp = ns.bound(
        **{name: GIVEN[name] for name in ("graph", "mu", "l_f", "l_T", "l_S")},
        k=3,
        r=2,
        unconstrained=True,
        label="nearsight:sharp-cr",
    )
    least = min(result.values["cr_minus_one"] for result in sharp)
    assert found["certificates"]["sharp"] == pytest.approx(least, rel=1e-9)
    assert found["cr_minus_one"] <= found["promised_cr_minus_one"] <= least * (1 + 1e-9)
    assert found["certificates"]["stated"] is None


@pytest.mark.parametrize("style", ["attraction", "repulsion", "blocks", "tilted"])
@pytest.mark.parametrize("more", [[], ["--varying", "--dimension", 2, "--seed", 4]])
def test_the_saved_instance_has_the_ratio(tmp_path, style, more):
    file = tmp_path / "worst.npz"
    found = worst(*WORDS, *SIGHT, "--style", style, *more, "--save", file)
    assert found["instance_file"] == str(file)
    assert found["instance_cr_minus_one"] == found["cr_minus_one"]
    notes = load_problem(file).metadata
    value = found["cr_minus_one"]
    assert notes == {"what": "worst case", "k": 3, "r": 2, "cr_minus_one": value}
    words = ["simulate", "--problem", str(file), *SIGHT, "--json"]
    played = json.loads(CliRunner().invoke(cli, words).stdout)
    assert played["ratio_minus_one"] == pytest.approx(value, rel=1e-9)
    again = worst("--problem", file, *SIGHT)
    assert again["cr_minus_one"] == pytest.approx(value, rel=1e-12)


def test_a_search_over_couplings(tmp_path):
    file = tmp_path / "searched.npz"
    found = worst(*WORDS, *SIGHT, "--search", 2, "--save", file)
    search = found["search"]
    assert search["cr_minus_one"] > 1.5 * found["cr_minus_one"]
    assert [climb["start"] for climb in search["climbs"]] == ["uniform differences", "uniform tilt"]
    assert search["parameters"]["l_T"] <= 1 + 1e-13
    assert (
        found["instance_cr_minus_one"] == search["cr_minus_one"] <= found["certificates"]["sharp"]
    )
    replayed = ns.simulate(str(file), k=3, r=2)
    assert replayed.ratio_minus_one == pytest.approx(search["cr_minus_one"], rel=1e-9)
    printed = run(*WORDS, *SIGHT, "--search", 1)
    assert "the worst of 1 climbs" in printed.stdout


def test_for_people():
    done = run(*WORDS, *SIGHT)
    assert done.exit_code == 0
    assert "worst ratio - 1   0.00512669 (dense)" in done.stdout
    assert "promised          at most 0.0712395" in done.stdout


def test_where_the_ratio_is_one():
    found = worst(*WORDS, "-k", 9, "-r", 9)
    assert (found["cr_minus_one"], found["method"]) == (0.0, "exact")
    assert "reach everything" in found["reason"]
    selfish = worst(*WORDS, "-k", 1, "-r", 0)
    assert selfish["promised_cr_minus_one"] is None
    assert "no theorem" in selfish["promised_reason"]
    assert "no guarantee" in run(*WORDS, "-k", 1, "-r", 0).stdout
    assert "reach everything" in run(*WORDS, "-k", 9, "-r", 9).stdout


def test_the_table(tmp_path):
    file = tmp_path / "rows.csv"
    found = worst(*WORDS, "--table", "3,2", "--csv", file)
    assert [(row["k"], row["r"]) for row in found["rows"]] == [(2, 1), (2, 2), (3, 1), (3, 2)]
    api = ns.sandwich(**GIVEN, ks=[2, 3], rs=[1, 2])
    assert [row["worst"] for row in found["rows"]] == [row.worst for row in api.rows]
    assert found["violations"] == []
    assert found["rows"][0]["stated"] is None
    assert file.read_text(encoding="utf-8").startswith("k,r,lower,worst,searched,stated")
    printed = run(*WORDS, "--table", "2,1", "--search", 1).stdout
    assert "no certificate is violated" in printed
    assert "2.44983" in printed


def test_resource_augmentation():
    words = [*WORDS, "--table", "4,3", "--augmentation"]
    found = worst(*words)
    pairs = found["augmentation"]["pairs"]
    assert [(p["k_star"], p["r_star"]) for p in pairs] == [
        (row["k"], row["r"]) for row in found["rows"]
    ]
    for p, row in zip(pairs, found["rows"], strict=True):
        assert p["lower"] == row["lower"]
        enough = [(q["k"], q["r"]) for q in found["rows"] if q["worst"] <= row["lower"]]
        assert {tuple(pair) for pair in p["measured"]} <= set(enough)
        assert bool(p["measured"]) == bool(enough)
        for k, r in p["certified"]:
            sharp = ns.bound(
                **{name: GIVEN[name] for name in ("graph", "mu", "l_f", "l_T", "l_S")},
                k=k,
                r=r,
                unconstrained=True,
                label="nearsight:sharp-cr",
            )
            assert min(b.values["cr_minus_one"] for b in sharp) <= row["lower"]
    assert found["augmentation"]["printed_rates"]["k"] == {"value": 4.0, "coupling": 0.0}
    printed = run(*words).stdout
    assert "r/r* up to\n36.0706" in printed
    assert "3, 2       1.5" in printed


BAD = [
    ([*WORDS, "-k", 0, "-r", 1], "-k: k = 0"),
    ([*WORDS, "-k", 2, "-r", -1], "-r: r = -1"),
    ([*WORDS, "-k", 2], "-k and -r needed"),
    ([*WORDS[2:], *SIGHT], "--graph needed"),
    ([*WORDS[:-2], *SIGHT], "--horizon needed"),
    ([*WORDS[:-1], 0, *SIGHT], "H = 0"),
    ([*WORDS, *SIGHT, "--style", "logcosh"], "--style: style = 'logcosh': quadratic couplings"),
    ([*WORDS, *SIGHT, "--method", "guess"], "--method: method = 'guess'"),
    ([*WORDS, *SIGHT, "--tolerance", 0], "--tolerance: tolerance = 0"),
    ([*WORDS, *SIGHT, "--search", -1], "--search: search = -1"),
    ([*WORDS, *SIGHT, "--search", 1, "--dimension", 2], "--search: search: over couplings"),
    ([*WORDS, *SIGHT, "--dimension", 0], "--dimension: n = 0"),
    ([*WORDS, *SIGHT, "--workers", -1], "--workers: workers = -1"),
    ([*WORDS, *SIGHT, "--problem", "x.npz"], "leave it out"),
    (["--problem", "none.npz", *SIGHT], "no such file"),
    ([*WORDS, *SIGHT, "--csv", "x.csv"], "--csv needs --table"),
    ([*WORDS, *SIGHT, "--augmentation"], "--augmentation needs --table"),
    ([*WORDS, *SIGHT, "--checkpoint", "x"], "--checkpoint needs --table or --search"),
    ([*WORDS, "--table", "2,1", "--checkpoint", "none/x"], "checkpoint none/x"),
    ([*WORDS, *SIGHT, "--search", 1, "--checkpoint", __file__], "it is no file of climbs"),
    ([*WORDS, *SIGHT, "--save", "none/x.npz"], "--save none/x.npz"),
    ([*WORDS, "--table", "2,1", "--csv", "none/x.csv"], "--csv none/x.csv"),
    ([*WORDS, "--table", "3"], "--table: '3': two integers"),
    ([*WORDS, "--table", "1,1"], "--table: '1,1': the first >= 2"),
    ([*WORDS, "--table", "2,1", "-k", 2], "-k would have no effect"),
    ([*WORDS, "--table", "2,1", "--varying"], "--varying would have no effect"),
    ([*WORDS[2:], "--table", "2,1"], "--graph needed"),
    ([*WORDS, *SIGHT, "--graph", "ring:2"], "ring"),
]


@pytest.mark.parametrize(("words", "said"), BAD, ids=[said for _, said in BAD])
def test_bad_input_ends_with_one_line_and_status_2(words, said):
    done = run(*words)
    assert done.exit_code == 2
    assert said in " ".join(done.stderr.split())
    assert done.stdout == ""
    assert "Traceback" not in done.stderr


def test_a_problem_that_is_not_quadratic_is_refused(tmp_path):
    boxed = ns.random_problem(**GIVEN, box=(-1, 1))
    ns.save_problem(boxed, tmp_path / "box.npz")
    done = run("--problem", tmp_path / "box.npz", *SIGHT)
    assert done.exit_code == 2
    assert "quadratic costs without constraints" in done.stderr
    with pytest.raises(ns.InputError, match="mu would have no effect"):
        ns.worst_case(boxed, k=2, r=1, mu=1)


def test_a_file_that_cannot_be_written_is_named(tmp_path):
    done = run(*WORDS, *SIGHT, "--save", tmp_path / "none" / "x.npz")
    assert done.exit_code == 2
    assert "--save" in done.stderr


def test_as_a_user_starts_it():
    code = "from nearsight.cli import main; main()"
    command = [sys.executable, "-c", code, "worst-case", *WORDS]
    done = subprocess.run([*command, *SIGHT], capture_output=True, text=True, check=False)
    assert (done.returncode, done.stderr) == (0, "")
    wrong = subprocess.run(
        [*command, "-k", "0", "-r", "1"], capture_output=True, text=True, check=False
    )
    assert wrong.returncode == 2
    assert wrong.stderr.count("\n") == 1


@pytest.mark.parametrize("what", [["--table", "6,4"], [*SIGHT, "--search", 5]])
def test_a_run_that_was_killed_goes_on(tmp_path, what):
    file = tmp_path / "kept"
    code = "from nearsight.cli import main; main()"
    words = [*WORDS, *map(str, what), "--checkpoint", str(file), "--json"]
    command = [sys.executable, "-c", code, "worst-case", *words]
    with subprocess.Popen(command, stdout=subprocess.DEVNULL) as process:
        header, deadline = 0, time.monotonic() + 60
        while time.monotonic() < deadline:  # until a unit is there
            data = file.read_bytes() if file.exists() else b""
            header = data.find(b"\n") + 1
            if header and len(data) > header:
                break
            time.sleep(0.005)
        process.kill()
    assert len(file.read_bytes()) > header > 0
    found = worst(*WORDS, *what, "--checkpoint", file)
    whole = worst(*WORDS, *what)
    assert found | {"seconds": 0} == whole | {"seconds": 0}
