"""The Hessian of a local problem as the proofs see it: steps, then agents, then entries."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import linalg, sparse
from scipy.sparse.csgraph import shortest_path

from ...graphs import InputError, Network
from ...lpc.arrays import Floats, Ints
from ...lpc.local import LocalProblem


@dataclass(frozen=True, eq=False)
class Hierarchy:
    r"""``M = D + A`` and the cross blocks R, K of a local problem at one point.

    With m agents in ``N_v^{r-1}`` and ``S = k - 1`` free steps, M has S x S blocks of m x m
    blocks of n x n numbers. D is its block diagonal in the first level, A the rest, and
    ``J = A D^{-1}``.

    Parameters
    ----------
    local : LocalProblem
        With something free, and no step beyond the horizon.
    x : ndarray, shape (S m, n)
        The point, in the order of ``local.terms.free``: by step, then by agent.
    fixed : ndarray, shape (G, n)
        The values of ``local.terms.fixed``.

    Raises
    ------
    InputError
        If nothing is free, or the window leaves the horizon.

    References
    ----------
    Paper, proof of ``thm:networked-exp-decay-tight``, steps 1 and 2.
    """

    local: LocalProblem
    x: Floats
    fixed: Floats

    def __post_init__(self) -> None:
        known, H = self.local.information, self.local.problem.H
        if not len(self.local.free):
            raise InputError(f"k = {known.k}, r = {known.r}: nothing is free; k >= 2, r >= 1")
        if known.t + known.k - 1 > H:
            raise InputError(f"t + k - 1 = {known.t + known.k - 1}: at most H = {H} is needed")

    @property
    def n(self) -> int:
        """Entries of one action."""
        return self.local.problem.n

    @property
    def S(self) -> int:
        """Free steps, ``k - 1``."""
        return self.local.information.k - 1

    @cached_property
    def agents(self) -> Ints:
        """The agents of ``N_v^{r-1}`` in increasing order, shape (m,)."""
        return np.sort(self.local.information.inner)

    @property
    def size(self) -> int:
        """Rows of one block of the first level, ``m n``."""
        return len(self.agents) * self.n

    @cached_property
    def _hessian(self) -> tuple[Floats, Floats]:
        M, C = self.local.terms.hessian(self.x, self.fixed)
        return M.toarray(), C.toarray()

    @property
    def M(self) -> Floats:
        """The Hessian in the free actions, shape (S m n, S m n)."""
        return self._hessian[0]

    @property
    def cross(self) -> Floats:
        """Minus the mixed derivatives: all columns of R and K, shape (S m n, G n)."""
        return -self._hessian[1]

    @cached_property
    def D(self) -> Floats:
        """The diagonal blocks, shape (S m n, S m n)."""
        step = np.arange(self.S * self.size) // self.size
        return np.where(step[:, None] == step, self.M, 0.0)

    @property
    def A(self) -> Floats:
        """``M - D``: what couples consecutive steps."""
        return self.M - self.D

    @cached_property
    def inverse_D(self) -> Floats:
        """``D^{-1}``, block by block."""
        blocks = (np.linalg.inv(self.slice(self.D, i, i)) for i in self.steps)
        found: Floats = linalg.block_diag(*blocks)
        return found

    @cached_property
    def J(self) -> Floats:
        """``A D^{-1}``."""
        return self.A @ self.inverse_D

    @property
    def steps(self) -> range:
        """The indices of the first level, from 0; the paper counts from 1."""
        return range(self.S)

    def slice(self, matrix: Floats, i: int, j: int) -> Floats:
        """Return block (i, j) of the first level, i and j from 0."""
        s = self.size
        return matrix[i * s : (i + 1) * s, j * s : (j + 1) * s]

    def norms(self, matrix: Floats) -> Floats:
        """Return the spectral norms of blocks (step, agent, step, agent), shape (S, m, S, m)."""
        m = len(self.agents)
        return block_norms(matrix, self.n).reshape(self.S, m, self.S, m)

    @cached_property
    def distance(self) -> Floats:
        """Distances in the network from the agents to all others, shape (m, N)."""
        return distances(self.local.problem.network)[self.agents]

    @property
    def inner_distance(self) -> Floats:
        """Distances in the network between the agents, shape (m, m)."""
        found: Floats = self.distance[:, self.agents]
        return found


def block_norms(matrix: Floats, n: int) -> Floats:
    """Return the spectral norms of the n x n blocks of a matrix."""
    rows, columns = matrix.shape[0] // n, matrix.shape[1] // n
    blocks = matrix.reshape(rows, n, columns, n).swapaxes(1, 2)
    found: Floats = np.linalg.norm(blocks, 2, axis=(2, 3))
    return found


def distances(network: Network) -> Floats:
    """Return all distances of a small network, infinite between components, shape (N, N)."""
    N = network.vertices
    ones = np.ones(len(network.indices))
    graph = sparse.csr_array((ones, network.indices, network.indptr), shape=(N, N))
    found: Floats = shortest_path(graph, directed=False, unweighted=True)
    return found
