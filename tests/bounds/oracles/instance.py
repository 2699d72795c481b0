"""Quadratic networks, their optimum and LPC, as linear maps of the data.

The costs are sums of squares, ``|R x + W omega|^2 / 2`` in all, with the trajectory
``x = (x_1, ..., x_H)`` and the data ``omega = (x_0, theta_1, ..., theta_H, shifts)``. With
mu = 1 the row blocks are

* node costs ``|F (x - theta)|^2 / 2`` with ``I <= F'F <= l_f I``,
* temporal and spatial costs ``|G z - shift|^2 / 2`` of two blocks z with ``G'G <= l I``.
"""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from .graph import Graph


@dataclass(frozen=True, eq=False)
class Instance:
    """A network with quadratic costs over steps 1 .. H, n numbers an agent and step.

    Parameters
    ----------
    node : array (H, N, n, n)
        Factors F.
    temporal : array (H, N, p, 2n)
        Factors G of ``(x_{t-1}, x_t)``.
    spatial : array (H, E, p, 2n)
        Factors G of ``(x_u, x_v)``, edge by edge.
    shifts : bool
        Whether the couplings have shifts of their own among the data.
    """

    graph: Graph
    node: np.ndarray
    temporal: np.ndarray
    spatial: np.ndarray
    shifts: bool = False

    @property
    def H(self):
        return self.node.shape[0]

    @property
    def n(self):
        return self.node.shape[-1]

    @property
    def slice(self):
        """Numbers a step."""
        return self.graph.vertices * self.n

    def at(self, t, v):
        """Positions of (t, v) in x, for t = 1 .. H."""
        start = ((t - 1) * self.graph.vertices + v) * self.n
        return np.arange(start, start + self.n)

    def where(self, pairs):
        """Positions of many (t, v)."""
        return np.concatenate([self.at(t, v) for t, v in pairs] or [np.zeros(0, int)])

    @cached_property
    def rows(self):
        """``(R, W)`` of the cost ``|R x + W omega|^2 / 2``."""
        n, size = self.n, self.H * self.slice
        blocks = [(F, [(t, v)]) for (t, v), F in by_step(self.node)]
        pairs = [(G, [(t - 1, v), (t, v)]) for (t, v), G in by_step(self.temporal)]
        edges = self.graph.edges
        pairs += [(G, [(t, u) for u in edges[e]]) for (t, e), G in by_step(self.spatial)]
        extra = sum(len(G) for G, _ in pairs) if self.shifts else 0
        total = sum(len(G) for G, _ in blocks + pairs)
        R, W = np.zeros((total, size)), np.zeros((total, self.slice + size + extra))
        row, shift = 0, self.slice + size
        for G, ends in blocks + pairs:
            here = slice(row, row + len(G))
            for i, (t, v) in enumerate(ends):
                part = G[:, i * n : (i + 1) * n]
                if t == 0:
                    W[here, v * n : (v + 1) * n] += part
                else:
                    R[here, self.at(t, v)] += part
            if len(ends) == 1:
                W[here, self.slice + self.at(*ends[0])] -= G
            elif self.shifts:
                W[here, shift : shift + len(G)] = -np.eye(len(G))
                shift += len(G)
            row += len(G)
        return R, W

    @cached_property
    def gradient(self):
        """``(M, C)`` of the gradient ``M x + C omega``."""
        R, W = self.rows
        return R.T @ R, R.T @ W

    @cached_property
    def optimum(self):
        """The clairvoyant trajectory as a linear map of omega."""
        M, C = self.gradient
        return -np.linalg.solve(M, C)

    @cached_property
    def targets(self):
        """theta as a linear map of omega."""
        size = self.H * self.slice
        theta = np.zeros((size, self.rows[1].shape[1]))
        theta[:, self.slice : self.slice + size] = np.eye(size)
        return theta

    def free(self, t, v, k, r):
        """The free variables of the local problem of (t, v), those past H left out."""
        ball = np.flatnonzero(self.graph.distance[v] <= r - 1)
        return [(s, u) for s in range(t, min(t + k - 2, self.H) + 1) for u in ball]

    def lpc(self, k, r):
        """LPC's trajectory as a linear map of omega; past H nothing is coupled."""
        M, C = self.gradient
        actions = np.zeros_like(self.targets)
        for t in range(1, self.H + 1):
            known = self.targets.copy()  # of all steps but the one before
            before = slice(max(t - 2, 0) * self.slice, (t - 1) * self.slice)
            known[before] = actions[before]
            for v in range(self.graph.vertices):
                free = self.where(self.free(t, v, k, r))
                touched = np.setdiff1d(np.flatnonzero(M[free].any(axis=0)), free)
                right = M[np.ix_(free, touched)] @ known[touched] + C[free]
                plan = -np.linalg.solve(M[np.ix_(free, free)], right)
                here = self.at(t, v)
                actions[here] = plan[np.searchsorted(free, here)]
        return actions

    def worst(self, k, r):
        """The largest ``cost(LPC)/OPT - 1`` over all omega, and such an omega.

        ``cost(LPC) - OPT = |x - x*|_M^2 / 2`` exactly, so nothing is subtracted. The
        quotient lives on the range of OPT: where OPT is 0, LPC pays nothing either.
        """
        root, basis = self.range
        off = root @ (self.lpc(k, r) - self.optimum)
        _, top, directions = np.linalg.svd(off @ basis, full_matrices=False)
        return top[0] ** 2, basis @ directions[0]

    @cached_property
    def range(self):
        """A root of M, and a basis of the range of OPT in which OPT is ``|.|^2 / 2``."""
        R, W = self.rows
        _, s, V = np.linalg.svd(W + R @ self.optimum, full_matrices=False)
        kept = s > 1e-7 * s[0]
        return np.linalg.cholesky(self.gradient[0]).T, V[kept].T / s[kept]

    def cost(self, x, omega):
        """The cost of trajectories, column by column."""
        R, W = self.rows
        return 0.5 * np.sum((R @ x + W @ omega) ** 2, axis=0)


def by_step(array):
    """Yield ``((t, i), matrix)``, steps counted from 1."""
    for index in np.ndindex(array.shape[:2]):
        yield (index[0] + 1, index[1]), array[index]
