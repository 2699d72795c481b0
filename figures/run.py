"""Draw pictures: in parallel, each written as soon as it is done."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, cast

from ..graphs import InputError
from ..perturbation import Runner
from .files import FORMATS
from .one import Drawn, draw_one
from .picture import Picture
from .size import SIZES

Progress = Callable[[int, int, str], None]


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
        If there is no such size or format, the folder cannot be made, or no picture can be drawn
        of this subject. Of several, those that can are drawn: see `Drawn.failed`.
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
        i: partial(
            draw_one, p.name, folder, {**typed}, size, formats, reuse, tell if here else None
        )
        for i, p in enumerate(chosen)
    }
    tell("")
    for i, one in runner.run(units):
        found[i] = cast(Drawn, one)
        tell(chosen[i].name)
    drawn = tuple(found[i] for i in range(len(chosen)))
    if drawn and all(one.failed for one in drawn):
        raise InputError(drawn[0].failed, drawn[0].argument)
    return drawn
