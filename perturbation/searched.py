"""The other side of a profile: how large sensitivities can be made within the class."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..lpc.instances import instance
from ..lpc.local import LocalProblem
from .neighbourhood import Neighbourhood
from .profile import PARTS
from .spec import Spec
from .worst import Worst, worst

Progress = Callable[[int, int], None]


@dataclass(frozen=True, eq=False)
class Searched:
    """What a search over all quadratic costs of the class has reached, cell by cell.

    Parameters
    ----------
    v : int
        The agent whose local problem was searched.
    worst : Worst
        The entry at which the tier searched for fares worst, with its instance.
    cells : dict
        ``(part, dt, ds)`` to the largest sensitivity reached.
    """

    v: int
    worst: Worst
    cells: dict[tuple[str, int, int], float]


def searched(
    spec: Spec,
    *,
    v: int | None = None,
    tier: str = "stated",
    starts: int = 2,
    progress: Progress | None = None,
) -> Searched:
    """Push the sensitivities of one local problem up, over all quadratic costs of the class.

    Parameters
    ----------
    spec : Spec
        The network, the class, k and r; its styles and box play no part.
    v : int, optional
        The agent; one with most neighbours if omitted.
    tier : str
        The entries at which this tier fares worst are searched most.
    starts : int
        Random starts of a full search.
    progress : callable, optional
        Called as ``progress(done, total)``.
    """
    v = int(spec.network.degrees.argmax()) if v is None else v
    around = Neighbourhood.of(spec.network, v, spec.r)
    made = instance(around.network, spec.k, spec.parameters, n=spec.n)  # its costs play no part
    window = LocalProblem(made, 1, 0, spec.k, spec.r)
    found = worst(
        window,
        spec.parameters,
        tier=tier,
        starts=starts,
        seed=spec.seed,
        growth=spec.growth,
        progress=progress,
    )
    cells: dict[tuple[str, int, int], float] = {}
    for look in found.looks:
        cell = _cell(look.target.free, look.target.fixed, around, spec.k)
        cells[cell] = max(cells.get(cell, 0.0), look.value)
    return Searched(v, found, cells)


def _cell(
    free: tuple[int, int | None], fixed: tuple[int, int | None], around: Neighbourhood, k: int
) -> tuple[str, int, int]:
    """Return the part and the distances of one entry of a window of the steps 1..k-1."""
    part = PARTS[0] if fixed[0] == k else PARTS[1] if fixed[0] == 0 else PARTS[2]
    ends = np.array([-1 if end is None else end for end in (free[1], fixed[1])])
    return part, abs(free[0] - fixed[0]), int(around.distance[ends[0], ends[1]])
