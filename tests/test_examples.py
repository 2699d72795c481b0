"""The examples run as they stand, from an empty folder, and what they print is so."""

import re
import subprocess
import sys
from pathlib import Path

import pytest

FOLDER = Path(__file__).resolve().parents[1] / "examples"
NUMBER = r"-?\d+(?:\.\d+)?(?:e[-+]\d+)?"


def run(name, folder):
    done = subprocess.run(
        [sys.executable, "-W", "error", str(FOLDER / name)],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stderr) == (0, "")
    assert list(folder.iterdir()) == []
    return done.stdout


def numbers(text, start):
    """The numbers of the line that starts like this."""
    (line,) = [x for x in text.splitlines() if x.startswith(start)]
    return [float(x) for x in re.findall(NUMBER, line[len(start) :])]


def test_every_example_is_tested_short_and_described():
    names = {path.name for path in FOLDER.glob("*.py")}
    assert names == {"power_grid.py", "pricing.py", "random_graph.py"}
    readme = (FOLDER / "README.md").read_text(encoding="utf-8")
    for name in names:
        assert len((FOLDER / name).read_text(encoding="utf-8").splitlines()) < 80
        assert f"## `{name}`" in readme


def test_power_grid(tmp_path):
    text = run("power_grid.py", tmp_path)
    assert text.startswith("118 buses, 179 lines, 24 hours\n")
    mu, l_f, l_T, l_S = numbers(text, "mu = ")
    assert 0 < mu <= l_f
    assert (l_T, l_S) == (1, 0.1)
    target, k, r = numbers(text, "plan for a ratio of ")
    assert k >= 2
    assert r >= 1
    (promised,) = numbers(text, "promised ratio - 1: at most ")
    (measured,) = numbers(text, "measured ratio - 1: ")
    assert 0 <= measured <= promised <= target - 1
    (full,) = numbers(text, "set-points at their capacity: ")
    assert 0 < full < 100  # some capacities bind, not all


def test_pricing(tmp_path):
    text = run("pricing.py", tmp_path)
    _, _, revenue = numbers(text, "revenue of LPC with k = ")
    (best,) = numbers(text, "best revenue in hindsight: ")
    (safe, better) = numbers(text, "safe prices earn ")
    assert 0 < safe <= revenue <= best
    measured, promised = numbers(text, "cost above the optimum: ")
    assert 0 <= measured <= promised
    lost, plain = numbers(text, "share of revenue lost: ")
    assert 0 <= lost <= better <= plain < 1
    assert lost == pytest.approx(1 - revenue / best, rel=0.01)
    (capped,) = numbers(text, "prices at their cap: ")
    assert 0 < capped < 100


def test_random_graph(tmp_path):
    text = run("random_graph.py", tmp_path)
    rows = [numbers(text, f"k = {k}  ") for k in (1, 2, 3, 4)]
    assert [len(row) for row in rows] == [3, 3, 3, 3]
    assert rows[0][0] == rows[0][1] == rows[0][2]  # k = 1: nobody looks around
    assert all(value > 0 for row in rows for value in row)
    for row in rows[1:]:
        assert row == sorted(row, reverse=True)
    for column in zip(*rows, strict=True):
        assert list(column) == sorted(column, reverse=True)
    assert rows[3][2] < rows[0][0] / 1000
