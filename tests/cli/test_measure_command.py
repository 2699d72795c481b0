import json
import shlex
import subprocess
import sys
from dataclasses import replace

import pytest
from click.testing import CliRunner

import nearsight as ns
from nearsight.cli import cli, main
from nearsight.cli.measure import document
from nearsight.cli.measurement_tables import print_measurement, rows_of
from nearsight.lpc.instances import styles
from nearsight.perturbation import replay

GIVEN = {"graph": "grid:3x4", "mu": 1, "l_f": 2, "l_T": 1, "l_S": 0.5, "k": 3, "r": 2, "seed": 3}
TYPED = "--graph grid:3x4 --mu 1 --l-f 2 --l-t 1 --l-s 0.5 -k 3 -r 2 --seed 3"
WORDS = TYPED.split()
FEW = ["--instances", "12"]
WEAK = ["--mu", "1", "--l-f", "1", "--l-t", "1", "--l-s", "0.01", "-k", "3", "-r", "2"]
NEAR = [*WEAK[:-1], "1"]  # quickly searched
STAR = {"graph": "star:4", "mu": 1, "l_f": 1, "l_T": 1, "l_S": 0.01, "k": 3, "r": 1}


def run(*words):
    return CliRunner().invoke(cli, ["measure", *map(str, words)])


def measure(*words):
    done = run(*words, "--json")
    assert done.exit_code == 0, done.output
    assert done.stderr == ""
    assert done.stdout.count("\n") == 1
    return json.loads(done.stdout, parse_constant=pytest.fail)  # no NaN, no Infinity


def started(command, folder, before=""):
    """Run as a user does, in a process of its own."""
    code = f"{before}\nfrom nearsight.cli import main\nmain()"
    return subprocess.run(
        [sys.executable, "-c", code, "measure", *shlex.split(command)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )


def test_the_fields():
    found = measure(*WORDS, *FEW)
    assert list(found) == [
        *("parameters", "graph", "k", "r", "instances", "seed", "styles", "profiles", "slices"),
        *("jumps", "fit", "violations"),
    ]
    assert found["parameters"] == {"mu": 1, "l_f": 2, "l_T": 1, "l_S": 0.5}
    size = {"source": "grid:3x4", "vertices": 12, "edges": 17, "max_degree": 4}
    assert found["graph"] == size
    assert [found[name] for name in ("k", "r", "instances", "seed")] == [3, 2, 12, 3]
    assert found["styles"] == list(styles())
    parts = [cell["part"] for cell in found["profiles"]]
    assert list(dict.fromkeys(parts)) == ["top", "bottom", "lateral"]
    for cell in found["profiles"]:
        assert list(cell) == ["dt", "ds", "part", "measured_max", "instance", "bounds"]
        assert cell["bounds"].keys() >= {"stated", "repaired", "sharp"}
        assert 0 < cell["measured_max"] <= cell["bounds"]["sharp"]
        assert 0 <= cell["instance"] < 12
    for row in found["slices"]:
        assert list(row) == ["dt", "measured_max", "bounds"]
        assert 0 < row["measured_max"] <= row["bounds"]["sharp"]
    assert found["jumps"].keys() == {"stated", "repaired", "sharp"}
    assert list(found["fit"]) == ["rho_T", "rho_S", "ci", "cells"]
    for name, (low, high) in found["fit"]["ci"].items():
        assert 0 < low < high < 1
        assert 0 < found["fit"][name] < 1


@pytest.mark.parametrize(
    ("words", "given"),
    [
        ("", {}),
        ("--box -0.5,0.5 --spread 2", {"box": (-0.5, 0.5), "spread": 2.0}),
        ("--style blocks --style logcosh", {"styles": ("blocks", "logcosh")}),
        ("--dimension 2 --style tilted", {"n": 2, "styles": ("tilted",)}),
    ],
)
def test_one_call_from_python_gives_the_same(words, given):
    found = measure(*WORDS, *FEW, *words.split())
    same = ns.measure(**GIVEN, instances=12, **given)
    assert found == json.loads(json.dumps(document(same)))
    for cell, mine in zip(found["profiles"], same.profiles, strict=True):
        assert (cell["part"], cell["dt"], cell["ds"]) == (mine.part, mine.dt, mine.ds)
        assert cell["measured_max"] == mine.measured_max
        assert cell["bounds"] == mine.bounds
    assert [row["measured_max"] for row in found["slices"]] == list(same.slices.measured_max)
    assert found["jumps"] == same.jumps
    assert (found["fit"]["rho_T"], found["fit"]["rho_S"]) == (same.fit.rho_T, same.fit.rho_S)
    assert tuple(found["fit"]["ci"]["rho_T"]) == same.fit.ci["rho_T"]


def test_an_instance_named_is_the_one():
    found, spec = measure(*WORDS, *FEW), ns.measure(**GIVEN, instances=1).spec
    for cell in found["profiles"]:
        drawn = spec.draw(cell["instance"])
        seen = ns.sensitivity(drawn.window, drawn.y, drawn.z)
        assert cell["measured_max"] in seen.norms


def test_violations_name_where_and_by_how_much():
    found = measure("--graph", "ring:9", *WEAK, "--instances", 30)
    assert {item["tier"] for item in found["violations"]} == {"stated"}
    assert {item["part"] for item in found["violations"]} == {"top", "bottom", "jump"}
    cells = {(c["part"], c["dt"], c["ds"]): c for c in found["profiles"]}
    for item in found["violations"]:
        if item["part"] == "jump":
            assert item["ratio"] == found["jumps"]["stated"] > 1
            continue
        cell = cells[item["part"], item["dt"], item["ds"]]
        assert item["measured_max"] == cell["measured_max"] > cell["bounds"]["stated"]
        assert item["bound"] == cell["bounds"]["stated"]
    typed = "--graph ring:9 --mu 1 --l-f 1 --l-t 0.2 --l-s 0.3 -k 3 -r 2"
    slices = measure(*typed.split())
    assert {"tier": "stated", "part": "slice", "dt": 1} in slices["violations"]


def test_what_a_search_saves_can_be_replayed(tmp_path):
    file = tmp_path / "the worst.npz"
    words = ["--graph", "star:4", *NEAR, "--instances", 3, "--search"]
    found = measure(*words, "--save", file)
    told, best = replay(file), found["search"]
    assert list(best) == [
        *("agent", "free", "fixed", "value", "tier", "bound", "ratio"),
    ]
    assert told.told == best["value"] == pytest.approx(told.measured, rel=1e-12)
    assert told.bounds[best["tier"]] == best["bound"]
    assert best["ratio"] == best["value"] / best["bound"] > 1
    names = told.window.problem.network.names
    for end, (step, agent) in (("free", told.target.free), ("fixed", told.target.fixed)):
        assert best[end] == [step, str(names[agent])]
    assert best["agent"] == "0"  # the hub
    searched = {(c["part"], c["dt"], c["ds"]): c.get("searched_max") for c in found["profiles"]}
    assert best["value"] in searched.values()
    same = ns.search_sensitivity(**STAR)
    assert {key: value for key, value in searched.items() if value} == same.cells
    assert same.worst.ratio == best["ratio"]
    assert found == measure(*words)


def test_a_search_reaches_what_no_instance_does():
    # one instance around a leaf of a path: the search around an inner agent sees more
    words = ["--graph", "path:5", *NEAR, "--instances", 1, "--seed", 1, "--search"]
    found, text = measure(*words), run(*words).stdout
    alone = [cell for cell in found["profiles"] if cell["measured_max"] is None]
    for cell in alone:
        assert (cell["reason"], cell["instance"]) == ("in no instance measured", None)
        assert 0 < cell["searched_max"] <= cell["bounds"]["sharp"] * (1 + 1e-9)
    more = [item for item in found["violations"] if "searched_max" in item]
    assert more
    for item in more:
        assert item["searched_max"] > item["bound"]
        # marked, whether or not the measured value exceeds it, too
        line = next(
            x.split()
            for x in text.split(f"\n{item['part']} boundary")[1].splitlines()
            if x.split()[:2] == [str(item["dt"]), str(item["ds"])]
        )
        assert line[line.index(f"{item['bound']:.6g}") + 1] == "!"
    only = [item for item in more if _measured(found, item) <= item["bound"]]
    assert only
    assert "! violated: stated\n" in text


def _measured(found, item):
    place = [item[name] for name in ("part", "dt", "ds")]
    values = [
        c["measured_max"] for c in found["profiles"] if [c["part"], c["dt"], c["ds"]] == place
    ]
    return values[0] or 0.0


def test_a_pair_only_the_search_has_seen_is_listed_and_judged(capsys):
    measured = ns.measure(**STAR, instances=4)
    found = ns.search_sensitivity(**STAR)
    few = replace(measured, profiles=measured.profiles[3:])
    lost = [
        (c.part, c.dt, c.ds) for c in measured.profiles[:3] if (c.part, c.dt, c.ds) in found.cells
    ]
    rows = {(row.part, row.dt, row.ds): row for row in rows_of(few, found)}
    assert lost
    for key, cell in zip(lost, measured.profiles, strict=False):
        assert rows[key].bounds == cell.bounds
        assert (rows[key].measured, rows[key].searched) == (None, found.cells[key])
    read = document(few, found)
    assert any(item["part"] == "top" and "searched_max" in item for item in read["violations"])
    print_measurement(few, found)
    assert "stated" in capsys.readouterr().out.splitlines()[-1]


def test_a_checkpoint_is_resumed_to_the_same_numbers(tmp_path):
    file = tmp_path / "units"
    words = [*WORDS, "--instances", 45]
    whole = measure(*words)
    assert measure(*words, "--checkpoint", file) == whole
    full = file.read_bytes()
    for kept in (len(full) - 7, len(full) // 2, full.index(b"\n") + 1, 0):
        file.write_bytes(full[:kept])
        assert measure(*words, "--checkpoint", file) == whole
        assert file.read_bytes() == full
    assert measure(*words, "--checkpoint", file, "--workers", 2) == whole


def test_workers_change_nothing():
    words = [*WORDS, "--instances", 45]
    assert measure(*words, "--workers", 2) == measure(*words)


def test_a_network_of_one_agent():
    found = measure("--graph", "path:1", *WEAK, *FEW, "--search")
    assert found["graph"]["vertices"] == 1
    assert {(cell["part"], cell["ds"]) for cell in found["profiles"]} == {("top", 0), ("bottom", 0)}
    assert found["fit"]["rho_S"] is None
    assert "rho_S" in found["fit"]["reason"]
    # the printed constants vanish with the degree
    assert found["jumps"]["stated"] is None
    assert "the bound is 0" in found["jumps_reasons"]["stated"]
    assert (found["search"]["ratio"], found["search"]["reason"]) == (
        None,
        found["jumps_reasons"]["stated"],
    )
    assert "inf times the stated bound" in run("--graph", "path:1", *WEAK, *FEW, "--search").stdout


@pytest.mark.parametrize(
    ("lines", "vertices"),
    [
        ("a b\nb c\nd e\ne f\n", 6),  # two components
        ("a b\nb c\nlonely\n", 4),  # an agent without neighbours
        ("a\nb\nc\n", 3),  # nobody has a neighbour
    ],
)
@pytest.mark.parametrize("more", [[], ["--search"]])
def test_networks_in_pieces(lines, vertices, more, tmp_path):
    file = tmp_path / "pieces.adjlist"
    file.write_text(lines, encoding="utf-8")
    found = measure("--graph", file, *NEAR, *FEW, *more)
    assert found["graph"]["vertices"] == vertices
    assert {item["tier"] for item in found["violations"]} <= {"stated"}
    assert run("--graph", file, *NEAR, *FEW, *more).exit_code == 0


def test_one_instance_has_no_intervals():
    found = measure(*WORDS, "--instances", 1)
    assert found["fit"]["ci"] == {"rho_T": None, "rho_S": None}
    assert found["fit"]["reason"] == "one instance gives no interval"


def test_people_read_the_same_numbers():
    found, text = measure(*WORDS, *FEW), run(*WORDS, *FEW).stdout
    assert "grid:3x4: 12 agents, degree at most 4; k = 3, r = 2\n" in text
    assert "mu = 1, l_f = 2, l_T = 1, l_S = 0.5\n" in text
    for part in ("top", "bottom", "lateral"):
        lines = text.split(f"\n{part} boundary: ")[1].splitlines()[4:]
        cells = [cell for cell in found["profiles"] if cell["part"] == part]
        for cell, line in zip(cells, lines, strict=False):
            shown = [word for word in line.split() if word != "!"]
            assert [int(word) for word in shown[:2]] == [cell["dt"], cell["ds"]]
            assert shown[2] == f"{cell['measured_max']:.6g}"
            assert line.count("!") == len([x for x in found["violations"] if _same(x, cell)])
    low, high = found["fit"]["ci"]["rho_T"]
    rate = found["fit"]["rho_T"]
    assert f"fitted rho_T = {rate:.6g}, 95 % interval {low:.6g} to {high:.6g}\n" in text
    assert all(line == line.rstrip() for line in text.splitlines())


def _same(item, cell):
    names = ("part", "dt", "ds")
    return [item.get(name) for name in names] == [cell[name] for name in names]


def test_help_names_every_style():
    text = run("--help").stdout.split()
    for name in styles():
        assert any(word.rstrip(";.") == name for word in text), name


RING = "--graph ring:9 --mu 1 --l-f 2 --l-t 1 --l-s 1"
SEEN = f"{RING} -k 3 -r 2"
BAD = {
    "-k 3 -r 2": ("--mu", "needed"),
    "--mu 1 --l-f 2 --l-t 1 --l-s 1 -k 3 -r 2": ("--graph needed", "ring:13"),
    f"{RING} -r 2": ("-k", "needed"),
    f"{RING} -k 3": ("-r", "needed"),
    f"{RING} -k 2.5 -r 2": ("-k", "2.5", "integer"),
    f"{RING} -k 1 -r 2": ("-k", "k = 1", "k >= 2"),
    f"{RING} -k 0 -r 2": ("-k", "k = 0", ">= 1"),
    f"{RING} -k 3 -r 0": ("r = 0", "r >= 1"),
    f"{RING} -k 3 -r -1": ("-r", "r = -1", ">= 0"),
    f"{SEEN} --instances 0": ("--instances", "0", ">= 1"),
    f"{SEEN} --instances -4": ("--instances", "-4", ">= 1"),
    f"{SEEN} --style magic": ("--style", "'magic'", "attraction", "tilted"),
    f"{SEEN} --box 3,1": ("--box", "3,1", "the first at most the second"),
    f"{SEEN} --box nan,1": ("--box", "nan,1", "two numbers"),
    f"{SEEN} --box a": ("--box", "'a'", "two numbers, such as -1,1"),
    f"{SEEN} --spread 0": ("--spread", "0", "> 0"),
    f"{SEEN} --spread -2": ("--spread", "-2", "> 0"),
    f"{SEEN} --spread nan": ("--spread", "nan", "> 0"),
    f"{SEEN} --spread inf": ("inf", "finite"),
    f"{SEEN} --dimension 0": ("--dimension", "0", ">= 1"),
    f"{SEEN} --dimension 0 --search": ("--dimension", "0", ">= 1"),
    f"{SEEN} --workers -1": ("--workers", "-1", ">= 0"),
    f"{SEEN} --seed -1": ("--seed", "-1", ">= 0"),
    f"{SEEN} --cluster nonsense": ("--cluster", "'nonsense'", "Dask scheduler"),
    f"{SEEN} --save w.npz": ("--save w.npz", "--search"),
    f"{SEEN} --search --save none/w.npz": ("--save none/w.npz", "is needed"),
    f"{SEEN} --search --save units/w.npz": ("--save units/w.npz", "is needed"),
    f"{SEEN} --search --save .": ("--save", "'.'", "directory"),
    f"{SEEN} --checkpoint none/c": ("--checkpoint none/c", "is needed"),
    f"{SEEN} --checkpoint .": ("--checkpoint", "'.'", "directory"),
    f"{SEEN} --checkpoint units": ("checkpoint units", "another measurement", "another file"),
    f"{SEEN} --checkpoint text": ("checkpoint text", "no file of measurements", "another file"),
    f"{RING} -k 300 -r 4 --search": ("--search", "k = 300, r = 4", "2093 unknowns", "at most 1500"),
    f"{SEEN} --mu nan": ("--mu", "nan", "finite number > 0"),
    f"{SEEN} --mu -1": ("--mu", "-1", "> 0"),
    f"{SEEN} --mu 3": ("--l-f", "l_f = 2 < mu = 3", "l_f >= mu"),
    f"{SEEN} --l-f inf": ("--l-f", "inf", "finite"),
    f"{SEEN} --l-t -1": ("--l-t", "-1", ">= 0"),
    f"{SEEN} --l-s nan": ("--l-s", "nan", ">= 0"),
    f"{SEEN} --graph none.graphml": ("none.graphml", "no such file"),
    f"{SEEN} --graph ring:2": ("--graph", "ring:2", "N >= 3"),
    f"{SEEN} --growth line": ("--growth",),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("inputs")
    ns.measure(**GIVEN, instances=2, checkpoint=path / "units")
    (path / "text").write_text("not one\n", encoding="utf-8")
    return path


def refused(command, monkeypatch, capsys):
    monkeypatch.setattr("sys.argv", ["nearsight", "measure", *shlex.split(command)])
    monkeypatch.setattr("signal.signal", lambda *_: None)
    with pytest.raises(SystemExit) as end:
        main()
    out, err = capsys.readouterr()
    assert (end.value.code, out) == (2, "")
    (line,) = err.splitlines()
    return line


@pytest.mark.parametrize("command", BAD)
def test_bad_input_is_one_line(command, folder, monkeypatch, capsys):
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    monkeypatch.chdir(folder)
    line = refused(command, monkeypatch, capsys)
    for part in BAD[command]:
        assert part in line
    after = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert after == before


@pytest.mark.parametrize("words", ["--search --save none/w", "--checkpoint none/c"])
def test_files_are_looked_at_before_the_long_part(words, tmp_path, monkeypatch, capsys):
    def fail(**_):
        pytest.fail("began")

    monkeypatch.setattr("nearsight.measuring.measure", fail)
    monkeypatch.setattr("nearsight.measuring.search_sensitivity", fail)
    monkeypatch.chdir(tmp_path)
    assert "is needed" in refused(f"{SEEN} {words}", monkeypatch, capsys)
    assert list(tmp_path.iterdir()) == []


def test_a_cluster_that_is_not_there(tmp_path):
    impatient = (
        "import distributed as d\nc = d.Client\n"
        "d.Client = lambda address, timeout: c(address, timeout='300ms')\n"
    )
    done = started(f"{SEEN} --cluster tcp://127.0.0.1:9 --json", tmp_path, impatient)
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    for part in ("--cluster", "tcp://127.0.0.1:9", "no Dask scheduler answers"):
        assert part in line


@pytest.mark.parametrize(
    ("words", "module", "package"),
    [
        ("--workers 2", "joblib", "joblib"),
        ("--cluster tcp://a:1", "distributed", "'dask[distributed]'"),
    ],
)
def test_a_library_that_is_not_there(words, module, package, monkeypatch, capsys):
    monkeypatch.setitem(sys.modules, module, None)
    line = refused(f"{SEEN} --instances 45 {words}", monkeypatch, capsys)
    assert words.split()[0] in line
    assert f"pip install {package} (the extra parallel)" in line


def test_a_solver_that_fails_is_one_line_too(monkeypatch, capsys):
    def fail(**_):
        raise ns.NearsightError("instance 7: not solved")

    monkeypatch.setattr("nearsight.measuring.measure", fail)
    assert "instance 7: not solved" in refused(SEEN, monkeypatch, capsys)


def test_no_progress_unless_on_a_terminal(tmp_path):
    slow = "import time\nstart = time.monotonic()\ntime.monotonic = lambda: "
    slow += "(globals().update(start=start + 2), start)[1]"  # every look at the clock is 2 s later
    done = started(f"{TYPED} --instances 45 --json", tmp_path, slow)
    assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["instances"] == 45
