"""What the network contributes to the paper's bounds: ``h(r)`` and ``C_3(r)``."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..graphs.growth import Growth
from .arithmetic import Number, kind_of, select
from .ratio import Reach
from .wide import Floats


def reach(growth: Growth, rho_S: Number, r: Any) -> Reach:
    r"""Return ``h(r)`` and ``C_3(r) = sum_{q=0}^r h(q) rho_S^q``.

    Parameters
    ----------
    growth : Growth
        The network's.
    rho_S : number
        Rate per hop; an array broadcasts with an array of radii.
    r : int or array of int
        Radius.

    References
    ----------
    Paper, ``coro:CR-LPC``.
    """
    if kind_of(rho_S) == "float" and np.ndim(rho_S) == 0:
        sizes, sums = table(growth, float(rho_S), int(np.max(r)))
        return Reach(sizes[r], sums[r])
    if np.ndim(r) == 0:
        total = 0 * rho_S
        for q in range(int(r), -1, -1):  # Horner: nonnegative terms, nothing cancels
            total = total * rho_S + growth.h(q)
        return Reach(growth.h(int(r)), total)
    radii = np.asarray(r)
    total = 0 * rho_S + np.zeros(radii.shape)
    for q in range(int(radii.max(initial=0)), -1, -1):
        total = select(q <= radii, total * rho_S + growth.h(q), total)
    return Reach(growth.h(radii), total)


def table(growth: Growth, rho_S: float, last: int) -> tuple[Floats, Floats]:
    """Return ``h`` and ``C_3`` at ``0 .. last``, infinite where they exceed all floats."""
    distances = np.arange(last + 1)
    sizes = growth.h(distances)
    with np.errstate(over="ignore", invalid="ignore"):
        terms = np.where(np.isfinite(sizes), sizes * rho_S**distances, np.inf)
    return sizes, np.cumsum(terms)
