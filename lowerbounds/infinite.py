"""The spatial lower bound on infinite networks: trees, the line, the grid, rings of blocks."""

from __future__ import annotations

import numpy as np

from ..bounds.arithmetic import Number, power, sqrt
from ..bounds.decay import g
from ..bounds.formula import formula
from ..bounds.lower import spatial_excess
from ..graphs import Growth
from ..graphs.infinite.grid2 import Grid2
from ..graphs.infinite.line import Line
from ..graphs.infinite.ring_of_blocks import RingOfBlocks
from ..graphs.infinite.tree import Tree
from ..lpc.arrays import Floats, Ints
from .grounded import Grounded
from .resolvent import off_diagonal, within_block

LARGEST_RADIUS = 100  # of the grid, where a ball is factorised
STRONGEST = 1e8  # l_S/mu of the grid: the angles needed grow with its root
DEEPEST = 2000  # of trees, where levels are eliminated one by one


def infinite_excess(growth: Growth, a_S: float, r: int) -> float | None:
    """Return the spatial lower bound on ``CR - 1`` of an infinite network; None if unknown."""
    if isinstance(growth, Line):
        return ring_excess(a_S, 1, r)
    if isinstance(growth, Tree) and r <= DEEPEST:
        return float(tree_excess(a_S, growth.max_degree, r))
    if isinstance(growth, RingOfBlocks):
        return ring_excess(a_S, growth.size, r)
    if isinstance(growth, Grid2) and r <= LARGEST_RADIUS and a_S <= STRONGEST:
        return grid_excess(a_S, r)
    return None


def ring_excess(a_S: float, d: int, r: int) -> float:
    """Return `bounds.lower.spatial_excess`, also for ``r = 0``."""
    if r:
        return float(spatial_excess(a_S, d, r))
    if a_S == 0:
        return 0.0
    # alone, 1/(1 + 2 d l): what it lacks is an entry within a block
    return float(within_block(a_S / 2, d) / off_diagonal(a_S / 2, d))


@formula(counts=("degree", "r"))
def tree_excess(a_S: Number, degree: int, r: int) -> Number:
    r"""Return the spatial lower bound on ``CR - 1`` of the infinite tree of one degree.

    With ``l = a_S/2`` and ``m = 1 + l Delta``, branches are eliminated from the leaves of the
    ball: ``f_1 = m``, ``f_{n+1} = m - (Delta-1) l^2/f_n`` down to ``f``, the fixed point; their
    distance ``f_n - f`` follows by products. At the root ``u = m - Delta l^2/f``, ``u_r = m - Delta
    l^2/f_r``, and the bound is ``Delta l^2 (1/f - 1/f_r)/(u_r (u - 1))``.
    """
    ell = a_S / 2
    m, inner = 1 + ell * degree, (degree - 1) * power(ell, 2)
    # f = (m + sqrt(m^2 - 4 inner))/2, and m^2 - 4 (Delta-1) l^2 = 1 + 2 l Delta + l^2 (Delta-2)^2
    f = (m + sqrt(1 + 2 * ell * degree + power(ell * (degree - 2), 2))) / 2
    pull = degree * power(ell, 2)
    if r == 0:
        rest, held = pull / f, m
    else:
        here, off = m, inner / f
        for _ in range(r - 1):
            off = inner * off / (here * f)
            here = m - inner / here
        rest, held = pull * off / (here * f), m - pull / here
    # 1 - B_jj = (u - 1)/u with u - 1 = l Delta (f - l)/f, and f > l
    optimum = ell * degree * (f - ell) / f
    coupled = bool(np.all(a_S > 0))
    return rest / (held * optimum) if coupled else 0 * a_S


def grid_excess(a_S: float, r: int) -> float:
    r"""Return the spatial lower bound on ``CR - 1`` of the infinite square grid.

    ``B`` between points (m, n) apart is the mean over angles t of ``cos(n t) q^|m|/s``,
    ``q = g(4l/A)``, ``s = sqrt(A (A + 4l))``, ``A = 1 + 2l (1 - cos t)``, ``l = a_S/2``; the
    trapezoidal rule converges geometrically. Then ``u' B u`` as for finite graphs, u on the
    sphere of radius ``r + 1``.
    """
    if a_S == 0:
        return 0.0
    ell, span = a_S / 2, 2 * (r + 1)
    rate = float(g(4 * ell))  # along an axis
    points = span + int(np.ceil(-40 / np.log(rate))) + 8
    angles = 2 * np.pi * np.arange(points) / points
    A = 1 + 4 * ell * np.sin(angles / 2) ** 2
    q, s = np.asarray(g(4 * ell / A)), np.sqrt(A * (A + 4 * ell))
    # 1 - 1/s = (s^2 - 1)/(s (s + 1))
    optimum = float(np.mean(((A - 1) * (A + 1) + 4 * A * ell) / (s * (s + 1))))
    apart = np.arange(span + 1)
    B = (q ** apart[:, None] / s) @ np.cos(angles[:, None] * apart) / points
    u, x, y = _sphere(ell, r)
    return float(u @ B[np.abs(x[:, None] - x), np.abs(y[:, None] - y)] @ u) / optimum


def _sphere(ell: float, r: int) -> tuple[Floats, Ints, Ints]:
    """Return ``u = l A_OS (M_SS)^{-1} e_0`` and where it is, on the sphere of radius r + 1."""
    side = 2 * r + 3
    x, y = (c.ravel().astype(np.int64) - r - 1 for c in np.indices((side, side)))
    number = np.arange(side * side).reshape(side, side)
    across = np.stack([number[:-1].ravel(), number[1:].ravel()], axis=1)
    along = np.stack([number[:, :-1].ravel(), number[:, 1:].ravel()], axis=1)
    ends = np.concatenate([across, along])
    whole = Grounded(np.zeros(side * side), ends, np.full(len(ends), ell))
    apart = np.abs(x) + np.abs(y)
    members = np.flatnonzero(apart <= r)
    part, inner, outer, weight = whole.part(members)
    z = part.solve((apart[members] == 0).astype(float))
    u = np.zeros(side * side)
    np.add.at(u, outer, weight * z[inner])
    rim = np.flatnonzero(apart == r + 1)
    return u[rim], x[rim], y[rim]
