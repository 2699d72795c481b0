"""Which constraints bind at a solution, and the directions they leave free."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse
from scipy.optimize import nnls

from ..lpc.arrays import Floats
from ..lpc.terms import Terms

NEAR = 1e-6  # constraints closer than this, relative to their size, may bind


@dataclass(frozen=True, eq=False)
class Active:
    """The binding constraints of a solution x with their multipliers.

    At a solution ``gradient + sum_i l_i grad g_i(x) = 0`` with ``l_i >= 0`` and ``l_i = 0`` where
    ``g_i(x) < 0``. If every binding constraint has ``l_i > 0`` (strict complementarity) and the
    gradients of those of one action are independent, then x is differentiable in its data: it
    moves in the tangent space of the binding constraints, with the Hessian of the Lagrangian.

    Parameters
    ----------
    tangent : csr_array, shape (F n, m)
        An orthonormal basis of the directions left free.
    bend : csr_array, shape (F n, F n)
        ``sum_i l_i Hessian g_i``, block by block.
    binding : int
        How many constraints bind.
    smooth : bool
        Whether the conditions hold; if not, x has only one-sided derivatives, and what is computed
        is the derivative of the face with the positive multipliers.
    """

    tangent: sparse.csr_array
    bend: sparse.csr_array
    binding: int
    smooth: bool

    @classmethod
    def at(cls, terms: Terms, fixed: Floats, x: Floats) -> Active:
        """Return the binding constraints at the solution x, shape (F, n)."""
        F, n = x.shape
        t, v = terms.free[:, 1], terms.free[:, 2]
        unit = np.eye(n)
        if terms.problem.feasible.everywhere:
            none = sparse.csr_array((F * n, F * n))
            return cls(sparse.csr_array(sparse.eye_array(F * n)), none, 0, True)
        g, slope, bend = terms.problem.feasible.constraints(t, v, x)
        gradient = terms.gradient(x, fixed)
        size = 1.0 + np.abs(x).max(axis=1, initial=0.0)
        steep = np.sqrt(np.einsum("mpj,mpj->mp", slope, slope))
        close = np.isfinite(g) & (g >= -NEAR * size[:, None] * np.maximum(steep, NEAR))
        # a gradient that is rounding beside the forces that add up to it pulls nothing
        zero = 1e-7 * (1.0 + np.sqrt((gradient**2).sum(axis=1)).max(initial=0.0))
        basis, curved = [unit] * F, [np.zeros((n, n))] * F
        binding, smooth = 0, True
        for j in np.flatnonzero(close.any(axis=1)):
            here = np.flatnonzero(close[j])
            multiplier, rest = nnls(slope[j, here].T, -gradient[j])
            pulls = multiplier * steep[j, here] > zero
            smooth &= bool(pulls.all()) and rest <= 10 * zero
            here, multiplier = here[pulls], multiplier[pulls]
            if not len(here):
                continue
            binding += len(here)
            curved[j] = np.einsum("p,pij->ij", multiplier, bend[j, here])
            u, s, _ = np.linalg.svd(slope[j, here].T)
            rank = int((s > 1e-10 * s[0]).sum())
            smooth &= rank == len(here)
            basis[j] = u[:, rank:]
        tangent = sparse.csr_array(sparse.block_diag(basis, format="csr"))
        return cls(tangent, _diagonal(curved), binding, smooth)


def _diagonal(blocks: list[Floats]) -> sparse.csr_array:
    return sparse.csr_array(sparse.block_diag(blocks, format="csr"))
