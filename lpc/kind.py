"""Kinds of costs and of sets: found by lying in their folder, saved by what they are made from."""

from __future__ import annotations

import dataclasses
import inspect
import pkgutil
from abc import ABC
from collections.abc import Mapping
from functools import cache
from importlib import import_module
from typing import Any, Self, cast


class Kind(ABC):
    """What a cost and a feasible set have in common: a name in files, and fields.

    A concrete class sets `kind` and is a dataclass whose fields are the arguments of its
    constructor; then nothing else is needed for it to be saved and loaded. A field may be an
    array, a number, a string, a truth value, None, another cost or set, or a list, tuple or
    (string-keyed) dict of those.
    """

    kind: str  # the name of the class in a file

    def fields(self) -> dict[str, Any]:
        """Return the arguments of the constructor that make this object again, by name.

        Raises
        ------
        InputError
            If the object cannot be saved.
        """
        own = dataclasses.fields(cast("Any", self))
        return {field.name: getattr(self, field.name) for field in own if field.init}

    @classmethod
    def from_fields(cls, fields: Mapping[str, Any]) -> Self:
        """Return the object that has the given fields."""
        return cls(**fields)


@cache
def kinds_of(package: str) -> dict[str, type[Kind]]:
    """Return the concrete kinds that the modules of a package define, by name.

    Parameters
    ----------
    package : str
        The full name of the package.
    """
    parent = import_module(package)
    found: dict[str, type[Kind]] = {}
    for info in pkgutil.iter_modules(parent.__path__):
        module = import_module(f"{package}.{info.name}")
        for value in vars(module).values():
            own = inspect.isclass(value) and value.__module__ == module.__name__
            if own and issubclass(value, Kind) and "kind" in vars(value):
                found[value.kind] = value
    return dict(sorted(found.items()))
