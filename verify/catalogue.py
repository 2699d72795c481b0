"""Every claim, found by lying in its folder."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from ..graphs import InputError
from . import claims
from .claim import Claim


@cache
def catalogue() -> tuple[Claim, ...]:
    """Return all claims, in the order of files and of ``CLAIMS`` within a file.

    A module of `verify.claims` that does not start with an underscore lists its claims in
    ``CLAIMS``; nothing else is needed to add one.

    Raises
    ------
    InputError
        If two claims have one key, or a claim uses one that is not there.
    """
    found: dict[str, Claim] = {}
    for module in sorted(pkgutil.iter_modules(claims.__path__), key=lambda m: m.name):
        if module.name.startswith("_"):
            continue
        for claim in importlib.import_module(f"{claims.__name__}.{module.name}").CLAIMS:
            if claim.key in found:
                raise InputError(f"claim {claim.key!r} is listed twice")
            found[claim.key] = claim
    for claim in found.values():
        for key in claim.uses:
            if key not in found:
                raise InputError(f"claim {claim.key!r} uses {key!r}, which is not there")
    return tuple(found.values())
