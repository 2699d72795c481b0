"""General convex sets ``{y : g_j(y) <= 0 for all j}``, known by their constraints alone."""

from __future__ import annotations

from abc import abstractmethod
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from ...graphs import InputError
from ..arrays import Floats, Ints
from .feasible import FeasibleSet
from .phase_one import deepest

SAMPLES = 256
SLACK = 1e-9  # relative, of eigenvalues and of constraints


class Convex(FeasibleSet):
    """A set of which only constraints and their derivatives are known.

    A subclass gives `constraints`, `size` (n), `name`, and `constant`: whether the sets are the
    same at all steps, and for all agents.
    """

    projectable = False

    @property
    @abstractmethod
    def size(self) -> int:
        """The number of entries of y."""

    @property
    @abstractmethod
    def constant(self) -> tuple[bool, bool]:
        """Whether the sets do not change with the step, and not with the agent."""

    @abstractmethod
    def name(self, j: int) -> str:
        """What constraint j is, for messages."""

    def violation(self, t: Ints, v: Ints, y: Floats) -> Floats:
        """Return the largest constraint, shape (m,)."""
        found: Floats = self.constraints(t, v, y)[0].max(axis=1, initial=-np.inf)
        return found

    def interior(self, t: Ints, v: Ints) -> Floats:
        """Return points with ``g < 0``, found by minimising the largest constraint, (m, n).

        Raises
        ------
        InputError
            Where no point with ``g < 0`` was found. The set may have an interior nevertheless:
            ``max(|y| - 1, 0)^3 <= 0`` has, but no point where the constraint is negative.
        """
        y, top = self._deep(t, v)
        bad = np.flatnonzero(~(top < 0))
        if len(bad):
            j = bad[0]
            raise InputError(
                f"feasible set at step {t[j]}, agent {v[j]}: no point with all g < 0 was found, "
                f"the least of the largest g is {top[j]:g}; constraints need a strictly "
                "feasible point"
            )
        return y

    def check(self, H: int, N: int, n: int) -> None:
        """Raise `InputError` unless sizes fit, constraints look convex, and no set is empty."""
        if self.size != n:
            raise InputError(f"feasible set: constraints on {self.size} entries, not n = {n}")
        steps = np.arange(1, 2 if self.constant[0] else H + 1)
        agents = np.arange(1 if self.constant[1] else N)
        t, v = (x.ravel() for x in np.meshgrid(steps, agents, indexing="ij"))
        self._shapes(t[:1], v[:1])
        y, top = self._deep(t, v)
        self._sample(t, v, y)
        size = np.abs(self.constraints(t, v, np.zeros_like(y))[0]).max(axis=1, initial=0.0)
        bad = np.flatnonzero(~(top <= SLACK * (1 + size)))
        if len(bad):
            j = bad[0]
            raise InputError(
                f"feasible set at step {t[j]}, agent {v[j]}: it is empty, the least of the "
                f"largest constraint is {top[j]:g}"
            )

    @cached_property
    def _known(self) -> dict[tuple[int, int], tuple[Floats, float]]:
        """What was found before, by step and agent."""
        return {}

    def _deep(self, t: Ints, v: Ints) -> tuple[Floats, Floats]:
        """Return points with the largest constraint near its minimum, and that; cached."""
        same_t, same_v = self.constant
        step, agent = (1 if same_t else t), (0 if same_v else v)
        pairs = np.stack(np.broadcast_arrays(step, agent, t)[:2], axis=1)
        keys, where = np.unique(pairs, axis=0, return_inverse=True)
        names = [(int(a), int(b)) for a, b in keys]
        new = np.array([name for name in names if name not in self._known], dtype=np.int64)
        if len(new):
            t_new, v_new = new.T
            found = deepest(lambda y: self.constraints(t_new, v_new, y), len(new), self.size)
            for name, y, top in zip(new, *found, strict=True):
                self._known[int(name[0]), int(name[1])] = (y, float(top))
        points = np.array([self._known[name][0] for name in names]).reshape(-1, self.size)
        tops = np.array([self._known[name][1] for name in names])
        return points[where.ravel()], tops[where.ravel()]

    def _shapes(self, t: Ints, v: Ints) -> None:
        n = self.size
        g, slope, bend = self.constraints(t, v, np.zeros((len(t), n)))
        p = g.shape[-1]
        shapes = (np.shape(g), np.shape(slope), np.shape(bend))
        m = len(t)
        if shapes != ((m, p), (m, p, n), (m, p, n, n)):
            raise InputError(
                f"feasible set: constraints of shapes {shapes} at {m} point(s); "
                f"({m}, p), ({m}, p, {n}) and ({m}, p, {n}, {n}) are needed"
            )

    def _sample(self, t: Ints, v: Ints, inside: Floats) -> None:
        """Look for a point where a constraint is not convex, or not finite."""
        rng = np.random.default_rng(0)
        row = rng.integers(0, len(t), SAMPLES)
        y = rng.standard_normal((SAMPLES, self.size)) * 10 ** rng.uniform(-3, 3, (SAMPLES, 1))
        y[::2] += inside[row[::2]]
        with np.errstate(all="ignore"):
            g, slope, bend = self.constraints(t[row], v[row], y)
        finite = np.logical_and(np.isfinite(slope).all(axis=2), np.isfinite(bend).all(axis=(2, 3)))
        values = np.linalg.eigvalsh(np.where(finite[:, :, None, None], bend, 0.0))
        limit = SLACK * np.abs(values).max(axis=2, initial=0.0)
        huge = np.asarray(g == np.inf)  # exp(1000) is just too large
        broken = np.asarray(~(finite | huge) | np.isnan(g))
        bent = np.asarray(values.min(axis=2, initial=0.0) < -limit)
        flaws: list[tuple[NDArray[np.bool_], str]] = [
            (broken, "not a number, or has no finite derivatives,"),
            (bent, "not convex"),
        ]
        for bad, what in flaws:
            if bad.any():
                m, j = np.argwhere(bad)[0]
                point = np.array2string(y[m], precision=6, max_line_width=10**6, threshold=12)
                raise InputError(
                    f"feasible set at step {t[row[m]]}, agent {v[row[m]]}: {self.name(int(j))} is "
                    f"{what} at y = {point} (Hessian eigenvalue {values[m, j].min():g})"
                )
