"""Right-hand sides of local quadratic problems, as a sparse matrix of the data."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from .arrays import Floats, Ints
from .blocks import Blocks
from .cohorts import Cohort
from .scatter import scatter


class Data:
    """The data of all local problems of one step, as one vector.

    The vector lists x_{t-1}, then for each step of the window the linear terms b and the node
    minimisers theta; each is (N, n), flattened. Past the horizon all are 0.

    Parameters
    ----------
    linear, theta : ndarray, shape (H, N, n)
    """

    def __init__(self, linear: Floats, theta: Floats) -> None:
        both = np.stack([linear, theta], axis=1)
        self._rows = np.concatenate([both, np.zeros_like(both[:1])])
        self.N, self.n = linear.shape[1:]

    def vector(self, t: int, m: int, before: Floats) -> Floats:
        """Return the data of the window of steps ``t..t+m`` after the actions `before`."""
        return np.concatenate([before.ravel(), self._rows[t - 1 : t + m].ravel()])

    def column(self, j: int, kind: int, v: Ints) -> Ints:
        """Return the first column of b (kind 0) or theta (kind 1) of agent v, j steps ahead."""
        found: Ints = ((1 + 2 * j + kind) * self.N + v) * self.n
        return found


def sides(cohort: Cohort, blocks: Blocks, data: Data, t: int, m: int) -> sparse.csr_array:
    """Return R with ``R vector`` the right-hand sides of the local problems of a cohort.

    The rows are the free actions by agent, step, member and entry, as in `Cohort.matrices`. For
    the free action (tau, u), with S, T the blocks of the Hessian, the side is::

        b_tau^u - [tau = t] T x_{t-1}^u - sum_w S theta_tau^w - [tau = t + m - 1] T' theta_{tau+1}^u

    where w runs over the neighbours at distance r.
    """
    A, b = cohort.ball.shape
    n, H = data.n, len(blocks.linear)
    a, i = (z.ravel() for z in np.indices((A, b)))
    u = cohort.ball.ravel()
    unit = np.broadcast_to(np.eye(n), (A * b, n, n))
    rows, columns, values = [], [], []

    def add(a: Ints, j: int, i: Ints, column: Ints, block: Floats) -> None:
        rows.append(((a * m + j) * b + i) * n)
        columns.append(column)
        values.append(block)

    for j in range(m):
        add(a, j, i, data.column(j, 0, u), unit)
        links = cohort.rim
        column = data.column(j, 1, links.other)
        add(links.a, j, links.i, column, -links.blocks(blocks.across(t + j)))
    add(a, 0, i, u * n, -blocks.back(t)[u])
    if t + m <= H:
        top = data.column(m, 1, u)
        add(a, m - 1, i, top, -blocks.back(t + m)[u].swapaxes(1, 2))
    shape = (A * m * b * n, (2 * m + 3) * data.N * n)
    return scatter(np.concatenate(rows), np.concatenate(columns), np.concatenate(values), shape)
