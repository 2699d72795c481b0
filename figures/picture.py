"""A picture: what it shows, what it takes, how its data are computed, how they are drawn."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from typing import TYPE_CHECKING

from ..graphs import InputError
from .size import Size
from .subject import Subject
from .table import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

Progress = Callable[[str], None]
Compute = Callable[[Subject, Progress], Table]
Draw = Callable[[Table, Subject, Size], "Figure"]


@dataclass(frozen=True)
class Picture:
    """One picture.

    Parameters
    ----------
    name : str
        That of its file, with hyphens.
    title : str
        What it shows, in one line.
    caption : str
        How to read it, in one to three sentences; ready to stand below it in a paper.
    compute : callable
        From a subject and a callable for progress to the data.
    draw : callable
        From the data, the subject and a size to a figure. Everything that costs time, and every
        number shown, comes from the data.
    subject : Subject
        What it is of unless told otherwise.
    takes : tuple of str
        The fields of `Subject` that it uses.
    label : str
        Label of the figure in the paper that it is, or empty.
    also : callable
        Return what else its data are of, by name, as short texts.

    Raises
    ------
    InputError
        If it takes what is no field of `Subject`.
    """

    name: str
    title: str
    caption: str
    compute: Compute
    draw: Draw
    subject: Subject
    takes: tuple[str, ...]
    label: str = ""
    also: Callable[[], dict[str, str]] = dict

    def __post_init__(self) -> None:
        strange = set(self.takes) - {field.name for field in fields(Subject)}
        if strange:
            raise InputError(f"picture {self.name!r} takes {', '.join(sorted(strange))}")
