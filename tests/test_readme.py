"""Every command and every block of Python in the README, as printed there."""

import importlib.util
import re
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
README = (ROOT / "README.md").read_text(encoding="utf-8")


def load(name):
    """Import a module of tests/docs, which is no package."""
    spec = importlib.util.spec_from_file_location(f"docs_{name}", ROOT / f"tests/docs/{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


PLAY = load("play")
BLOCKS = PLAY.blocks(README)


@pytest.mark.parametrize("block", BLOCKS, ids=lambda block: f"{block.language}-{block.line}")
def test_a_block_shows_what_is_printed(block, tmp_path):
    assert not block.reason  # all of the README is played
    assert PLAY.play_block(block, tmp_path, {"__name__": "__page__"}) == []


def test_the_readme_opens_with_its_two_commands(tmp_path):
    commands = re.findall(r"^    (pip install -q uv && .*)$", README, flags=re.M)
    assert commands[1] == "pip install -q uv && uv run pytest"
    first = commands[0].split("uv run ")[1]
    shown = next(block.body for block in BLOCKS if block.language == "console")
    block = PLAY.Block("console", f"$ {first}\n{shown.partition(chr(10))[2]}", 1)
    assert PLAY.play_block(block, tmp_path, {}) == []
