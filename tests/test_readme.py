"""Every command and every block of Python in the README, as printed there."""

import re
import shlex
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")
CONSOLE = re.findall(r"```console\n\$ (.*?)\n(.*?)```", README, flags=re.S)
PYTHON = re.findall(r"```python\n(.*?)```", README, flags=re.S)


def run(words):
    return subprocess.run(
        [sys.executable, "-c", "from nearsight.cli import main; main()", *words],
        cwd=ROOT,
        capture_output=True,
        text=True,
        check=False,
        encoding="utf-8",
        env={"PYTHONUTF8": "1", "PATH": "", "COLUMNS": "100"},
    )


@pytest.mark.parametrize(("command", "shown"), CONSOLE)
def test_the_output_shown_is_the_output_printed(command, shown):
    done = run(shlex.split(command)[1:])
    assert done.stdout == shown
    assert (done.returncode, done.stderr) == (0, "")


@pytest.mark.parametrize("block", PYTHON)
def test_the_python_blocks_print_what_their_comments_say(block, capsys, monkeypatch):
    monkeypatch.chdir(ROOT)
    exec(compile(block, "README.md", "exec"), {})  # noqa: S102 - the README's own code
    expected = re.findall(r"^print\(.*\)  # (.*)$", block, flags=re.M)
    assert capsys.readouterr().out.splitlines() == expected


def test_the_readme_opens_with_its_two_commands():
    commands = re.findall(r"^    (pip install -q uv && .*)$", README, flags=re.M)
    assert commands[1] == "pip install -q uv && uv run pytest"
    done = run(shlex.split(commands[0].split("uv run nearsight ")[1]))
    assert done.stdout == CONSOLE[0][1]
