"""Path following in the strength of a logarithmic barrier, with multipliers."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy import sparse

from .arrays import Floats, Ints
from .barrier import inner_start
from .certify import EPS, Copies, norms, rounding
from .linear import solve_copies
from .slope import Booleans
from .solved import Solved
from .terms import Terms

LIMIT = 100  # steps; the strength falls tenfold in most of them
PATIENCE = 8  # steps that hardly change the duality gap before a copy gives up
SHARE = 0.1  # the next strength, as a part of the mean of multiplier times slack


def follow(
    terms: Terms,
    fixed: Floats,
    start: Floats,
    *,
    tolerance: float = 1e-11,
    strength: float = 0.0,
) -> Solved:
    """Return ``argmin cost(x)`` with ``g_i(x_j) <= 0``, each copy by itself.

    Newton steps on ``g(x) + sum_i l_i g_i'(x) = 0``, ``-l_i g_i(x) = strength``, which say that x
    minimises the cost with a barrier of that strength, while the strength falls. At any
    strictly feasible x with multipliers ``l >= 0`` and ``R`` the gradient of the Lagrangian::

        cost(x) - cost(x*) <= sum_i -l_i g_i(x) + sum_j |R_j|^2 / (2 m_j),

    whose first part is p times the strength, p the number of constraints. That is the certificate;
    the true error is often the square of the one it implies.

    Parameters
    ----------
    terms : Terms
        Every set has an interior: ``g < 0`` somewhere (Slater's condition).
    fixed : ndarray, shape (G, n)
    start : ndarray, shape (F, n)
        A guess; moved to an interior point where it is none.
    tolerance : float
        A copy stops when its duality gap is ``tolerance / 1000`` times
        ``m (|x|^2 + |g(start) / d|^2)``, or no step makes progress any more.
    strength : float
        Where to stop on the path; at its end if 0.

    Raises
    ------
    InputError
        If a set has no interior.

    References
    ----------
    Paper, Appendix "Adding Constraints to Perturbation Bounds" (``apx:adding-constraints``).
    S. Boyd, L. Vandenberghe, Convex Optimization (2004), Algorithm 11.2.
    """
    copies = Copies.of(terms)
    state = _State.of(terms, fixed, inner_start(terms.problem.feasible, *_tv(terms), start))
    C, (m, d) = len(copies.label), terms.scale
    scale = copies.total(m * (norms(state.gradient) / d) ** 2)
    done, good, taken = np.zeros(C, dtype=bool), np.zeros(C, dtype=bool), np.zeros(C)
    before, slow = np.full(C, np.inf), np.zeros(C)
    constraints = np.maximum(copies.total(state.there.sum(axis=1).astype(float)), 1.0)
    for _ in range(LIMIT):
        gap = copies.total((state.multiplier * state.slack).sum(axis=1))
        wrong = copies.total(norms(state.residual) ** 2 / m)
        goal = 1e-3 * tolerance * (scale + copies.total(m * norms(state.x) ** 2))
        off = -copies.least(-state.distance(strength))
        close = (gap <= goal) if strength == 0 else (off <= 1e-11 * strength)
        good |= ~done & close & (wrong <= goal)
        done |= good
        if done.all():
            break
        target = np.maximum(SHARE * gap / constraints, strength)
        state, moved = _step(terms, fixed, copies, state, target, done)
        slow = np.where(gap <= 0.9 * before, 0, slow + 1)
        before = gap
        stuck = ~done & (~moved | ((strength == 0) & (slow >= PATIENCE)))
        if stuck.any():  # at the floor of rounding, or for no good reason
            floor = 100 * copies.total(rounding(terms, fixed, state.x) ** 2 / m)
            close = (
                (gap <= goal + state.blur(copies)) if strength == 0 else (off <= 1e-6 * strength)
            )
            good |= stuck & close & (wrong <= goal + floor)
        done |= stuck
        taken += ~done
    return _certified(terms, fixed, copies, state, taken, good)


@dataclass(frozen=True, eq=False)
class _State:
    """A strictly feasible point, its multipliers, and what is needed of the functions there."""

    x: Floats
    multiplier: Floats  # (F, p), 0 for a constraint that is not there
    slack: Floats  # (F, p), 1 for a constraint that is not there
    slope: Floats  # (F, p, n)
    bend: Floats  # (F, p, n, n)
    gradient: Floats  # (F, n)
    there: Booleans  # (F, p)

    @classmethod
    def of(cls, terms: Terms, fixed: Floats, x: Floats, multiplier: Floats | None = None) -> _State:
        """Return the state at x; multipliers that make all products equal if omitted."""
        g, slope, bend = terms.problem.feasible.constraints(*_tv(terms), x)
        there = np.isfinite(g)
        slack = np.where(there, -g, 1.0)
        gradient = terms.gradient(x, fixed)
        if multiplier is None:
            width = norms(gradient)[:, None] * norms(gradient)[:, None] / terms.scale[0][:, None]
            multiplier = np.where(there, np.where(width > 0, width, 1.0) / slack, 0.0)
        return cls(x, multiplier, slack, slope, bend, gradient, there)

    @property
    def residual(self) -> Floats:
        """The gradient of the Lagrangian, shape (F, n)."""
        found: Floats = self.gradient + np.einsum("mp,mpj->mj", self.multiplier, self.slope)
        return found

    def blur(self, copies: Copies) -> Floats:
        """By how much rounding may change ``sum_i -l_i g_i``, with a factor of 100, shape (C,)."""
        steep = np.sqrt(np.einsum("mpj,mpj->mp", self.slope, self.slope))
        return copies.total(100 * EPS * norms(self.x) * (self.multiplier * steep).sum(axis=1))

    def distance(self, strength: float) -> Floats:
        """The largest ``|-l_i g_i - strength|`` of every action, shape (F,)."""
        central = np.where(self.there, np.abs(self.multiplier * self.slack - strength), 0.0)
        found: Floats = central.max(axis=1, initial=0.0)
        return found

    def merit(self, copies: Copies, strength: Floats) -> Floats:
        """Return the squared norm of all equations' residuals, shape (C,)."""
        central = np.where(self.there, self.multiplier * self.slack - strength, 0.0)
        rows = norms(self.residual) ** 2 + norms(central) ** 2
        return copies.total(rows)


def _step(
    terms: Terms, fixed: Floats, copies: Copies, now: _State, strength: Floats, done: Booleans
) -> tuple[_State, Booleans]:
    """Return the next state, and which copies moved."""
    target = strength[copies.row][:, None]
    ratio = now.multiplier / now.slack
    own = np.einsum("mp,mpj,mpk->mjk", ratio, now.slope, now.slope)
    own += np.einsum("mp,mpjk->mjk", now.multiplier, now.bend)
    pull = np.where(now.there, target / now.slack, 0.0)
    right = now.gradient + np.einsum("mp,mpj->mj", pull, now.slope)
    matrix = terms.hessian(now.x, fixed)[0] + _diagonal(own)
    dx = -solve_copies(copies, sparse.csr_array(matrix), right)
    dl = pull - now.multiplier + ratio * np.einsum("mpj,mj->mp", now.slope, dx)
    with np.errstate(divide="ignore", invalid="ignore"):
        room = np.where(dl < 0, -now.multiplier / dl, np.inf).min(axis=1, initial=np.inf)
    size = np.minimum(1.0, 0.99 * copies.least(room))
    merit, settled = now.merit(copies, target), done.copy()
    for _ in range(40):
        a = np.where(done, 0.0, size)[copies.row][:, None]
        x = now.x + a * dx
        inside = copies.least(_depth(terms, x)) > 0
        trial = _State.of(terms, fixed, x, now.multiplier + a * dl)
        settled |= inside & (trial.merit(copies, target) <= (1 - 0.01 * size) ** 2 * merit)
        if settled.all():
            break
        size = np.where(settled, size, size / 2)
    a = np.where(done | ~settled, 0.0, size)[copies.row][:, None]
    return _State.of(terms, fixed, now.x + a * dx, now.multiplier + a * dl), settled


def _depth(terms: Terms, x: Floats) -> Floats:
    """Return the least slack of every action, shape (F,)."""
    g = terms.problem.feasible.constraints(*_tv(terms), x)[0]
    found: Floats = (-g).min(axis=1, initial=np.inf)
    return found


def _certified(
    terms: Terms, fixed: Floats, copies: Copies, state: _State, taken: Floats, good: Booleans
) -> Solved:
    """Return the answer with its duality gap, and ``m |x - x*|^2 <= gap + |R| |x - x*|``."""
    m, wrong = terms.scale[0], norms(state.residual)
    gap = copies.total((state.multiplier * state.slack).sum(axis=1))
    square = copies.total((wrong + rounding(terms, fixed, state.x)) ** 2 / m)
    error = (np.sqrt(square) + np.sqrt(square + 4 * gap)) / 2 / np.sqrt(copies.least(m))
    residual = np.sqrt(copies.total(wrong**2))
    steps = taken.astype(np.int64)
    return Solved(state.x, residual, error, gap + square / 2, steps, good, "barrier")


def _diagonal(blocks: Floats) -> sparse.csr_array:
    """Return the matrix with the given blocks, shape (F, n, n), on its diagonal."""
    F, n = blocks.shape[:2]
    columns = np.broadcast_to(np.arange(F * n).reshape(F, 1, n), blocks.shape)
    pointer = np.arange(F * n + 1) * n
    return sparse.csr_array((blocks.ravel(), columns.ravel(), pointer), shape=(F * n, F * n))


def _tv(terms: Terms) -> tuple[Ints, Ints]:
    return terms.free[:, 1], terms.free[:, 2]
