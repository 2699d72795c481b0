"""One theorem a file. A file here adds its ``BOUNDS`` to the catalogue, and so everywhere."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from ..theorem import Bound


@cache
def catalogue() -> tuple[Bound, ...]:
    """Return every bound of this folder, in the order of labels and tiers.

    A module of the folder that does not start with an underscore lists its bounds in
    ``BOUNDS``; nothing else is needed to add a theorem.
    """
    tiers = ("stated", "repaired", "sharp")
    found: list[Bound] = []
    for module in sorted(pkgutil.iter_modules(__path__), key=lambda m: m.name):
        if not module.name.startswith("_"):
            found.extend(importlib.import_module(f"{__name__}.{module.name}").BOUNDS)
    return tuple(
        sorted(found, key=lambda b: (b.label.startswith("nearsight"), b.label, tiers.index(b.tier)))
    )


def bounds_for(label: str) -> tuple[Bound, ...]:
    """Return the bounds of one label.

    Raises
    ------
    KeyError
        If no bound has that label; the message lists the labels there are.
    """
    found = tuple(b for b in catalogue() if b.label == label)
    if not found:
        labels = ", ".join(sorted({b.label for b in catalogue()}))
        raise KeyError(f"no bound has the label {label!r}; there are: {labels}")
    return found
