"""Imports run downwards only; the contract is in pyproject.toml."""

import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
LINT = "import sys; from importlinter.cli import lint_imports_command; lint_imports_command()"


def test_imports_run_downwards_only():
    # In typings/ the folders lie under their installed names, which is what the linter reads.
    run = subprocess.run(
        [sys.executable, "-c", LINT, "--config", "../pyproject.toml", "--no-cache", "--no-logo"],
        cwd=ROOT / "typings",
        capture_output=True,
        text=True,
        check=False,
    )
    assert run.returncode == 0, run.stdout + run.stderr
    assert "Analyzed 0 files" not in run.stdout
    assert "1 kept, 0 broken" in run.stdout
