import json
import math
import shlex
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from click.testing import CliRunner

import nearsight as ns
from nearsight.cli import cli, main
from nearsight.cli.simulation_tables import document, print_simulation
from nearsight.lpc import promise
from nearsight.lpc.controller import METHODS
from nearsight.lpc.costs import Callables
from nearsight.lpc.instances import styles, target_kinds

GIVEN = {"graph": "grid:3x4", "mu": 1, "l_f": 2, "l_T": 1, "l_S": 0.5, "horizon": 8, "seed": 3}
TYPED = "--graph grid:3x4 --mu 1 --l-f 2 --l-t 1 --l-s 0.5 --horizon 8 --seed 3"
WORDS = TYPED.split()
SIGHT = ["-k", "3", "-r", "2"]


def run(*words):
    return CliRunner().invoke(cli, ["simulate", *map(str, words)])


def simulate(*words):
    done = run(*words, "--json")
    assert done.exit_code == 0, done.output
    assert done.stderr == ""
    assert done.stdout.count("\n") == 1
    return json.loads(done.stdout, parse_constant=pytest.fail)  # no NaN, no Infinity


def started(command, folder, before=""):
    """Run as a user does, in a process of its own."""
    code = f"{before}\nfrom nearsight.cli import main\nmain()"
    return subprocess.run(
        [sys.executable, "-c", code, "simulate", *shlex.split(command)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )


def timeless(found):
    return {name: value for name, value in found.items() if name != "seconds"}


def test_the_fields():
    found = simulate(*WORDS, *SIGHT)
    assert list(found) == [
        *("k", "r", "horizon", "dimension", "cost", "optimal_cost", "ratio", "ratio_minus_one"),
        *("costs", "optimal_costs", "certificate", "parameters", "parameters_source"),
        *("promised_cr_minus_one", "method", "seconds"),
    ]
    assert (found["k"], found["r"], found["horizon"], found["dimension"]) == (3, 2, 8, 1)
    assert list(found["certificate"]) == [
        *("ratio_minus_one", "optimum_gap", "optimum_error", "optimum_method"),
        *("action_error", "violation"),
    ]
    assert found["costs"].keys() == {"node", "temporal", "spatial"} == found["optimal_costs"].keys()
    assert found["cost"] == pytest.approx(sum(found["costs"].values()), rel=1e-14)
    assert found["optimal_cost"] == pytest.approx(sum(found["optimal_costs"].values()), rel=1e-14)
    assert found["ratio"] == pytest.approx(found["cost"] / found["optimal_cost"], rel=1e-14)
    lower, upper = found["certificate"]["ratio_minus_one"]
    assert 0 < lower <= found["ratio_minus_one"] <= upper < found["promised_cr_minus_one"]
    assert found["parameters"] == {"mu": 1, "l_f": 2, "l_T": 1, "l_S": 0.5}
    assert set(found["parameters_source"].values()) == {"exact"}
    assert found["seconds"].keys() == {"lpc", "optimum"}


@pytest.mark.parametrize(
    ("words", "given"),
    [
        ("", {}),
        ("--box -0.5,0.5", {"box": (-0.5, 0.5)}),
        ("--style blocks --dimension 2 --varying", {"style": "blocks", "n": 2, "varying": True}),
        ("--style logcosh --targets walk", {"style": "logcosh", "targets": "walk"}),
        ("--targets far:2,1 --box 0,1 --workers 2", {"targets": "far:2,1", "box": (0, 1)}),
        ("--method barrier --tolerance 1e-6", {"method": "barrier", "tolerance": 1e-6}),
    ],
)
def test_one_call_from_python_gives_the_same(words, given):
    found = simulate(*WORDS, *SIGHT, *words.split())
    same = ns.simulate(**GIVEN, k=3, r=2, **given)
    assert timeless(found) == timeless(
        json.loads(json.dumps(document(same, promise(same.problem, 3, 2))))
    )
    assert found["ratio"] == same.ratio
    assert found["cost"] == same.cost == same.problem.cost(same.x)
    assert found["optimal_cost"] == same.optimum.cost
    assert tuple(found["certificate"]["ratio_minus_one"]) == same.interval


@pytest.mark.parametrize("words", ["", "--box -0.3,0.3 --dimension 2", "--style softplus"])
def test_a_saved_problem_replays_bit_for_bit(words, tmp_path):
    file, copy = tmp_path / "a problem.npz", tmp_path / "copy.npz"
    first = simulate(*WORDS, *SIGHT, *words.split(), "--save", file)
    again = simulate("--problem", file, *SIGHT, "--save", copy)
    assert timeless(again) == timeless(first)
    assert timeless(simulate("--problem", copy, *SIGHT)) == timeless(first)
    assert ns.simulate(file, k=3, r=2).ratio == first["ratio"]


def test_a_checkpoint_is_resumed_to_the_same_numbers(tmp_path):
    file, actions = tmp_path / "steps", tmp_path / "actions.npz"
    words = [*WORDS, *SIGHT, "--box", "-0.3,0.3"]
    whole = simulate(*words)
    assert timeless(simulate(*words, "--checkpoint", file, "--actions", actions)) == timeless(whole)
    full, x = file.read_bytes(), np.load(actions)["lpc"]
    row = 8 * (12 + 1)  # the actions of a step, and their error
    for steps, torn in ((0, 0), (3, 0), (3, 11), (8, 0)):
        file.write_bytes(full[: len(full) - (8 - steps) * row + torn])
        resumed = simulate(*words, "--checkpoint", file, "--actions", actions)
        assert timeless(resumed) == timeless(whole)
        assert file.read_bytes() == full
        np.testing.assert_array_equal(np.load(actions)["lpc"], x)


def test_actions_holds_both_trajectories(tmp_path):
    file = tmp_path / "actions"
    found = simulate(*WORDS, *SIGHT, "--dimension", 2, "--actions", file)
    same = ns.simulate(**GIVEN, n=2, k=3, r=2)
    with np.load(file) as kept:
        assert sorted(kept) == ["lpc", "optimum", "x_0"]
        np.testing.assert_array_equal(kept["lpc"], same.x)
        np.testing.assert_array_equal(kept["optimum"], same.optimum.x)
        np.testing.assert_array_equal(kept["x_0"], same.problem.x_0)
    assert same.problem.cost(same.x) == found["cost"]


@pytest.mark.parametrize(("k", "r"), [(1, 2), (3, 0)])
def test_without_sight_there_is_no_promise_but_a_reason(k, r):
    found = simulate(*WORDS, "-k", k, "-r", r)
    assert found["promised_cr_minus_one"] is None
    assert "nothing is free" in found["promised_reason"]
    assert found["ratio"] > 1
    assert f"no guarantee: {found['promised_reason']}" in run(*WORDS, "-k", k, "-r", r).stdout


def test_help_names_every_style_target_and_method():
    text = run("--help").stdout.split()
    for name in (*styles(), *target_kinds(), *METHODS[1:]):
        assert any(word.rstrip(".") == name for word in text), name


def test_people_read_the_same_numbers():
    found = simulate(*WORDS, *SIGHT)
    text = run(*WORDS, *SIGHT).stdout
    assert "grid:3x4: 12 agents, 17 edges; 8 steps, actions of 1 number\n" in text
    assert "mu = 1, l_f = 2, l_T = 1, l_S = 0.5; every set all of R^n" in text
    total = next(line.split() for line in text.splitlines() if line.split()[:1] == ["total"])
    assert total[1:] == [f"{found[name]:.8g}" for name in ("cost", "optimal_cost")]
    assert f"ratio - 1   {found['ratio_minus_one']:.6g}, certified in [" in text
    assert f"at most {found['promised_cr_minus_one']:.6g} on any such instance" in text
    assert all(line == line.rstrip() for line in text.splitlines())


def calm(feasible=None):
    """Costs that are all 0 at targets which stay where the agents start."""
    network, there = ns.parse_graph("ring:9"), np.array([0.41, -1.3])
    rng = np.random.default_rng(0)
    weights = rng.uniform(1, 4, (6, 9, 1, 1)) * np.eye(2)
    pair = np.kron([[1, -1], [-1, 1]], np.eye(2))
    costs = ns.Quadratic(weights, there), ns.Quadratic(0.5 * pair), ns.Quadratic(0.2 * pair)
    more = {} if feasible is None else {"feasible": feasible}
    return ns.Problem(network, 6, *costs, x_0=there, **more)


# OPT = 0 means that all costs are 0 at x*; as node costs are strongly convex and nonnegative, x*
# is their minimiser theta. Then theta solves every local problem, whose boundary is theta too, and
# costs nothing there: LPC plays theta. No instance has OPT = 0 < cost(LPC). What there is, is
# rounding and the tolerance of solvers.
def test_if_the_optimum_costs_nothing_neither_does_lpc():
    words = "--graph ring:9 --mu 1 --l-f 1 --l-t 0 --l-s 0 --horizon 3"
    found = simulate(*words.split(), *SIGHT)
    assert (found["cost"], found["optimal_cost"], found["ratio"]) == (0, 0, 1)
    assert "ratio_reason" not in found
    assert "ratio - 1   0, certified in" in run(*words.split(), *SIGHT).stdout
    exact = ns.simulate(calm(), k=3, r=2, method="direct")
    assert exact.x == pytest.approx(np.broadcast_to(calm().x_0, exact.x.shape), abs=1e-14)


def test_a_quotient_of_two_roundings_is_no_ratio(tmp_path):
    file = tmp_path / "calm.npz"
    ns.save_problem(calm(ns.Box(-100, 100)), file)
    found = simulate("--problem", file, *SIGHT)
    assert 0 <= found["optimal_cost"] <= found["certificate"]["optimum_gap"] < 1e-20
    assert 0 <= found["cost"] < 1e-15
    assert found["ratio"] is None
    assert found["ratio_minus_one"] is None
    assert "cannot be told from 0" in found["ratio_reason"]
    assert found["certificate"]["ratio_minus_one"][1] is None
    assert "no upper end" in found["certificate"]["reasons"]["ratio_minus_one"]
    text = run("--problem", file, *SIGHT).stdout
    assert f"ratio - 1   not determined: {found['ratio_reason']}\n" in text


def test_an_optimum_of_nothing_beside_something(capsys):
    # there is no such instance (above); but a solver might not tell the optimum from 0
    true = ns.simulate(**GIVEN, k=3, r=2)
    promised = promise(true.problem, 3, 2)
    made = replace(true, optimum=replace(true.optimum, gap=2 * true.optimum.cost))
    found = document(made, promised)
    assert math.isnan(made.ratio)
    assert (found["ratio"], found["ratio_minus_one"]) == (None, None)
    assert found["ratio_reason"]
    print_simulation(made, promised)
    assert f"not determined: {found['ratio_reason']}" in capsys.readouterr().out
    unknown = replace(true, action_error=math.nan, method="casadi")
    assert document(unknown, promised)["certificate"]["reasons"] == {
        "action_error": "casadi gives no bound"
    }


def test_time_is_shown_once_it_matters(capsys):
    true = ns.simulate(**GIVEN, k=3, r=2)
    promised = promise(true.problem, 3, 2)
    print_simulation(true, promised)
    print_simulation(replace(true, seconds={"lpc": 61.0, "optimum": 2.5}), promised)
    assert capsys.readouterr().out.count("time        lpc 61 s, optimum 2.5 s") == 1


def test_no_progress_unless_on_a_terminal(tmp_path):
    words = "--graph ring:60 --mu 1 --l-f 2 --l-t 1 --l-s 0.5 --horizon 40 -k 5 -r 3 --box -1,1"
    slow = "import time\nstart = time.monotonic()\ntime.monotonic = lambda: "
    slow += "(globals().update(start=start + 2), start)[1]"  # every look at the clock is 2 s later
    for more in ("", " --json"):
        done = started(words + more, tmp_path, slow)
        assert (done.returncode, done.stderr) == (0, "")
    assert json.loads(done.stdout)["ratio"] > 1


RING = "--graph ring:5 --mu 1 --l-f 2 --l-t 1 --l-s 1 --horizon 4"
BAD = {
    "-k 2 -r 1": ("--graph, --mu, --l-f, --l-t, --l-s, --horizon", "--problem FILE"),
    "--mu 1 --l-f 2 --l-t 1 --l-s 1 --horizon 4 -k 2 -r 1": ("--graph needed", "--problem"),
    "--graph ring:5 --horizon 4 -k 2 -r 1": ("--mu, --l-f, --l-t, --l-s needed",),
    "--graph ring:5 --mu 1 --l-f 2 --l-t 1 --l-s 1 -k 2 -r 1": ("--horizon needed",),
    f"{RING} -r 1": ("-k", "needed"),
    f"{RING} -k 2": ("-r", "needed"),
    f"{RING} -k 2.5 -r 1": ("-k", "2.5", "integer"),
    f"{RING} -k 0 -r 1": ("-k", "k = 0", ">= 1"),
    f"{RING} -k 2 -r -1": ("-r", "r = -1", ">= 0"),
    f"{RING} -k 2 -r 1 --horizon 0": ("--horizon", "0", ">= 1"),
    f"{RING} -k 2 -r 1 --horizon -7": ("--horizon", "-7", ">= 1"),
    f"{RING} -k 2 -r 1 --horizon 99999999999999": ("too large", "memory"),
    f"{RING} -k 2 -r 1 --dimension 0": ("--dimension", "0", ">= 1"),
    f"{RING} -k 2 -r 1 --seed -1": ("--seed", "-1", ">= 0"),
    f"{RING} -k 2 -r 1 --workers -1": ("--workers", "-1", ">= 0"),
    f"{RING} -k 2 -r 1 --tolerance 1": ("--tolerance", "1.0", "1e-14 to 1e-2"),
    f"{RING} -k 2 -r 1 --tolerance nan": ("--tolerance", "nan", "1e-14 to 1e-2"),
    f"{RING} -k 2 -r 1 --box 3,1": ("--box", "3,1", "the first at most the second"),
    f"{RING} -k 2 -r 1 --box nan,1": ("--box", "nan,1", "two numbers"),
    f"{RING} -k 2 -r 1 --box inf,inf": ("--box", "inf,inf", "two numbers"),
    f"{RING} -k 2 -r 1 --box a": ("--box", "'a'", "two numbers, such as -1,1"),
    f"{RING} -k 2 -r 1 --box 1,2,3": ("--box", "1,2,3", "two numbers"),
    f"{RING} -k 2 -r 1 --mu nan": ("--mu", "nan", "finite number > 0"),
    f"{RING} -k 2 -r 1 --mu 0": ("--mu", "0", "> 0"),
    f"{RING} -k 2 -r 1 --mu 3": ("--l-f", "l_f = 2 < mu = 3", "l_f >= mu"),
    f"{RING} -k 2 -r 1 --l-f inf": ("--l-f", "inf", "finite"),
    f"{RING} -k 2 -r 1 --l-t -1": ("--l-t", "-1", ">= 0"),
    f"{RING} -k 2 -r 1 --l-s nan": ("--l-s", "nan", ">= 0"),
    f"{RING} -k 2 -r 1 --style x": ("--style", "'x'", "attraction", "tilted"),
    f"{RING} -k 2 -r 1 --targets x": ("--targets", "'x'", "normal", "far:K,R"),
    f"{RING} -k 2 -r 1 --targets far:9,9": ("--targets", "beyond"),
    f"{RING} -k 2 -r 1 --method x": ("--method", "'x'", "auto", "casadi"),
    f"{RING} -k 2 -r 1 --method policy --box 0,1": ("--method", "policy", "constraints"),
    f"{RING} -k 2 -r 1 --method splitting --style logcosh": ("--method", "splitting", "quadratic"),
    f"{RING} -k 2 -r 1 --method osqp --style logcosh": ("method = osqp", "quadratic"),
    f"{RING} -k 2 -r 1 --graph none.graphml": ("none.graphml", "no such file"),
    f"{RING} -k 2 -r 1 --graph ring:2": ("--graph", "ring:2", "N >= 3"),
    "--problem good.npz -k 2 -r 1 --mu 1": ("--problem good.npz", "--mu", "leave it out"),
    "--problem good.npz -k 2 -r 1 --seed 1 --varying --dimension 2 --l-t 1": (
        *("--seed", "--varying", "--dimension", "--l-t", "leave it out"),
    ),
    "--problem none.npz -k 2 -r 1": ("--problem none.npz", "no such file", "save_problem"),
    "--problem text.npz -k 2 -r 1": ("--problem text.npz", "not a problem file"),
    "--problem g.json -k 2 -r 1": ("--problem g.json: not a problem file", "--save", "to --graph"),
    "--problem empty.npz -k 2 -r 1": ("--problem empty.npz", "not a problem file"),
    "--problem torn.npz -k 2 -r 1": ("--problem torn.npz", "not a problem file"),
    "--problem other.npz -k 2 -r 1": ("--problem other.npz", "not a problem file"),
    "--problem . -k 2 -r 1": ("--problem", "'.'", "directory"),
    f"{RING} -k 2 -r 1 --save none/p.npz": ("--save none/p.npz", "cannot be written"),
    f"{RING} -k 2 -r 1 --save .": ("--save", "'.'", "directory"),
    f"{RING} -k 2 -r 1 --actions none/a.npz": ("--actions none/a.npz", "is needed"),
    f"{RING} -k 2 -r 1 --actions text.npz/a.npz": ("--actions text.npz/a.npz", "is needed"),
    f"{RING} -k 2 -r 1 --actions .": ("--actions", "'.'", "directory"),
    f"{RING} -k 2 -r 1 --checkpoint none/c": ("checkpoint none/c", "No such file"),
    f"{RING} -k 2 -r 1 --checkpoint .": ("--checkpoint", "'.'", "directory"),
    f"{RING} -k 2 -r 1 --checkpoint text.npz": ("checkpoint text.npz", "a file not there yet"),
    f"{RING} -k 2 -r 1 --checkpoint steps": ("checkpoint steps", "problem", "another file"),
    f"{TYPED} -k 2 -r 1 --checkpoint steps": ("checkpoint steps", "(other k, r)", "delete it"),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("inputs")
    problem = ns.random_problem(**GIVEN)
    ns.save_problem(problem, path / "good.npz")
    ns.simulate(problem, k=3, r=2, checkpoint=path / "steps")
    (path / "text.npz").write_text("not one\n", encoding="utf-8")
    (path / "g.json").write_text('{"nodes": [{"id": 0}], "edges": []}', encoding="utf-8")
    (path / "empty.npz").write_bytes(b"")
    (path / "torn.npz").write_bytes((path / "good.npz").read_bytes()[:-300])
    np.savez(path / "other.npz", x=np.zeros(3))
    return path


@pytest.mark.parametrize("command", BAD)
def test_bad_input_is_one_line(command, folder, monkeypatch, capsys):
    before = {path.name: path.read_bytes() for path in folder.iterdir()}
    monkeypatch.chdir(folder)
    monkeypatch.setattr("sys.argv", ["nearsight", "simulate", *shlex.split(command)])
    monkeypatch.setattr("signal.signal", lambda *_: None)
    with pytest.raises(SystemExit) as end:
        main()
    out, err = capsys.readouterr()
    assert (end.value.code, out) == (2, "")
    (line,) = err.splitlines()
    for part in BAD[command]:
        assert part in line
    after = {path.name: path.read_bytes() for path in folder.iterdir()}
    assert after == before


@pytest.mark.parametrize(("method", "extra"), [("osqp", "qp"), ("casadi", "nlp")])
def test_a_library_that_is_not_there(method, extra, tmp_path):
    words = f"{RING} -k 2 -r 1 --method {method} --json"
    done = started(words, tmp_path, f"import sys; sys.modules[{method!r}] = None")
    assert (done.returncode, done.stdout) == (2, "")
    (line,) = done.stderr.splitlines()
    assert f"method = {method}: not installed; pip install {method} (the extra {extra})" in line


def test_a_solver_that_fails_is_one_line_too(monkeypatch):
    def fail(*_, **__):
        raise ns.NearsightError("step 1, agent 0: not solved; try another method")

    monkeypatch.setattr("nearsight.simulating.simulate", fail)
    done = run(*WORDS, *SIGHT)
    assert (done.exit_code, done.stdout) == (2, "")
    assert "not solved; try another method" in done.stderr


def test_python_refuses_what_would_have_no_effect():
    problem = ns.random_problem(**GIVEN)
    with pytest.raises(ns.InputError, match="a problem is given: seed would have no effect"):
        ns.simulate(problem, k=3, r=2, seed=1)


def test_functions_cannot_be_saved(tmp_path):
    network = ns.parse_graph("path:2")
    functions = (
        lambda t, i, w: (w**2).sum(axis=1) / 2,
        lambda t, i, w: w,
        lambda t, i, w: np.broadcast_to(np.eye(1), (len(w), 1, 1)),
    )
    problem = ns.Problem(network, 3, Callables(1, *functions, lower=1, upper=1))
    with pytest.raises(ns.InputError, match="not saved"):
        ns.save_problem(problem, tmp_path / "p.npz")
    assert list(tmp_path.iterdir()) == []
