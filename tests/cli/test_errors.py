"""Bad input: status 2, one clear line on stderr, nothing on stdout, never a traceback."""

import subprocess
import sys

import pytest

COSTS = "--mu 1 --l-f 1 --l-t 1 --l-s 1"
PLAN = f"plan --growth line {COSTS} --target 1.1"
CASES = {
    "plan --growth line --mu -1 --l-f 1 --l-t 1 --l-s 1 --target 1.1": ("--mu", "-1", "> 0"),
    "plan --growth line --mu nan --l-f 1 --l-t 1 --l-s 1 --target 1.1": ("--mu", "nan", "finite"),
    "plan --growth line --mu 1 --l-f inf --l-t 1 --l-s 1 --target 1.1": ("--l-f", "inf", "finite"),
    "plan --growth line --mu 1 --l-f 1 --l-t -2 --l-s 1 --target 1.1": ("--l-t", "-2", ">= 0"),
    "plan --growth line --mu 1 --l-f 1 --l-t 1 --l-s -3 --target 1.1": ("--l-s", "-3", ">= 0"),
    "plan --growth line --mu 2 --l-f 1 --l-t 1 --l-s 1 --target 1.1": ("--l-f", "1", "l_f >= mu"),
    f"plan --growth line {COSTS} --target 1": ("--target", "1.0", "> 1"),
    f"plan --growth line {COSTS} --target nan": ("--target", "nan", "finite"),
    f"plan --growth line {COSTS} --target abc": ("--target", "abc", "float"),
    "plan --growth line --mu=1 --target 1.1": ("--l-f, --l-t, --l-s are needed", "plan --help", ""),
    f"plan --growth line {COSTS}": ("--target is needed", "", ""),
    f"plan {COSTS} --target 1.1": ("graph", "growth", "exactly one"),
    f"plan --graph ring:5 --growth line {COSTS} --target 1.1": ("graph", "growth", "exactly one"),
    f"plan --growth lin {COSTS} --target 1.1": ("--growth", "lin", "grid2"),
    f"plan --growth poly:2,1 {COSTS} --target 1.1": ("--growth", "poly:2,1", "--max-degree"),
    f"plan --graph ring:2 {COSTS} --target 1.1": ("--graph", "ring:2", "N >= 3"),
    f"plan --graph none.graphml {COSTS} --target 1.1": ("none.graphml", "no such file", ""),
    f"plan --graph broken.graphml {COSTS} --target 1.1": ("broken.graphml", "", ""),
    f"plan --graph directed.edgelist.gml {COSTS} --target 1.1": ("directed", "clean", ""),
    f"plan --graph loop.edgelist {COSTS} --target 1.1": ("loop.edgelist", "self-loop", ""),
    f"plan --graph empty.edgelist {COSTS} --target 1.1": ("empty.edgelist", "", ""),
    f"{PLAN} --price-k -1": ("--price-k", "-1", ">= 0"),
    f"{PLAN} --max-k 1": ("--max-k", "1", ">= 2"),
    f"{PLAN} --max-r 0": ("--max-r", "0", ">= 1"),
    f"{PLAN} --bogus": ("--bogus", "", ""),
    f"bound --growth line {COSTS} -k 1 -r 1": ("-k", "1", ">= 2"),
    f"bound --growth line {COSTS} -k 2 -r 0": ("-r", "0", ">= 1"),
    f"bound --growth line {COSTS} -k 9223372036854775807 -r 1": ("-k", "9223372036854775807", "<="),
    f"bound --growth line {COSTS} -k 2.5 -r 1": ("-k", "2.5", "integer"),
    f"bound --growth line {COSTS} --b 1": ("--b", "1", "two numbers"),
    f"bound --growth line {COSTS} --b 1,0": ("--b", "0", "> 0"),
    f"bound --growth line {COSTS} --label thm:none": ("--label", "thm:none", "thm:bottleneck"),
    "plan --growth line": ("--mu", "--target", "needed"),
    "plann": ("plann", "bound, measure, plan, simulate", ""),
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    path = tmp_path_factory.mktemp("inputs")
    (path / "broken.graphml").write_text("<graphml>", encoding="utf-8")
    (path / "directed.edgelist.gml").write_text(
        'graph [ directed 1 node [ id 0 label "a" ] node [ id 1 label "b" ] '
        "edge [ source 0 target 1 ] ]",
        encoding="utf-8",
    )
    (path / "loop.edgelist").write_text("1 2\n2 2\n", encoding="utf-8")
    (path / "empty.edgelist").write_text("", encoding="utf-8")
    return path


@pytest.mark.parametrize("command", CASES)
def test_bad_input_is_one_line(command, folder):
    done = subprocess.run(
        [sys.executable, "-c", "from nearsight.cli import main; main()", *command.split()],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stdout == ""
    lines = done.stderr.splitlines()
    assert len(lines) == 1, done.stderr
    for part in CASES[command]:
        assert part in lines[0]
