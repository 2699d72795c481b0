"""Play a page: write its files, run its commands and its Python, compare what they print.

A block is played if it is ``console`` or ``python``. A caption makes it a file; one that lies in a
folder of the project (``bounds/theorems/x.py``) is found there as a new file would be. A line
before a block says what is special about it:

    % not run: WHY         it is shown only
    % exit status 1        of its last command; whatever it says on stderr is shown too
    % slow                 it takes seconds: played only with the slow tests
"""

from __future__ import annotations

import contextlib
import difflib
import importlib
import io
import os
import re
import shlex
import signal
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FENCE = re.compile(
    r"^(?P<mark>```+|:::+)(?:\{code-block\} *)?(?P<language>[a-z]+)\n(?P<body>.*?)^(?P=mark) *$",
    flags=re.M | re.S,
)
CAPTION = re.compile(r"\A:caption: (\S+)\n+")
NOTE = re.compile(r"(?:% |<!-- )(not run|exit status|slow)(?::? *(.*?))?(?: -->)?\s*\Z")
WIDTH = "100"


@dataclass(frozen=True)
class Block:
    """A fenced block of a page."""

    language: str
    body: str
    line: int
    caption: str = ""
    reason: str = ""
    status: int = 0
    slow: bool = False


def blocks(text):
    """Return the fenced blocks of a page in order, directives other than code left out."""
    found = []
    for match in FENCE.finditer(text):
        body, caption = match["body"], ""
        if named := CAPTION.match(body):
            caption, body = named[1], body[named.end() :]
        before = text[: match.start()].rstrip("\n").rsplit("\n", 1)[-1]
        note = NOTE.match(before)
        kind, value = (note[1], note[2] or "") if note else ("", "")
        found.append(
            Block(
                match["language"],
                body,
                text.count("\n", 0, match.start()) + 1,
                caption,
                value if kind == "not run" else "",
                int(value) if kind == "exit status" else 0,
                kind == "slow",
            )
        )
    return found


def play(path, folder, *, slow=False):
    """Play all blocks of a page in a folder; return what is not as shown, as texts."""
    found, names = [], {"__name__": "__page__"}
    for block in blocks(Path(path).read_text(encoding="utf-8")):
        if not block.reason and (slow or not block.slow):
            found += play_block(block, folder, names)
    return found


def play_block(block, folder, names):
    """Play one block; `names` are the variables that Python finds and leaves."""
    with _settled(folder):
        if block.caption:
            _write(block, folder)
            return []
        players = {
            "console": lambda: _console(block, folder),
            "python": lambda: _python(block, names),
        }
        return [f"line {block.line}: {text}" for text in players[block.language]()]


@contextlib.contextmanager
def _settled(folder):
    """Work in a folder where the examples of the checkout are, with a fixed width of lines."""
    examples, before, width = folder / "examples", Path.cwd(), os.environ.get("COLUMNS")
    if not examples.exists():
        examples.symlink_to(ROOT / "examples")
    os.chdir(folder)
    os.environ["COLUMNS"] = WIDTH
    try:
        yield
    finally:
        os.chdir(before)
        if width is None:
            del os.environ["COLUMNS"]
        else:
            os.environ["COLUMNS"] = width


def _write(block, folder):
    path = folder / block.caption
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(block.body, encoding="utf-8")
    top = block.caption.split("/")[0]
    if path.suffix != ".py" or not (ROOT / top / "__init__.py").exists():
        return
    package = importlib.import_module("nearsight." + ".".join(block.caption.split("/")[:-1]))
    if str(path.parent) not in package.__path__:
        package.__path__.append(str(path.parent))
    importlib.invalidate_caches()
    for module in [m for name, m in sys.modules.items() if name.startswith("nearsight")]:
        for value in list(vars(module).values()):
            if hasattr(value, "cache_clear"):  # what was in the folders before
                value.cache_clear()


def _console(block, folder):
    parts = re.split(r"^\$ ", block.body.replace("\\\n", " "), flags=re.M)
    if parts[0]:
        return [f"output before a command: {parts[0]!r}"]
    found = []
    for i, part in enumerate(parts[1:], 2):
        command, _, shown = part.partition("\n")
        expected = block.status if i == len(parts) else 0
        status, printed, complaints = run(command, folder)
        if expected:
            printed += complaints
        elif complaints:
            found.append(f"{command}: on stderr: {complaints}")
        if status != expected:
            found.append(f"{command}: exit status {status}, not {expected}: {complaints}")
        if printed.strip("\n") != shown.strip("\n"):
            found.append(f"{command}:\n{_difference(shown, printed)}")
    return found


def run(command, folder):
    """Run commands joined by `&&`; return exit status, stdout and stderr."""
    out = err = ""
    for part in command.split(" && "):
        status, printed, complaints = _one(part, folder)
        out, err = out + printed, err + complaints
        if status:
            break
    return status, out, err


def _one(command, folder):
    words = shlex.split(command)
    if words[0] == "nearsight" and "|" not in words:
        words, name = (words[:-2], words[-1]) if ">" in words else (words, "")
        status, printed, complaints = _inside(words)
        if name:
            (folder / name).write_text(printed, encoding="utf-8")
        return status, "" if name else printed, complaints
    done = subprocess.run(
        ["bash", "-c", command],
        cwd=folder,
        capture_output=True,
        text=True,
        check=False,
        encoding="utf-8",
        env={**os.environ, "PATH": f"{Path(sys.executable).parent}:{os.environ['PATH']}"},
    )
    return done.returncode, done.stdout, done.stderr


def _inside(words):
    """Run `nearsight` in this process: importing its libraries anew takes longer than most runs."""
    from nearsight.cli import main

    out, err, argv = io.StringIO(), io.StringIO(), sys.argv
    pipe = signal.getsignal(signal.SIGPIPE)
    sys.argv = words
    try:
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            main()
    except SystemExit as done:
        return int(done.code or 0), out.getvalue(), err.getvalue()
    finally:
        sys.argv = argv
        signal.signal(signal.SIGPIPE, pipe)
    return 0, out.getvalue(), err.getvalue()


def _python(block, names):
    """Run Python; what it prints stands behind or below each `print`, as comments."""
    out = io.StringIO()
    with contextlib.redirect_stdout(out):
        exec(compile(block.body, f"line {block.line}", "exec"), names)  # noqa: S102 - our own pages
    expected = "\n".join(_shown(block.body))
    if out.getvalue().strip("\n") == expected:
        return []
    return [_difference(expected, out.getvalue())]


def _shown(body):
    """Return the comments that stand behind a `print`, or directly below it."""
    found, printed = [], False
    for line in body.splitlines():
        behind = re.fullmatch(r" *print\(.*\)  # (.*)", line)
        if behind:
            found.append(behind[1])
        elif printed and line.startswith("# "):
            found.append(line[2:])
        printed = bool(line) and (printed or line.lstrip().startswith("print("))
    return found


def _difference(shown, printed):
    pair = [text.strip("\n").splitlines() for text in (shown, printed)]
    return "\n".join(difflib.unified_diff(*pair, "shown", "printed", lineterm=""))


if __name__ == "__main__":  # a page in a process of its own: python play.py PAGE FOLDER
    complaints = play(sys.argv[1], Path(sys.argv[2]), slow="--slow" in sys.argv)
    print("\n".join(complaints))
    sys.exit(bool(complaints))
