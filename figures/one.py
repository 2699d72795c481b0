"""One picture: its data computed or taken as they are, drawn, looked at, and written."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from importlib.metadata import version
from pathlib import Path
from typing import Any

from ..graphs import InputError
from .catalogue import picture_named
from .files import kept, save, write
from .flaws import flaws
from .picture import Picture
from .size import SIZES, Size
from .subject import Subject
from .table import Table

Tell = Callable[[str], None]


@dataclass(frozen=True)
class Drawn:
    """One picture, drawn.

    Parameters
    ----------
    name : str
    files : tuple of Path
        The data first, then the picture in each format; none where it was not drawn.
    reused : bool
        Whether the data were there already.
    flaws : tuple of str
        See `nearsight.figures.flaws`; none for what is drawn by default.
    seconds : float
        Wall-clock time.
    failed : str
        Why it was not drawn, or empty.
    argument : str or None
        Name of the argument at fault, where there is one.
    """

    name: str
    files: tuple[Path, ...]
    reused: bool
    flaws: tuple[str, ...]
    seconds: float
    failed: str = ""
    argument: str | None = None


def draw_one(
    name: str,
    folder: Path,
    typed: dict[str, Any],
    size: str,
    formats: Sequence[str],
    reuse: bool,
    progress: Tell | None,
) -> Drawn:
    """Draw one picture, found by its name: its functions need not be sent to a process.

    Parameters
    ----------
    name, folder, typed, size, formats, reuse
        See `nearsight.figures.draw_all`.
    progress : callable or None
        Called with a short text now and then.
    """
    start = time.perf_counter()
    picture = picture_named(name)
    try:
        subject = picture.subject.with_typed(typed, picture.takes)
        table, reused = _data(picture, subject, folder / f"{name}.csv", reuse, progress)
        how = subject, SIZES[size], folder, formats
        try:
            found, files = _drawn(picture, table, *how)
        except (LookupError, TypeError, ValueError):
            if not reused:
                raise
            # what is not what this picture computes was damaged, or is somebody else's
            table, reused = _data(picture, subject, folder / f"{name}.csv", False, progress)
            found, files = _drawn(picture, table, *how)
    except OSError as error:
        text = f"out = {folder}: the files of {name} cannot be used: {error.strerror}"
        return Drawn(name, (), False, (), time.perf_counter() - start, text, "out")
    except InputError as error:
        return Drawn(name, (), False, (), time.perf_counter() - start, str(error), error.argument)
    return Drawn(name, (folder / f"{name}.csv", *files), reused, found, time.perf_counter() - start)


def _data(
    picture: Picture, subject: Subject, path: Path, reuse: bool, progress: Tell | None
) -> tuple[Table, bool]:
    """Return the data, and whether they were there already."""
    head = {"figure": picture.name, "nearsight": version("nearsight")}
    head |= subject.written(picture.takes) | picture.also()
    table = kept(path, head) if reuse else None
    if table is not None:
        return table, True
    tell = progress or (lambda text: None)
    text = picture.compute(subject, lambda what: tell(f"{picture.name}: {what}")).to_csv(head)
    write(path, text.encode())
    return Table.from_csv(text)[0], False  # drawn is what was written


def _drawn(
    picture: Picture,
    table: Table,
    subject: Subject,
    size: Size,
    folder: Path,
    formats: Sequence[str],
) -> tuple[tuple[str, ...], tuple[Path, ...]]:
    """Return the flaws and the files."""
    from matplotlib import style

    settings: Any = size.settings
    with style.context(["default", settings]):  # whatever the user's own settings are
        figure = picture.draw(table, subject, size)
        found = flaws(figure)
        figure.set_layout_engine("none")  # it has settled: files no longer depend on their order
        return found, save(figure, folder, picture.name, formats)
