"""The pages of docs/: what they show is what is printed, and they leave nothing out."""

import ast
import importlib.util
import re
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
DOCS = ROOT / "docs"
PAGES = sorted(DOCS.rglob("*.md"))
TEXTS = {path.relative_to(DOCS).as_posix(): path.read_text(encoding="utf-8") for path in PAGES}


def load(name):
    """Import a module of tests/docs, which is no package."""
    spec = importlib.util.spec_from_file_location(f"docs_{name}", ROOT / f"tests/docs/{name}.py")
    module = importlib.util.module_from_spec(spec)
    sys.modules[spec.name] = module
    spec.loader.exec_module(module)
    return module


PLAY = load("play")
BLOCKS = {name: PLAY.blocks(text) for name, text in TEXTS.items()}
PLAYED = [name for name, found in BLOCKS.items() if any(not block.reason for block in found)]
SLOW = [name for name, found in BLOCKS.items() if any(block.slow for block in found)]


def played(name, folder, *, slow=False):
    """Play a page; one that adds files to the project does so in a process of its own."""
    if not any(block.caption.endswith(".py") for block in BLOCKS[name]):
        return "\n".join(PLAY.play(DOCS / name, folder, slow=slow))
    done = subprocess.run(
        [sys.executable, ROOT / "tests/docs/play.py", DOCS / name, folder],
        capture_output=True,
        text=True,
        check=False,
        encoding="utf-8",
    )
    return done.stdout.strip() + done.stderr


@pytest.mark.parametrize("name", PLAYED)
def test_a_page_shows_what_is_printed(name, tmp_path):
    assert played(name, tmp_path) == ""


@pytest.mark.slow
@pytest.mark.parametrize("name", SLOW)
def test_a_page_with_its_slow_blocks_shows_what_is_printed(name, tmp_path):
    assert played(name, tmp_path, slow=True) == ""


def test_every_block_is_played_or_says_why_not():
    for name, found in BLOCKS.items():
        for block in found:
            known = block.caption or block.language in ("console", "python")
            assert known or block.reason, f"{name}, line {block.line}: {block.language}"
    reasons = [block.reason for found in BLOCKS.values() for block in found if block.reason]
    assert len(reasons) <= 2  # very rare


def test_no_line_of_a_formula_begins_a_list():
    for name, text in TEXTS.items():
        prose = re.sub(r"^(```+).*?^\1$|\$\$.*?\$\$", "", text, flags=re.M | re.S)
        for formula in re.findall(r"\$[^$]+\$", prose):
            assert not re.search(r"\n\s*[-+*] ", formula), f"{name}: {formula}"


def test_a_page_that_shows_something_else_is_found_out(tmp_path):
    page = tmp_path / "page.md"
    page.write_text("```python\nprint(1 + 1)  # 3\n```\n\n```console\n$ echo 2\n3\n```\n")
    complaints = PLAY.play(page, tmp_path)
    assert [x.split(":")[0] for x in complaints] == ["line 1", "line 5"]
    page.write_text("% exit status 2\n```console\n$ nearsight plan\n```\n")
    assert PLAY.play(page, tmp_path)  # what it says on stderr is not shown
    page.write_text("```console\n$ nearsight plan > file\n```\n")
    assert PLAY.play(page, tmp_path)  # the exit status is not said


def test_errata_name_exactly_the_refuted_claims():
    from nearsight.verify.recorded import recorded

    named = re.findall(r"\{refuted\}`([^`]+)`", TEXTS["theory/errata.md"])
    refuted = {key for key, verdict in recorded().items() if verdict == "refuted"}
    assert sorted(named) == sorted(refuted)


def test_claims_have_the_verdicts_that_pages_tell():
    from nearsight.verify.recorded import recorded

    for name, text in TEXTS.items():
        for verdict, key in re.findall(r"\{(proved|refuted|claim)\}`([^`]+)`", text):
            assert key in recorded(), f"{name}: {key}"
            assert verdict in ("claim", recorded()[key]), f"{name}: {key}"


def test_the_gallery_has_every_picture_and_no_other():
    from nearsight.figures import pictures

    there = {path.name for path in (DOCS / "figures").iterdir()}
    assert there >= {f"{p.name}{suffix}" for p in pictures() for suffix in (".svg", ".csv")}
    assert {name.split(".")[0] for name in there} == {p.name for p in pictures()}


@pytest.mark.slow
def test_the_gallery_is_what_the_command_draws(tmp_path):
    from nearsight.drawing import draw

    draw(out=tmp_path, workers=2)
    for path in sorted((DOCS / "figures").iterdir()):
        assert path.read_bytes() == (tmp_path / path.name).read_bytes(), path.name


def test_the_reference_has_every_package_and_every_public_name():
    import nearsight

    packages = {path.parent.name for path in ROOT.glob("*/__init__.py")} - {"nearsight"}
    for package in packages:
        assert f".. automodule:: nearsight.{package}\n" in TEXTS[f"reference/{package}.md"]
    source = ast.parse((DOCS / "ext/frontdoor.py").read_text(encoding="utf-8"))
    (listed,) = [
        ast.literal_eval(node.value)
        for node in source.body
        if isinstance(node, ast.Assign) and node.targets[0].id == "PACKAGES"
    ]
    assert set(listed) == packages
    for package in packages:  # what `automodule` describes, and `frontdoor` links to
        handed_on = {n for n, m in nearsight._EXPORTS.items() if m == f".{package}"} - {package}
        assert handed_on <= set(getattr(nearsight, package).__all__)


def test_files_and_labels_that_pages_name_are_there():
    from nearsight.bounds import catalogue
    from nearsight.verify.recorded import recorded

    labels = {bound.label for bound in catalogue()} | set(recorded())
    for name, text in TEXTS.items():
        made = {block.caption for block in BLOCKS[name]}
        folders = "|".join(path.parent.name for path in ROOT.glob("*/__init__.py"))
        for path in re.findall(rf"`((?:{folders}|examples)/[\w./]*)`", text):
            assert (ROOT / path).exists() or path in made, f"{name}: {path}"
        if name != "extend.md":
            for label in re.findall(r"(?<!\})`(nearsight:[\w-]+)`", text):
                assert label in labels, f"{name}: {label}"


def test_every_source_is_used():
    text = TEXTS["bibliography.md"]
    others = "\n".join(t for name, t in TEXTS.items() if name != "bibliography.md")
    for entry in re.split(r"^(?=\(\w+\)=)", text, flags=re.M)[1:]:
        key = re.match(r"\((\w+)\)=", entry)[1]
        author = re.search(r"\*\*([\w'\u2019-]+)", entry)[1]
        paths = [ROOT / path for path in re.findall(r"`([\w./]+/[\w.]*)`", entry)]
        files = [f for p in paths for f in (p.rglob("*.py") if p.is_dir() else [p])]
        in_code = any(author in f.read_text(encoding="utf-8") for f in files)
        assert in_code or f"bibliography.md#{key}" in others, key
