"""The Hessian of a quadratic problem, block by block."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from .arrays import Floats, Ints, spread
from .costs import Quadratic
from .problem import Problem


@dataclass(frozen=True, eq=False)
class Blocks:
    """``M`` and ``b`` of a quadratic problem: its gradient at x is ``M x + C x_0 - b``.

    A block that is the same at all steps is kept once: T is 1 or H.

    Parameters
    ----------
    diagonal : ndarray, shape (T, N, n, n)
        Block (t, v), (t, v) at steps ``t < H``, where the cost of step t + 1 adds to it.
    last : ndarray, shape (N, n, n)
        The same at step H.
    before : ndarray, shape (T, N, n, n)
        Block (t, v), (t - 1, v); at t = 1 it multiplies x_0.
    beside : ndarray, shape (T, E, n, n)
        Block (t, u), (t, w) of the edge (u, w), ``u < w``.
    linear : ndarray, shape (H, N, n)
        ``b``: minus the gradient at 0.
    """

    diagonal: Floats
    last: Floats
    before: Floats
    beside: Floats
    linear: Floats

    @classmethod
    def of(cls, problem: Problem) -> Blocks:
        """Return the blocks of a problem whose costs are all `Quadratic`."""
        node, temporal, spatial = (_quadratic(problem, z) for z in ("node", "temporal", "spatial"))
        H, N, n, edges = problem.H, problem.N, problem.n, problem.edges
        pair = temporal.matrix.reshape(*temporal.matrix.shape[:2], 2, n, 2, n)
        edge = spatial.matrix.reshape(*spatial.matrix.shape[:2], 2, n, 2, n)
        T = 1 if problem.steady else H
        around = np.zeros((edge.shape[0], N, n, n))
        full = np.broadcast_to(edge, (edge.shape[0], len(edges), 2, n, 2, n))
        for side in range(2):
            _add(around, edges[:, side], full[:, :, side, :, side])
        own = node.matrix + pair[:, :, 0, :, 0] + around
        own = np.broadcast_to(own, (T, N, n, n))
        after = pair[:, :, 1, :, 1]
        following = after if len(after) == 1 else np.concatenate([after[1:], after[-1:]])
        before, beside = pair[:, :, 0, :, 1], edge[:, :, 0, :, 1]
        return cls(
            own + following,
            own[-1].copy(),
            np.broadcast_to(before, (before.shape[0], N, n, n)),
            np.broadcast_to(beside, (beside.shape[0], len(edges), n, n)),
            _linear(node, temporal, spatial, edges, (H, N, n)),
        )

    @property
    def steady(self) -> bool:
        """Whether the blocks of all steps but the last are the same."""
        return len(self.diagonal) == len(self.before) == len(self.beside) == 1

    def own(self, t: int) -> Floats:
        """Return the diagonal blocks of step t, shape (N, n, n)."""
        return self.last if t == len(self.linear) else _step(self.diagonal, t)

    def back(self, t: int) -> Floats:
        """Return the blocks (t, v), (t - 1, v) of step t, shape (N, n, n)."""
        return _step(self.before, t)

    def across(self, t: int) -> Floats:
        """Return the blocks of the edges at step t, shape (E, n, n)."""
        return _step(self.beside, t)


def _step(array: Floats, t: int) -> Floats:
    found: Floats = array[t - 1 if len(array) > 1 else 0]
    return found


def _quadratic(problem: Problem, name: str) -> Quadratic:
    cost = getattr(problem, name)
    if not isinstance(cost, Quadratic):
        raise TypeError(f"{name} costs are of kind {cost.kind!r}, not quadratic")
    return cost


def _linear(
    node: Quadratic,
    temporal: Quadratic,
    spatial: Quadratic,
    edges: Ints,
    shape: tuple[int, int, int],
) -> Floats:
    """Return b; a centre of a pair cost pulls both of its ends."""
    H, N, n = shape
    found = np.array(spread(node.linear, H, N))
    if temporal.linear.any():
        pull = spread(temporal.linear, H, N).reshape(H, N, 2, n)
        found += pull[:, :, 0]
        found[:-1] += pull[1:, :, 1]
    if spatial.linear.any():
        pull = spread(spatial.linear, H, len(edges)).reshape(H, len(edges), 2, n)
        for side in range(2):
            _add(found, edges[:, side], pull[:, :, side])
    return found


def _add(total: Floats, agents: Ints, parts: Floats) -> None:
    """Add the parts (T, E, ...) of edges to the totals (T, N, ...) of one of their ends."""
    for sums, part in zip(total, parts, strict=True):
        np.add.at(sums, agents, part)
