"""Costs, sets and other values as a tree of JSON with arrays beside it."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

import numpy as np

from ..graphs import InputError
from .costs import Cost
from .costs import kinds as cost_kinds
from .kind import Kind
from .sets import FeasibleSet
from .sets import kinds as set_kinds

Arrays = dict[str, "np.ndarray[Any, Any]"]
ROLES: dict[str, tuple[type[Kind], Any]] = {
    "cost": (Cost, cost_kinds),
    "set": (FeasibleSet, set_kinds),
}


def encode(value: Any, arrays: Arrays) -> Any:
    """Return a value as JSON; arrays are put aside under the names ``a0, a1, ...``.

    Raises
    ------
    InputError
        If it holds something that has no place in a file.
    """
    if isinstance(value, np.generic):
        value = value.item()
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        return {"float": value.hex()}
    if isinstance(value, np.ndarray):
        if value.dtype.kind not in "biuf":
            raise InputError(f"an array of {value.dtype} cannot be saved; numbers can")
        name = f"a{len(arrays)}"
        arrays[name] = value
        return {"array": name}
    if isinstance(value, list | tuple):
        return [encode(part, arrays) for part in value]
    if isinstance(value, Mapping):
        wrong = [key for key in value if not isinstance(key, str)]
        if wrong:
            raise InputError(f"the key {wrong[0]!r} cannot be saved; text can")
        return {"map": {key: encode(part, arrays) for key, part in value.items()}}
    for role, (base, kinds) in ROLES.items():
        if isinstance(value, base):
            known = kinds()
            if known.get(value.kind) is not type(value):
                raise InputError(
                    f"a {role} of type {type(value).__name__} cannot be saved; "
                    f"kinds of {role}s with a file of their own can: {', '.join(known)}"
                )
            fields = {name: encode(part, arrays) for name, part in value.fields().items()}
            return {role: value.kind, "fields": fields}
    raise InputError(f"a {type(value).__name__} cannot be saved")


def decode(tree: Any, arrays: Mapping[str, Any]) -> Any:
    """Return what was encoded; lists stand for tuples, too.

    Raises
    ------
    InputError
        If the tree is of no such form, names an unknown kind or a missing array, or if fields are
        not those of their kind.
    """
    if tree is None or isinstance(tree, bool | int | str):
        return tree
    if isinstance(tree, list):
        return [decode(part, arrays) for part in tree]
    match tree:
        case {"float": str(text), **rest} if not rest:
            return float.fromhex(text)
        case {"array": str(name), **rest} if not rest:
            if name not in arrays:
                raise InputError(f"its array {name!r} is missing")
            return arrays[name]
        case {"map": dict(parts), **rest} if not rest:
            return {key: decode(part, arrays) for key, part in parts.items()}
    for role, (_, kinds) in ROLES.items():
        if isinstance(tree, dict) and tree.keys() == {role, "fields"}:
            known = kinds()
            if tree[role] not in known:
                raise InputError(
                    f"unknown kind of {role} {tree[role]!r}; known: {', '.join(known)}"
                )
            fields = {name: decode(part, arrays) for name, part in tree["fields"].items()}
            try:
                return known[tree[role]].from_fields(fields)
            except TypeError as error:
                raise InputError(f"fields of the {role} {tree[role]!r}: {error}") from error
    raise InputError(f"unknown entry {str(tree)[:60]!r}")
