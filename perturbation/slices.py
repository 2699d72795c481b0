"""How a whole time slice follows another: the global perturbation bound, measured."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..bounds import Parameters
from ..bounds.decay import slice_decay
from ..bounds.global_bound import global_repaired, global_stated
from ..lpc.arrays import Floats
from ..lpc.global_problem import GlobalProblem
from ..lpc.problem import Problem
from .profile import ROUNDING
from .sensitivity import sensitivity

LARGEST = 1200  # free numbers of a global problem that is still measured


def slices(problem: Problem, p: int) -> Floats:
    """Return the largest norms of slice-by-slice sensitivities of ``psi~_1^p``, shape (p,).

    Entry d is the largest ``|d x_{t0} / d y|`` or ``|d x_{t0} / d z|`` with ``|t0 - tau| = d``,
    taken at zero boundary values; NaN where there is none (entry 0, and all of them if the
    problem is too large to be worth it).
    """
    found = np.full(p, np.nan)
    if problem.N * problem.n * (p - 1) > LARGEST or p < 2:
        return found
    window = GlobalProblem(problem, 1, p)
    y, z = (np.zeros((len(pairs), problem.n)) for pairs in (window.bottom, window.boundary))
    derivative = sensitivity(window, y, z).derivative
    size = problem.N * problem.n
    blocks = derivative.reshape(p - 1, size, 2, size)  # from x_0, and from x_p
    norms = np.linalg.norm(blocks.swapaxes(1, 2), 2, axis=(2, 3))
    for side, gaps in enumerate((np.arange(1, p), np.arange(p - 1, 0, -1))):
        for row, d in enumerate(gaps):
            found[d] = np.fmax(found[d], norms[row, side])
    return found


@dataclass(frozen=True)
class Slices:
    """The largest sensitivity of a slice to another, by distance, beside the promises.

    Parameters
    ----------
    distance : tuple of int
    measured_max : tuple of float
    bounds : dict
        For ``stated`` and ``repaired`` ``C_G rho_G^d``, for ``sharp`` the supremum ``s_d`` (E1),
        one number a distance.
    """

    distance: tuple[int, ...]
    measured_max: tuple[float, ...]
    bounds: dict[str, tuple[float, ...]]

    @classmethod
    def of(cls, rows: Floats, parameters: Parameters) -> Slices:
        """Return the profile of many instances, rows of `slices`."""
        largest = np.where(np.isnan(rows), -np.inf, rows).max(axis=0)
        d = np.flatnonzero(largest >= 0)
        a = parameters.a_T
        bounds: dict[str, tuple[float, ...]] = {}
        for tier, bound in (("stated", global_stated(a)), ("repaired", global_repaired(a))):
            bounds[tier] = tuple(float(v) for v in bound.C_G * bound.rho_G**d)
        bounds["sharp"] = tuple(float(v) for v in np.atleast_1d(slice_decay(a, d)))
        return cls(tuple(map(int, d)), tuple(float(v) for v in largest[d]), bounds)

    @property
    def violations(self) -> tuple[tuple[str, int], ...]:
        """Every (tier, distance) whose bound is exceeded by more than rounding explains."""
        return tuple(
            (tier, d)
            for tier, values in self.bounds.items()
            for d, bound, found in zip(self.distance, values, self.measured_max, strict=True)
            if found > bound * (1 + ROUNDING)
        )
