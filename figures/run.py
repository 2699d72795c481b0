"""Draw pictures: in parallel, each written as soon as it is done."""

from __future__ import annotations

import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from importlib.metadata import version
from pathlib import Path
from typing import Any, cast

from ..graphs import InputError
from ..perturbation import Runner
from .catalogue import picture_named
from .files import FORMATS, kept, save, write
from .flaws import flaws
from .picture import Picture
from .size import SIZES
from .table import Table

Progress = Callable[[int, int, str], None]


@dataclass(frozen=True)
class Drawn:
    """One picture, drawn.

    Parameters
    ----------
    name : str
    files : tuple of Path
        The data first, then the picture in each format.
    reused : bool
        Whether the data were there already.
    flaws : tuple of str
        See `nearsight.figures.flaws`; none for what is drawn by default.
    seconds : float
        Wall-clock time.
    """

    name: str
    files: tuple[Path, ...]
    reused: bool
    flaws: tuple[str, ...]
    seconds: float


def draw_all(
    chosen: Sequence[Picture],
    folder: Path,
    typed: Mapping[str, Any],
    *,
    size: str = "paper",
    formats: Sequence[str] = FORMATS,
    reuse: bool = False,
    runner: Runner | None = None,
    progress: Progress | None = None,
) -> tuple[Drawn, ...]:
    """Draw pictures into a folder.

    Parameters
    ----------
    chosen : sequence of Picture
    folder : Path
        Made if it is not there.
    typed : mapping
        Values that replace fields of each picture's own `Subject`, where it takes them.
    size : str
        ``"paper"`` or ``"slides"``, see `SIZES`.
    formats : sequence of str
        Among `FORMATS`.
    reuse : bool
        Take the data that lie in the folder, if they are of the same subject and version.
    runner : Runner, optional
        Processes.
    progress : callable, optional
        Called as ``progress(done, total, text)`` now and then.

    Raises
    ------
    InputError
        If there is no such size or format, the folder cannot be made, or a picture cannot be
        drawn of this subject.
    """
    if size not in SIZES:
        raise InputError(f"size = {size!r}: one of {', '.join(SIZES)}", "size")
    for kind in formats:
        if kind not in FORMATS:
            raise InputError(f"formats = {kind!r}: one of {', '.join(FORMATS)}", "formats")
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"out = {folder}: no folder: {error.strerror}", "out") from error
    runner = runner or Runner()
    here = runner.workers == 1 or len(chosen) < 2  # not in other processes
    told = progress or (lambda done, total, text: None)
    found: dict[int, Drawn] = {}

    def tell(text: str) -> None:
        told(len(found), len(chosen), text)

    units: dict[int, Any] = {
        i: partial(_draw, p.name, folder, dict(typed), size, formats, reuse, tell if here else None)
        for i, p in enumerate(chosen)
    }
    tell("")
    for i, drawn in runner.run(units):
        found[i] = cast(Drawn, drawn)
        tell(chosen[i].name)
    return tuple(found[i] for i in range(len(chosen)))


def _draw(
    name: str,
    folder: Path,
    typed: dict[str, Any],
    size: str,
    formats: Sequence[str],
    reuse: bool,
    progress: Callable[[str], None] | None,
) -> Drawn:
    """Draw one picture, found by its name: its functions need not be sent to a process."""
    from matplotlib import style

    start = time.perf_counter()
    picture = picture_named(name)
    subject = picture.subject.with_typed(typed, picture.takes)
    head = {"figure": name, "nearsight": version("nearsight"), **subject.written(picture.takes)}
    path = folder / f"{name}.csv"
    table = kept(path, head) if reuse else None
    reused = table is not None
    if table is None:
        tell = progress or (lambda text: None)
        text = picture.compute(subject, lambda text: tell(f"{name}: {text}")).to_csv(head)
        write(path, text.encode())
        table, _ = Table.from_csv(text)  # drawn is what was written
    settings: Any = SIZES[size].settings
    with style.context(["default", settings]):  # whatever the user's own settings are
        figure = picture.draw(table, subject, SIZES[size])
        found = flaws(figure)
        figure.set_layout_engine("none")  # it has settled: files no longer depend on their order
        files = save(figure, folder, name, formats)
    return Drawn(name, (path, *files), reused, found, time.perf_counter() - start)
