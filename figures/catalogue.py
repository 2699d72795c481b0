"""Every picture, found by lying in its folder."""

from __future__ import annotations

import pkgutil
from difflib import get_close_matches
from functools import cache
from importlib import import_module

from ..graphs import InputError
from . import pictures as folder
from .picture import Picture


@cache
def pictures() -> tuple[Picture, ...]:
    """Return all pictures: those of the paper first, then by name.

    Raises
    ------
    InputError
        If the name of a picture is not that of its file.
    """
    found = []
    for module in pkgutil.iter_modules(folder.__path__):
        if module.name.startswith("_"):  # shared by several pictures
            continue
        picture: Picture = import_module(f"{folder.__name__}.{module.name}").PICTURE
        if picture.name != module.name.replace("_", "-"):
            raise InputError(f"picture {picture.name!r} lies in {module.name}.py")
        found.append(picture)
    return tuple(sorted(found, key=lambda p: (not p.label, p.name)))


def picture_named(name: str) -> Picture:
    """Return one picture, by its name or by the label of its figure in the paper.

    Raises
    ------
    InputError
        If there is none; the message lists near names, or all.
    """
    for picture in pictures():
        if name in (picture.name, picture.label):
            return picture
    names = [picture.name for picture in pictures()]
    near = get_close_matches(name, names, 3, 0.5)
    hint = f"near it: {', '.join(near)}" if near else f"there are: {', '.join(names)}"
    raise InputError(f"no figure {name!r}; {hint}")
