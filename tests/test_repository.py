"""Facts about the repository itself: its files, its packages, its pins, its front door."""

import ast
import itertools
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]
CONFIG = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
FOLDERS = CONFIG["tool"]["setuptools"]["package-dir"]  # package -> folder
SOURCES = sorted(path for folder in set(FOLDERS.values()) for path in (ROOT / folder).glob("*.py"))

# Put together from pieces, so that this file passes its own test.
HOSTS = ["py" + "pi.org", "python" + "hosted.org", "ana" + "conda.org", "np" + "mjs.org"]
NOTES = re.compile(r"\b(" + "|".join(["TO" + "DO", "FIX" + "ME", "XX" + "X"]) + r")\b")


def git(*arguments):
    if shutil.which("git") is None or not (ROOT / ".git").exists():
        pytest.skip("not a git checkout")
    return subprocess.run(
        ["git", *arguments], cwd=ROOT, capture_output=True, text=True, check=False
    )


def tracked_files():
    # Files not added yet count too: they are about to be.
    listing = git("ls-files", "-z", "--cached", "--others", "--exclude-standard").stdout
    paths = (ROOT / name for name in listing.split("\0") if name)
    return [path for path in paths if path.is_file() and not path.is_symlink()]


@pytest.mark.parametrize("path", SOURCES, ids=lambda path: str(path.relative_to(ROOT)))
def test_source_is_short_and_finished(path):
    text = path.read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 250
    asserts = [node.lineno for node in ast.walk(ast.parse(text)) if isinstance(node, ast.Assert)]
    assert not asserts, "raise instead: `python -O` drops these"
    assert not NOTES.search(text)


def test_no_file_names_a_package_registry():
    named = []
    for path in tracked_files():
        text = path.read_bytes().decode("utf-8", errors="ignore")
        named += [(str(path.relative_to(ROOT)), host) for host in HOSTS if host in text]
    assert not named


def test_uv_lock_is_ignored():
    assert git("check-ignore", "--quiet", "uv.lock").returncode == 0


def test_pins_have_hashes_and_name_no_place():
    lines = (ROOT / "requirements.lock").read_text(encoding="utf-8").splitlines()
    pin = re.compile(r"[a-z0-9][a-z0-9.-]*==[\w.+]+( ; [^\\]+)? \\")
    digest = re.compile(r"    --hash=sha256:[0-9a-f]{64}( \\)?")
    origin = re.compile(r"    #.*")  # the package that asks for it
    strange = [x for x in lines if not any(p.fullmatch(x) for p in (pin, digest, origin))]
    assert not strange
    assert not [line for line in lines if "://" in line or "/" in line]
    bare = [x for x, y in itertools.pairwise(lines) if pin.match(x) and "--hash" not in y]
    assert not bare


def test_pins_cover_what_the_project_asks_for():
    project = CONFIG["project"]
    asked = [*project["dependencies"], *CONFIG["dependency-groups"]["dev"]]
    asked += [name for extra in project["optional-dependencies"].values() for name in extra]
    names = {re.match(r"[\w.-]+", requirement).group().lower() for requirement in asked}
    text = (ROOT / "requirements.lock").read_text(encoding="utf-8")
    assert names <= set(re.findall(r"^([\w.-]+)==", text, flags=re.MULTILINE))


def test_every_folder_is_a_package_of_the_wheel():
    assert list(FOLDERS) == CONFIG["tool"]["setuptools"]["packages"]
    top = {folder.split("/")[0] for folder in FOLDERS.values()}
    top |= {path.parent.name for path in ROOT.glob("*/__init__.py")}
    found = {path.parent for folder in top for path in (ROOT / folder).rglob("*.py")}
    assert {path.relative_to(ROOT).as_posix() for path in found} == set(FOLDERS.values())
    for package, folder in FOLDERS.items():
        assert package.split(".")[1:] == [x for x in folder.split("/") if x != "nearsight"]
        assert (ROOT / folder / "__init__.py").is_file()
        assert (ROOT / folder / "py.typed").is_file()


def test_typings_shows_every_folder_under_its_installed_name():
    expected = {path.name: path for path in (ROOT / "nearsight").iterdir()}
    expected |= {folder: ROOT / folder for folder in FOLDERS.values() if "/" not in folder}
    del expected["nearsight"]
    expected.pop("__pycache__", None)
    links = {path.name: path for path in (ROOT / "typings" / "nearsight").iterdir()}
    links.pop("__pycache__", None)
    assert links.keys() == expected.keys()
    for name, link in links.items():
        assert link.resolve() == expected[name].resolve()
        assert not Path(os.readlink(link)).is_absolute()


def test_importing_the_front_door_loads_nothing_heavy():
    heavy = {"numpy", "scipy", "sympy", "networkx", "mpmath", "matplotlib", "rich", "click"}
    code = "import sys, nearsight; print(*sys.modules)"
    run = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    loaded = set(run.stdout.split())
    assert "nearsight" in loaded
    assert not loaded & heavy


def test_front_door_opens_every_name_and_type_checkers_see_the_same():
    import nearsight

    for name in nearsight._EXPORTS:
        assert getattr(nearsight, name) is not None
    assert {*nearsight._EXPORTS, "__version__"} <= set(dir(nearsight))
    with pytest.raises(AttributeError, match="no_such_name"):
        nearsight.no_such_name  # noqa: B018 - looking it up is the test
    tree = ast.parse((ROOT / "nearsight" / "__init__.py").read_text(encoding="utf-8"))
    shown = {}
    for node in ast.walk(tree):
        if isinstance(node, ast.ImportFrom) and node.level == 1:
            for alias in node.names:
                shown[alias.asname] = f".{node.module or alias.name}"
    assert shown == nearsight._EXPORTS


def test_version_is_the_same_everywhere():
    import nearsight

    version = CONFIG["project"]["version"]
    assert nearsight.__version__ == version
    citation = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    assert re.search(r"^version: (.*)$", citation, flags=re.MULTILINE).group(1) == version
