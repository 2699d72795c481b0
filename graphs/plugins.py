"""Families found by lying in their folder: a new file is a new family."""

from __future__ import annotations

import pkgutil
from functools import cache
from importlib import import_module
from types import ModuleType


@cache
def modules(package: str) -> dict[str, ModuleType]:
    """Import every module of one of the packages beside this file.

    Parameters
    ----------
    package : str
        ``"families"`` or ``"infinite"``.

    Returns
    -------
    dict
        The modules by their `NAME`, in alphabetical order.
    """
    parent = import_module(f".{package}", __package__)
    found = [
        import_module(f"{parent.__name__}.{m.name}") for m in pkgutil.iter_modules(parent.__path__)
    ]
    return {module.NAME: module for module in sorted(found, key=lambda m: str(m.NAME))}
