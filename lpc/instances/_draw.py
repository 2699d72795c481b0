"""What a style draws its costs from: sizes, constants, targets and a stream of random numbers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ...bounds.parameters import Parameters
from ...graphs import Network
from ..arrays import Floats
from ..costs import Cost, LogCosh, Quadratic


@dataclass(frozen=True, eq=False)
class Draw:
    """One instance in the making.

    Parameters
    ----------
    network : Network
    H, n : int
        Steps, and entries of one action.
    parameters : Parameters
        The constants mu, l_f, l_T, l_S, as floats.
    theta : ndarray, shape (H, N, n)
        The minimisers of the node costs.
    rng : numpy.random.Generator
        Where the costs are drawn from; the targets have a stream of their own.
    varying : bool
        Whether Hessians change with the step, and strengths from member to member.
    """

    network: Network
    H: int
    n: int
    parameters: Parameters
    theta: Floats
    rng: np.random.Generator
    varying: bool

    @property
    def T(self) -> int:
        """The steps over which Hessians differ: H if `varying`, else 1."""
        return self.H if self.varying else 1

    @property
    def mu(self) -> float:
        """Strong convexity of the node costs."""
        return float(self.parameters.mu)

    @property
    def l_f(self) -> float:
        """Smoothness of the node costs."""
        return float(self.parameters.l_f)

    def pairs(self) -> tuple[tuple[int, float], tuple[int, float]]:
        """Return members and smoothness of the temporal and of the spatial costs.

        Without edges the spatial costs are one member of smoothness 0.
        """
        edges = self.network.edges
        temporal = self.network.vertices, float(self.parameters.l_T)
        return temporal, (edges, float(self.parameters.l_S)) if edges else (1, 0.0)

    def strengths(self, members: int, l: float) -> Floats:  # noqa: E741 - the paper's letter
        """Return the smoothness of every pair cost, shape (T, members).

        All are l, unless `varying`: then uniform in [0, l], and l at one random place.
        """
        if not self.varying:
            return np.full((1, members), l)
        found = self.rng.uniform(0.0, l, (self.H, members))
        found.flat[self.rng.integers(found.size)] = l
        return found

    def curvatures(self) -> Floats:
        """Return eigenvalues of node matrices, shape (T, N, n), uniform in [mu, l_f].

        Two random places hold mu and l_f; if there is one place only, it holds mu.
        """
        shape = (self.T, self.network.vertices, self.n)
        found = self.rng.uniform(self.mu, self.l_f, shape)
        places = self.rng.permutation(found.size)[:2]
        found.flat[places[::-1]] = [self.l_f, self.mu][-len(places) :]
        return found

    def orthogonal(self, members: int, size: int) -> Floats:
        """Return random orthogonal matrices, shape (T, members, size, size)."""
        normal = self.rng.standard_normal((self.T, members, size, size))
        found: Floats = np.linalg.qr(normal)[0]
        return found

    def node(self, *, rotated: bool = False) -> Quadratic:
        """Return node costs ``(y - theta)' M (y - theta) / 2``, eigenvalues as in `curvatures`.

        M is diagonal unless `rotated`; it is ``mu I`` if ``l_f = mu``.
        """
        if self.l_f == self.mu:
            return Quadratic(self.mu * np.eye(self.n), self.theta)
        values = self.curvatures()
        if not rotated:
            return Quadratic(values[..., None] * np.eye(self.n), self.theta)
        Q = self.orthogonal(self.network.vertices, self.n)
        return Quadratic((Q * values[..., None, :]) @ Q.swapaxes(-1, -2), self.theta)

    def bent(self) -> Cost:
        """Return node costs ``mu |y - theta|^2 / 2 + sum_j (m_j - mu) log cosh(y_j - theta_j)``.

        The m are as in `curvatures`: the eigenvalue m_j at the target falls to mu far away. If
        ``l_f = mu`` the cost is quadratic.
        """
        if self.l_f == self.mu:
            return self.node()
        weights = np.broadcast_to(self.curvatures() - self.mu, self.theta.shape)
        return LogCosh(np.eye(self.n), self.theta, weights, self.mu, self.theta)

    def halves(self) -> Floats:
        """Return the directions ``(e_j, -e_j)/sqrt(2)`` of a pair, shape (n, 2 n)."""
        eye = np.sqrt(0.5) * np.eye(self.n)
        return np.concatenate([eye, -eye], axis=1)

    def difference(self, members: int, l: float, sign: float = -1.0) -> Quadratic:  # noqa: E741
        """Return pair costs ``(s/4) |y + sign z|^2``, ``s`` as in `strengths`: s-smooth.

        The Hessian ``(s/2) [[I, sign I], [sign I, I]]`` has the eigenvalues 0 and s.
        """
        pattern = np.kron([[0.5, 0.5 * sign], [0.5 * sign, 0.5]], np.eye(self.n))
        return Quadratic(self.strengths(members, l)[..., None, None] * pattern)
