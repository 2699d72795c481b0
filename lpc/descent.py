"""Accelerated projected gradient steps, many independent problems side by side."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from ..graphs import InputError
from .arrays import Floats, Ints
from .certify import EPS, Copies, certify
from .slope import Booleans, Slope
from .terms import Terms

Progress = Callable[[int, float], None]


@dataclass(frozen=True, eq=False)
class Descent:
    """Minimisers found by `descend`, with their certificates; C copies.

    Parameters
    ----------
    x : ndarray, shape (F, n)
        The actions; feasible.
    residual, error, gap : ndarray, shape (C,)
        See `Certificate`: ``|s|``, ``|x - x*| <= error`` and ``cost(x) - cost(x*) <= gap``.
    iterations : ndarray of int, shape (C,)
        Steps taken.
    converged : ndarray of bool, shape (C,)
        Whether a copy reached its tolerance, or the point where rounding allows no more; `error`
        tells how far that is. If false, it met its limit of steps.
    """

    x: Floats
    residual: Floats
    error: Floats
    gap: Floats
    iterations: Ints
    converged: Booleans


def descend(
    terms: Terms,
    fixed: Floats,
    start: Floats,
    *,
    tolerance: float = 1e-11,
    limit: int | None = None,
    progress: Progress | None = None,
) -> Descent:
    """Return ``argmin cost(x)`` over ``x_j in D_j``, each copy by itself.

    With ``diag(m) <= Hessian <= diag(d)`` and ``q = min_j m_j / d_j``, a step is::

        x+ = P(y - g(y) / d),   y+ = x+ + beta (x+ - x)

    where beta follows the scheme for strong convexity q in the metric of d, and begins anew when
    ``<y - x+, x+ - x>_d > 0``. A copy stops when ``2 |y - x+|_d / sqrt(q min m)``, a bound on
    ``|x+ - x*|``, is at most ``tolerance max(|x|, |g(start) / d|)``, or when rounding allows no
    further progress. What a copy returns depends, bit for bit, on nothing but its own data.

    Parameters
    ----------
    terms : Terms
        Its sets have projections.
    fixed : ndarray, shape (G, n)
        Values of ``terms.fixed``.
    start : ndarray, shape (F, n)
        Where to begin; need not be feasible.
    tolerance : float
        The relative error aimed at.
    limit : int, optional
        Most steps of a copy; ``200 + 100 / sqrt(q)`` if omitted.
    progress : callable, optional
        Called now and then with the steps taken and the fraction of copies that are done.

    Raises
    ------
    InputError
        If a set has no projection.

    References
    ----------
    Y. Nesterov, Lectures on Convex Optimization (2018), scheme (2.2.20).
    B. O'Donoghue, E. Candes, Adaptive restart for accelerated gradient schemes (2015).
    """
    if not terms.problem.feasible.projectable:
        kind = terms.problem.feasible.kind
        raise InputError(f"method = descent: {kind} sets have no projection; use barrier", "method")
    copies = Copies.of(terms)
    x = np.array(start, dtype=np.float64)
    iterations = np.zeros(len(copies.label), dtype=np.int64)
    converged = np.zeros(len(copies.label), dtype=bool)
    run, rows, which = _Run.of(terms, fixed, x, tolerance, limit), None, None
    while len(run.copies.label):
        finished = run.step()
        if finished.any():
            whole = np.arange(len(x)) if rows is None else rows
            labels = np.arange(len(iterations)) if which is None else which
            inside = finished[run.copies.row]
            x[whole[inside]] = run.x[inside]
            iterations[labels[finished]] = run.taken
            converged[labels[finished]] = run.good[finished]
            run.done |= finished
            if run.done.all():
                break
            if 2 * run.done[run.copies.row].sum() >= len(run.x):
                kept = ~run.done[run.copies.row]
                rows, which = whole[kept], labels[~run.done]
                run = run.narrowed(kept)
        if progress is not None and run.taken % 20 == 0:
            progress(run.taken, float(1 - (~run.done).sum() / max(len(iterations), 1)))
    found = certify(terms, fixed, x)
    return Descent(found.x, found.residual, found.error, found.gap, iterations, converged)


@dataclass(eq=False)
class _Run:
    """The state of the copies that are still at work."""

    terms: Terms
    slope: Slope
    copies: Copies
    q: Floats  # 1 / condition number, of every copy
    goal: Floats  # a copy stops when |y - x+|_d is at most goal times its size
    start_size: Floats  # |g(start) / d|
    limit: Floats
    x: Floats
    y: Floats
    alpha: Floats
    best: Floats  # the least |y - x+|_d so far, and when it was
    since: Floats
    done: Booleans
    good: Booleans
    taken: int = 0

    @classmethod
    def of(
        cls, terms: Terms, fixed: Floats, start: Floats, tolerance: float, limit: int | None
    ) -> _Run:
        """Return the state before the first step."""
        copies = Copies.of(terms)
        lower, upper = terms.scale
        q = np.minimum(copies.least(lower / upper), 1.0)
        x = terms.problem.feasible.project(terms.free[:, 1], terms.free[:, 2], start)
        slope = Slope.of(terms, fixed, x)
        first = np.sqrt(copies.total(_square(slope.at(x) / upper[:, None])))
        C = len(copies.label)
        return cls(
            terms,
            slope,
            copies,
            q,
            tolerance * np.sqrt(q * copies.least(lower)) / 2,
            first,
            200 + 100 / np.sqrt(q) if limit is None else np.full(C, float(limit)),
            x,
            x,
            np.ones(C),
            np.full(C, np.inf),
            np.zeros(C),
            np.zeros(C, dtype=bool),
            np.zeros(C, dtype=bool),
        )

    def step(self) -> Booleans:
        """Take one step; return which copies stop with it."""
        row, d = self.copies.row, self.terms.scale[1][:, None]
        t, v = self.terms.free[:, 1], self.terms.free[:, 2]
        if self.taken and self.taken % 32 == 0:
            self.slope = self.slope.moved(self.x)
        new = self.terms.problem.feasible.project(t, v, self.y - self.slope.at(self.y) / d)
        back, ahead = self.y - new, new - self.x
        moved = np.sqrt(self.copies.total(_square(back) * d[:, 0]))
        uphill = self.copies.total(np.einsum("ij,ij->i", back, ahead) * d[:, 0]) > 0
        square = self.alpha**2
        after = (self.q - square + np.sqrt((square - self.q) ** 2 + 4 * square)) / 2
        beta = np.where(uphill, 0.0, self.alpha * (1 - self.alpha) / (square + after))
        self.alpha = np.where(uphill, 1.0, after)
        self.x, self.y = new, new + beta[row][:, None] * ahead
        self.taken += 1
        return self._stopping(moved)

    def _stopping(self, moved: Floats) -> Booleans:
        size = np.maximum(np.sqrt(self.copies.total(_square(self.x))), self.start_size)
        reached = moved <= self.goal * size
        # rounding: no visible movement, or no smaller one for longer than the method oscillates
        better = moved < 0.9 * self.best
        self.best = np.where(better, moved, self.best)
        self.since = np.where(better, self.taken, self.since)
        stuck = self.taken - self.since > 30 + 4 / np.sqrt(self.q)
        depth = np.sqrt(self.copies.least(self.terms.scale[0])) * size
        self.good = reached | (stuck & (self.best <= 1e-10 * depth)) | (moved <= EPS / 8 * depth)
        stop: Booleans = self.good | (self.taken >= self.limit)
        return stop & ~self.done

    def narrowed(self, kept: Booleans) -> _Run:
        """Return the state without the copies that are done."""
        slope, left = self.slope.narrowed(kept), ~self.done
        return _Run(
            slope.terms,
            slope,
            Copies.of(slope.terms),
            self.q[left],
            self.goal[left],
            self.start_size[left],
            self.limit[left],
            self.x[kept],
            self.y[kept],
            self.alpha[left],
            self.best[left],
            self.since[left],
            self.done[left],
            self.good[left],
            self.taken,
        )


def _square(rows: Floats) -> Floats:
    found: Floats = np.einsum("ij,ij->i", rows, rows)
    return found
