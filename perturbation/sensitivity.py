"""How a solution follows what is held fixed around it, exactly."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from scipy import linalg, sparse
from scipy.sparse.linalg import splu

from ..graphs import InputError
from ..lpc.arrays import Floats, Ints
from ..lpc.window import Window
from .active import Active

DENSE = 1500  # unknowns up to which the Hessian is factorised densely
PARTS = ("top", "bottom", "lateral")


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """The derivative of a local or global problem's solution in its boundary.

    With M the Hessian of the objective in the free actions (of the Lagrangian, on the directions
    that binding constraints leave) and C its mixed block with the fixed ones, both at the
    solution: ``derivative = -M^{-1} C``. For quadratic costs without constraints this is the
    answer to finite perturbations, too.

    Parameters
    ----------
    window : Window
        A `LocalProblem` or a `GlobalProblem`.
    x : ndarray, shape (F, n)
        The solution, the free actions within the horizon in the order of ``window.terms.free``.
    derivative : ndarray, shape (F, n, G, n)
        Columns in the order of ``window.terms.fixed``: the fixed actions that touch a free one.
        The others have no effect.
    binding : int
        How many constraints bind.
    smooth : bool
        Whether the solution is differentiable there, see `Active`.

    References
    ----------
    Paper, Lemma A.1 (``le:foc``); Fiacco (1983), Introduction to Sensitivity and Stability
    Analysis, Theorem 3.2.2.
    """

    window: Window
    x: Floats
    derivative: Floats
    binding: int
    smooth: bool

    @property
    def free(self) -> Ints:
        """The rows as (step, agent), shape (F, 2)."""
        return self.window.terms.free[:, 1:]

    @property
    def fixed(self) -> Ints:
        """The columns as (step, agent), shape (G, 2)."""
        return self.window.terms.fixed[:, 1:]

    @cached_property
    def norms(self) -> Floats:
        """The spectral norm of every block, shape (F, G)."""
        blocks = self.derivative.swapaxes(1, 2)
        if blocks.shape[2] == 1:
            return np.abs(blocks[:, :, 0, 0])
        found: Floats = np.linalg.norm(blocks, 2, axis=(2, 3))
        return found

    @cached_property
    def part(self) -> Ints:
        """For every column its position in `PARTS`, shape (G,)."""
        steps = self.fixed[:, 0]
        first, last = self.free[:, 0].min(), self.free[:, 0].max()
        found: Ints = np.where(steps > last, 0, np.where(steps < first, 1, 2))
        return found

    @property
    def time_gaps(self) -> Ints:
        """``|t0 - tau|`` of every entry, shape (F, G)."""
        found: Ints = np.abs(self.free[:, :1] - self.fixed[:, 0])
        return found


def sensitivity(window: Window, y: Floats, z: Floats, *, tolerance: float = 1e-12) -> Sensitivity:
    """Return the sensitivities of a window at the boundary values y (before) and z (around).

    Parameters
    ----------
    window : Window
        With at least one free action within the horizon.
    y, z : array_like, shapes (b, n) and (q, n)
        As for `Window.solve`.
    tolerance : float
        Of the solution, where it has to be iterated.

    Raises
    ------
    InputError
        If nothing is free, or a shape is wrong.
    NearsightError
        If the problem could not be solved.
    """
    terms, n = window.terms, window.problem.n
    F, G = len(terms.free), len(terms.fixed)
    if not F:
        raise InputError("nothing is free within the horizon: there is no sensitivity")
    fixed = window.fixed(y, z)
    x = window.solved(y, z, tolerance=tolerance).x
    M, C = terms.hessian(x, fixed)
    active = Active.at(terms, fixed, x)
    if not active.binding:
        moved = solve_refined(M, -C.toarray())
    else:
        Z = active.tangent
        reduced = Z.T @ (M + active.bend) @ Z
        moved = Z @ solve_refined(sparse.csr_array(reduced), -(Z.T @ C).toarray())
    return Sensitivity(window, x, moved.reshape(F, n, G, n), active.binding, active.smooth)


def solve_refined(M: sparse.csr_array, right: Floats) -> Floats:
    """Return ``M^{-1} right`` for a symmetric positive definite M, refined once.

    One step of refinement makes the error componentwise small [Skeel 1980]: entries that decay
    over many orders of magnitude keep their relative accuracy.
    """
    if M.shape[0] == 0:
        return np.zeros((0, right.shape[1]))
    if M.shape[0] <= DENSE:
        dense = M.toarray()
        factor = linalg.cho_factor(dense)
        found: Floats = linalg.cho_solve(factor, right)
        found += linalg.cho_solve(factor, right - dense @ found)
        return found
    lu = splu(sparse.csc_array(M))
    found = lu.solve(right)
    return np.asarray(found + lu.solve(right - M @ found))
