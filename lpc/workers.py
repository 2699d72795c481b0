"""Threads that share the local problems of one step."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from typing import TypeVar

from .arrays import integer

S = TypeVar("S")
T = TypeVar("T")


@dataclass(frozen=True)
class Workers:
    """Map a function over parts of the work, in as many threads as asked for.

    The parts are the same whatever the number of threads, and so are the results, bit for bit:
    NumPy lets other threads run while it computes, and nothing is summed across parts.

    Parameters
    ----------
    count : int
        Number of threads, at least 1; 0 stands for one a core.

    Raises
    ------
    InputError
        If the count is negative or no integer.
    """

    count: int = 1

    def __post_init__(self) -> None:
        integer(self.count, "workers", 0)
        if self.count == 0:
            object.__setattr__(self, "count", os.cpu_count() or 1)

    def map(self, function: Callable[[S], T], parts: Iterable[S]) -> Iterator[T]:
        """Yield the results in the order of the parts."""
        parts = list(parts)
        if self.count == 1 or len(parts) < 2:
            yield from map(function, parts)
            return
        with ThreadPoolExecutor(self.count) as pool:
            yield from pool.map(function, parts)
