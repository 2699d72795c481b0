"""The Pareto frontier: all pairs (k, r) that reach a target and waste neither."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from ..graphs.errors import InputError
from .arithmetic import one_plus
from .promise import Promise

_CELLS = 256  # pairs evaluated at once
_STRIDE = 1.25  # horizons between two tests whether the bound still depends on them


@dataclass(frozen=True)
class Search:
    """How far to look.

    Parameters
    ----------
    max_k, max_r : int
        Largest horizon and radius considered.
    progress : callable, optional
        Called with a short text now and then.

    Raises
    ------
    InputError
        If a limit excludes every pair.
    """

    max_k: int = 100_000
    max_r: int = 10_000
    progress: Callable[[str], None] | None = None

    def __post_init__(self) -> None:
        for name, least in (("max_k", 2), ("max_r", 1)):
            if getattr(self, name) < least:
                text = f"{name} = {getattr(self, name)}: an integer >= {least} is needed"
                raise InputError(text, name)


@dataclass(frozen=True)
class Pair:
    """A pair that reaches the target: ``CR - 1 <= excess`` there, by interval arithmetic."""

    k: int
    r: int
    excess: float
    variant: str = ""

    @property
    def cr(self) -> float:
        """The competitive ratio ``1 + excess``, rounded up."""
        return float(one_plus(self.excess, up=True))


@dataclass(frozen=True)
class Frontier:
    """The Pareto-minimal pairs by increasing k, or why there are none."""

    pairs: tuple[Pair, ...]
    reason: str = ""


def frontier(promise: Promise, excess: float, search: Search | None = None) -> Frontier:
    """Return all Pareto-minimal (k, r) with a certified ``CR - 1 <= excess``.

    Horizons are taken in increasing order; for each the least radius below the last one
    found is looked for. The floors of the promise say where to begin and when no larger
    horizon can lower the radius; the search also ends once the bound has its limit in k
    (to ``1e-12``) at all radii that are left. Every pair is confirmed in interval
    arithmetic.

    Parameters
    ----------
    promise : Promise
        Bound to plan with.
    excess : float
        What ``CR - 1`` may be, ``> 0``.
    search : Search, optional
        Limits.
    """
    search = search or Search()
    k = _first_horizon(promise, excess, search.max_k)
    if k is None:
        return Frontier((), f"no horizon up to {search.max_k} is long enough at any radius")
    pairs: list[Pair] = []
    low, high = 1, search.max_r + 1
    test = max(k, promise.steps)  # when to ask next whether larger horizons are of use
    while k <= search.max_k:
        if search.progress is not None:
            search.progress(f"k = {k}, r < {high}")
        if k >= promise.steps:
            low = _first(_is_open(promise, k, excess), low, high)
        if low >= high:
            break
        if pairs:  # few radii are left: many horizons at once
            block = np.arange(k, min(k + 1 + _CELLS // (high - low), search.max_k + 1))
            found = _by_block(promise, block, low, high, excess)
        else:
            block = np.array([k])
            pair = _first_radius(promise, k, low, high, excess)
            found = [pair] if pair is not None else []
        pairs += found
        high = pairs[-1].r if pairs else high
        k = int(block[-1]) + 1
        if k > test and low < high:
            if promise.settled(k - 1, np.arange(low, high)):
                break
            test = int(_STRIDE * k)
    if pairs:
        return Frontier(tuple(pairs))
    return Frontier((), f"no radius up to {search.max_r} is large enough at any horizon")


def _is_open(promise: Promise, k: int, excess: float) -> Callable[[Any], Any]:
    """Return the test whether a radius may still do at some horizon from k on."""
    return lambda r: promise.floor_in_r(k, r) <= excess


def _by_block(promise: Promise, block: Any, low: int, high: int, excess: float) -> list[Pair]:
    """Return the pairs that lower the radius further, over a block of horizons."""
    radii = np.arange(low, high)
    shape = (block.size, radii.size)
    values = np.broadcast_to(promise.excess(block[:, None], radii[None, :]), shape)
    pairs: list[Pair] = []
    for i, j in zip(*np.nonzero(values <= excess), strict=True):  # by k, then by r
        k, r = int(block[i]), int(radii[j])
        upper = promise.upper(k, r) if r < high else np.inf
        if upper <= excess:
            pairs.append(Pair(k, r, upper, promise.variant))
            high = r
    return pairs


def _first_horizon(promise: Promise, excess: float, max_k: int) -> int | None:
    """Return the least k whose floor does not exceed the target; the floor decreases."""
    low, high = 1, 2
    while not float(promise.floor_in_k(high)) <= excess:  # an undefined floor reaches nothing
        if high >= max_k:
            return None
        low, high = high, min(2 * high, max_k)
    while high - low > 1:
        middle = (low + high) // 2
        if float(promise.floor_in_k(middle)) <= excess:
            high = middle
        else:
            low = middle
    return high


def _first(good: Callable[[Any], Any], low: int, high: int) -> int:
    """Return the least r in [low, high) that is good, else ``high``; in growing chunks."""
    size = 8
    while low < high:
        radii = np.arange(low, min(low + size, high))
        hits = np.flatnonzero(good(radii))
        if hits.size:
            return int(radii[hits[0]])
        low, size = low + size, min(2 * size, 256)
    return high


def _first_radius(promise: Promise, k: int, low: int, high: int, excess: float) -> Pair | None:
    """Return the pair of the least radius in [low, high) with a certified bound."""
    size = 8
    while low < high:
        radii = np.arange(low, min(low + size, high))
        values = np.broadcast_to(promise.excess(k, radii), radii.shape)
        for i in np.flatnonzero(values <= excess):
            upper = promise.upper(k, int(radii[i]))
            if upper <= excess:
                return Pair(k, int(radii[i]), upper, promise.variant)
        low, size = low + size, min(2 * size, 256)
        if promise.hopeless(k, int(radii[-1]), excess):
            return None
    return None
