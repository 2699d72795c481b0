"""A problem whose surroundings are fixed: what the local and the global problems share."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ..graphs import InputError
from .arrays import Floats, Ints
from .problem import Problem
from .solve import Method, solve
from .solved import Solved
from .terms import Terms


@dataclass(frozen=True, eq=False)
class Window:
    """``argmin`` over free actions, given those before (y) and those on the boundary (z).

    Steps beyond the horizon H follow the paper's convention: their node costs are ``mu |x|^2 / 2``
    and there are no other costs and no constraints, so that free actions there are 0, and
    boundary values there, or next to no free action, have no effect.

    Parameters
    ----------
    problem : Problem
    terms : Terms
        Of the free actions within the horizon.
    free : ndarray, shape (m, 2)
        The free actions as (step, agent): the rows of an answer.
    bottom : ndarray, shape (b, 2)
        The actions before: the rows of y.
    boundary : ndarray, shape (q, 2)
        The other fixed actions: the rows of z.
    """

    problem: Problem
    terms: Terms
    free: Ints
    bottom: Ints
    boundary: Ints

    def solve(self, y: Floats, z: Floats, *, tolerance: float = 1e-11) -> Floats:
        """Return the free actions, shape (m, n), in the order of `free`.

        Parameters
        ----------
        y : array_like, shape (b, n)
            The actions of `bottom`.
        z : array_like, shape (q, n)
            The actions of `boundary`.
        tolerance : float
            The relative error aimed at; `solved` tells what was reached.

        Raises
        ------
        InputError
            If a shape is wrong or a value is not finite.
        """
        return self.ordered(self.solved(y, z, tolerance=tolerance).x)

    def solved(
        self, y: Floats, z: Floats, *, tolerance: float = 1e-11, method: Method = "auto"
    ) -> Solved:
        """Return the answer with its certificate; its rows are those of ``terms.free``."""
        return solve(self.terms, self.fixed(y, z), tolerance=tolerance, method=method)

    def ordered(self, x: Floats) -> Floats:
        """Return actions of ``terms.free`` in the order of `free`, with 0 beyond the horizon."""
        found = np.zeros((len(self.free), self.problem.n))
        inside = self.free[:, 0] <= self.problem.H
        found[inside] = x[_place(self.problem.N, self.terms.free, self.free[inside])]
        return found

    def fixed(self, y: Floats, z: Floats) -> Floats:
        """Return the values of ``terms.fixed``."""
        shapes = (("y", y, self.bottom), ("z", z, self.boundary))
        rows = [_checked(name, value, len(at), self.problem.n) for name, value, at in shapes]
        around = np.concatenate([self.bottom, self.boundary])
        return np.concatenate(rows)[self._known(around)]

    @property
    def hessian(self) -> sparse.csr_array:
        """The Hessian of quadratic costs in the free actions, shape (m n, m n).

        Beyond the horizon it is mu times the identity.
        """
        n = self.problem.n
        curvature = self.problem.node.curvature()
        mu = float((curvature.lower - curvature.error).min())
        pick = self._pick()
        beyond = np.repeat(self.free[:, 0] > self.problem.H, n)
        own = pick.T @ self._blocks()[0] @ pick
        found = own + sparse.dia_array((mu * beyond[None], [0]), shape=own.shape)
        return sparse.csr_array(found)

    @property
    def cross(self) -> sparse.csr_array:
        """The mixed second derivatives of quadratic costs, shape (m n, (b + q) n).

        Rows as in `hessian`, columns as y and then z; the answer moves by ``-hessian^-1 cross``.
        """
        n = self.problem.n
        around = np.concatenate([self.bottom, self.boundary])
        G = len(self.terms.fixed)
        entries = (np.ones(G), (self._known(around), np.arange(G)))
        columns = sparse.csr_array(entries, shape=(len(around), G))
        wide = sparse.kron(columns, sparse.eye_array(n), format="csr")
        return sparse.csr_array(self._pick().T @ self._blocks()[1] @ wide.T)

    def _known(self, around: Ints) -> Ints:
        """Return the rows of bottom and boundary that the terms ask for."""
        return _place(self.problem.N, around, self.terms.fixed[:, 1:], sort=True)

    def _pick(self) -> sparse.csr_array:
        """The matrix that takes answers, in the order of `free`, to rows of the terms."""
        N, n, F = self.problem.N, self.problem.n, len(self.terms.free)
        inside = np.flatnonzero(self.free[:, 0] <= self.problem.H)
        rows = _place(N, self.terms.free, self.free[inside])
        shape = (F, len(self.free))
        small = sparse.csr_array((np.ones(len(inside)), (rows, inside)), shape=shape)
        return sparse.csr_array(sparse.kron(small, sparse.eye_array(n), format="csr"))

    def _blocks(self) -> tuple[sparse.csr_array, sparse.csr_array]:
        if not self.problem.quadratic:
            raise InputError("hessian, cross: only the Hessian of quadratic costs is constant")
        n = self.problem.n
        return self.terms.hessian(
            np.zeros((len(self.terms.free), n)), np.zeros((len(self.terms.fixed), n))
        )


def _place(N: int, where: Ints, wanted: Ints, *, sort: bool = False) -> Ints:
    """Return the rows of `where` that hold the wanted (step, agent)."""
    keys = where[:, -2] * N + where[:, -1]
    order = np.argsort(keys) if sort else np.arange(len(keys))
    found: Ints = order[np.searchsorted(keys[order], wanted[:, -2] * N + wanted[:, -1])]
    return found


def _checked(name: str, value: Floats, count: int, n: int) -> Floats:
    try:
        found = np.asarray(value, dtype=np.float64)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name}: numbers are needed ({error})", name) from error
    if found.shape != (count, n):
        raise InputError(f"{name}: shape {found.shape} where ({count}, {n}) is needed", name)
    if not np.isfinite(found).all():
        raise InputError(f"{name}: a value is not finite", name)
    return found
