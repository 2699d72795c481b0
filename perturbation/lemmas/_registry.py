"""Finding the lemmas, and measuring one on many random instances."""

from __future__ import annotations

import pkgutil
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from importlib import import_module
from typing import Any

from ...graphs import InputError
from ..comparison import Comparison


@dataclass(frozen=True)
class Lemma:
    """A lemma that can be measured.

    Parameters
    ----------
    label : str
        Its label in the paper, unchanged.
    title : str
        What it says, in a few words.
    measure : callable
        Maps a seed to the comparisons on one random instance: one for every part of the lemma
        that the instance has anything to say on.
    """

    label: str
    title: str
    measure: Callable[[int], tuple[Comparison, ...]]


@cache
def lemmas() -> dict[str, Lemma]:
    """Return every lemma of this folder by its label, in alphabetical order."""
    package = import_module(__package__ or "")
    names = [m.name for m in pkgutil.iter_modules(package.__path__) if not m.name.startswith("_")]
    found = [import_module(f"{__package__}.{name}") for name in names]
    listed = [Lemma(str(m.LABEL), str(m.TITLE), m.measure) for m in found]
    return {lemma.label: lemma for lemma in sorted(listed, key=lambda lemma: lemma.label)}


def measure_lemma(
    label: str, instances: int = 100, seed: int = 0, *, keep: int = 1
) -> tuple[Comparison, ...]:
    """Measure a lemma on the instances of the seeds ``seed, seed + 1, ...``; return the worst.

    Parameters
    ----------
    label : str
        One of `lemmas`.
    instances : int
        How many instances, at least 1.
    seed : int
        The first seed, at least 0.
    keep : int
        How many comparisons are returned for every part, at least 1.

    Returns
    -------
    tuple of Comparison
        For every part, and apart for instances within and without the hypotheses, those with the
        largest `ratio`, the largest first. ``measure(c.seed)`` gives any of them again.

    Raises
    ------
    InputError
        If there is no such lemma, or a number is out of range.
    """
    known = lemmas()
    if label not in known:
        raise InputError(f"label = {label!r}: one of {', '.join(map(repr, known))}", "label")
    numbers: tuple[tuple[str, Any, int], ...] = (
        ("instances", instances, 1),
        ("seed", seed, 0),
        ("keep", keep, 1),
    )
    for name, value, least in numbers:
        if not isinstance(value, int) or isinstance(value, bool) or value < least:
            raise InputError(f"{name} = {value!r}: an integer >= {least} is needed", name)
    parts: dict[tuple[str, bool], list[Comparison]] = {}
    for one in range(seed, seed + instances):
        for found in known[label].measure(one):
            group = parts.setdefault((found.part, found.hypotheses), [])
            group.append(found)
            group.sort(key=lambda c: -c.ratio)
            del group[keep:]
    return tuple(c for key in sorted(parts, key=_order) for c in parts[key])


def _order(key: tuple[str, bool]) -> tuple[bool, str]:
    """Instances within the hypotheses come first."""
    part, hypotheses = key
    return not hypotheses, part
