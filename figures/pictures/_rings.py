"""A ring of blocks, recognised and drawn as one; and the network beside it, coloured."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from ...graphs import Network
from ...lowerbounds.ring import Ring
from ...lpc.arrays import Floats
from ..parts import thin

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH = 0.17  # of a block along the radius, where the radius is 1/2


def ring_of(network: Network) -> Ring | None:
    """Return the ring of blocks that a network is, agents numbered as in the family, or None."""
    n, degree = network.vertices, network.max_degree
    d = degree // 2
    if degree % 2 or d < 1 or n % d or n // d < 3:
        return None
    same = Ring(d, n // d).network
    equal = np.array_equal(same.indptr, network.indptr) and np.array_equal(
        same.indices, network.indices
    )
    return Ring(d, n // d) if equal else None


def ring_places(ring: Ring, v: int) -> dict[int, tuple[float, float]]:
    """Return places on a circle in the unit square, the block of agent v on top."""
    N, d = int(ring.blocks or 0), ring.d
    found = {}
    for u in range(N * d):
        angle = np.pi / 2 - 2 * np.pi * (u // d - v // d) / N
        radius = 0.42 + WIDTH * (u % d - (d - 1) / 2) / max(d - 1, 1)
        x, y = 0.5 + radius * np.cos(angle), 0.5 + radius * np.sin(angle)
        found[u] = (round(float(x), 4), round(float(y), 4))
    return found


def draw_network(
    axes: Axes,
    at: dict[int, tuple[float, float]],
    edges: Sequence[tuple[int, int]],
    values: dict[int, float],
    norm: Any,
    special: dict[int, str],
    **sizes: float,
) -> Floats:
    """Draw a network with a colour a value (grey without one); return its lines.

    Parameters
    ----------
    axes : Axes
    at : dict
        The places.
    edges : sequence of pairs
    values : dict
        Of some agents; on the scale `norm`, in cividis.
    norm : Normalize
    special : dict
        Marks of some agents.
    **sizes
        ``radius`` of a mark in points, and the ``edge`` width of lines.
    """
    from matplotlib.collections import LineCollection

    lines = np.array([(at[a], at[b]) for a, b in edges], dtype=np.float64).reshape(-1, 2, 2)
    line = thin()
    axes.add_collection(
        LineCollection(list(lines), colors="0.72", linewidths=sizes["edge"], zorder=1)
    )
    area = (2 * sizes["radius"]) ** 2
    for mark in ("o", *special.values()):
        mine = [u for u in at if special.get(u, "o") == mark]
        if not mine:
            continue
        x, y = np.array([at[u] for u in mine]).T
        axes.scatter(
            x,
            y,
            s=area * {"o": 1, "*": 2.6}.get(mark, 1.7),
            c=[values.get(u, np.nan) for u in mine],
            norm=norm,
            cmap="cividis",
            marker=mark,
            edgecolor="0.1",
            linewidth=line,
            zorder=3 + (mark != "o"),
            plotnonfinite=True,
            clip_on=False,
        )
    axes.set_axis_off()
    axes.set_aspect("equal")
    return lines
