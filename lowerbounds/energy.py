"""The quadratic forms of a quadratic network: couplings, node costs, and the optimum itself."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from scipy import sparse

from ..graphs import InputError
from ..lpc.arrays import Floats, Ints, spread
from ..lpc.costs import Quadratic
from ..lpc.problem import Problem
from ..lpc.scatter import scatter


@dataclass(frozen=True, eq=False)
class Energy:
    """The cost as a form in ``D = theta - x*``, without solving anything.

    With node Hessians Q and couplings ``xi' L xi / 2``, ``xi = (x_0, x)``, let K be the block of L
    of the steps 1..H and ``M = Q + K``. The optimum ``x*`` satisfies ``Q D = (L xi*)_{1..H}``.

    *Neither x_0 nor the centres of pair costs make anything worse.* Write the pair costs as
    ``|rho|^2 / 2``, ``rho = G_0 x_0 + G x - c`` with any centres c, so that ``K = G'G`` and
    ``Q D = G' rho`` at the optimum. LPC's deviation depends on the data through D alone
    (`Deviation`), and the optimum costs ``(D'Q D + |rho|^2)/2``. Among all rho with
    ``G' rho = Q D`` the shortest is ``rho = G y``, ``K y = Q D``; it belongs to ``x_0 = 0``,
    ``c = 0``, ``x* = y``. So the worst data have no other form, and they cost the optimum::

        (D'Q D + y'K y)/2 = y' K Q^{-1} M y / 2,      D = Q^{-1} K y,      theta = Q^{-1} M y.

    Parameters
    ----------
    problem : Problem
        Quadratic and unconstrained; its targets, x_0 and centres of pair costs are all 0.
    couplings : csr_array, shape (H N n, H N n)
        K.
    node : csr_array, shape (H N n, H N n)
        Q.
    inverse : csr_array
        ``Q^{-1}``.
    """

    problem: Problem
    couplings: sparse.csr_array
    node: sparse.csr_array
    inverse: sparse.csr_array

    @classmethod
    def of(cls, problem: Problem) -> Energy:
        """Return the forms of a problem.

        Raises
        ------
        InputError
            If a cost is not quadratic, or there are constraints.
        """
        node, temporal, spatial = problem.node, problem.temporal, problem.spatial
        if not (
            isinstance(node, Quadratic)
            and isinstance(temporal, Quadratic)
            and isinstance(spatial, Quadratic)
            and problem.feasible.everywhere
        ):
            raise InputError(
                "the exact worst case is that of quadratic costs without constraints; this "
                "problem has others"
            )
        H, N, n = problem.H, problem.N, problem.n
        Q = spread(node.matrix, H, N).reshape(-1, n, n)
        first = np.arange(H * N, dtype=np.int64) * n
        size = (H * N * n, H * N * n)
        return cls(
            Problem(
                problem.network,
                H,
                Quadratic(node.matrix),
                Quadratic(temporal.matrix),
                Quadratic(spatial.matrix),
            ),
            _couplings(problem, temporal, spatial),
            scatter(first, first, Q, size),
            scatter(first, first, np.asarray(np.linalg.inv(Q), dtype=np.float64), size),
        )

    @property
    def slice(self) -> int:
        """The numbers of one step, ``N n``."""
        return self.problem.N * self.problem.n

    @property
    def size(self) -> int:
        """The numbers of all steps, ``H N n``."""
        return int(self.node.shape[0])

    @cached_property
    def hessian(self) -> sparse.csr_array:
        """``M = Q + K``: ``cost(x) - OPT = |x - x*|_M^2 / 2``."""
        return sparse.csr_array(self.node + self.couplings)

    def gap(self, y: Floats) -> Floats:
        """Return ``D = Q^{-1} K y``."""
        found: Floats = self.inverse @ (self.couplings @ y)
        return found

    def optimum(self, y: Floats) -> float:
        """Return what the optimum ``x* = y`` costs."""
        pull = self.couplings @ y
        return 0.5 * float(pull @ (self.inverse @ pull) + y @ pull)

    def instance(self, y: Floats) -> Problem:
        """Return the problem whose optimum is ``x* = y``, from ``x_0 = 0``."""
        H, N, n = self.problem.H, self.problem.N, self.problem.n
        node = self.problem.node
        if not isinstance(node, Quadratic):
            raise TypeError(f"node costs: {node!r}")
        theta = (y + self.gap(y)).reshape(H, N, n)
        return replace(self.problem, node=Quadratic(node.matrix, theta))


def _couplings(problem: Problem, temporal: Quadratic, spatial: Quadratic) -> sparse.csr_array:
    """Return K: temporal costs couple (t, v) and (t - 1, v), spatial ones (t, u) and (t, w)."""
    H, N, n = problem.H, problem.N, problem.n
    steps, agents = np.arange(H), np.arange(N)
    now = (steps[:, None] * N + agents).ravel()
    u, w = problem.edges.T
    sides = [(steps[:, None] * N + end).ravel() for end in (u, w)]
    rows: list[Ints] = []
    columns: list[Ints] = []
    values: list[Floats] = []
    for cost, count, ends in (
        (temporal, N, (now, now - N)),
        (spatial, len(problem.edges), tuple(sides)),
    ):
        blocks = spread(cost.matrix, H, count).reshape(-1, 2, n, 2, n)
        for a in range(2):
            for b in range(2):
                inside = (ends[a] >= 0) & (ends[b] >= 0)  # the others hold x_0
                rows.append(ends[a][inside] * n)
                columns.append(ends[b][inside] * n)
                values.append(blocks[inside, a, :, b, :])
    size = (H * N * n,) * 2
    return scatter(np.concatenate(rows), np.concatenate(columns), np.concatenate(values), size)
