"""Path following in the strength of a logarithmic barrier, with multipliers."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy import sparse

from .arrays import Floats, Ints
from .barrier import inner_start
from .certify import EPS, Copies, norms, rounding
from .linear import solve_copies
from .slope import Booleans
from .solved import Solved
from .terms import Terms

LIMIT = 300  # steps; the strength falls tenfold in most of them
PATIENCE = 25  # steps without progress before a copy gives up
TIRED = 9  # how many of them one counts at the least strength
SHARE = 0.1  # the next strength, as a part of the last
NEAR = 10.0  # how far products may be from the strength, as a factor, when it falls
WIDE = 100.0  # how far they may ever be
STAY = 0.99  # of a slack or a multiplier, the most that a step may take
TRIALS = 50  # of step sizes


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
    minimises the cost with a barrier of that strength. The step in x is a descent direction of
    that convex function B whatever the multipliers are, and is shortened until
    ``B'(a/2) + B'(a)``, along it, is negative enough: an upper sum of the decrease, which does not
    suffer from cancellation. All products ``-l_i g_i`` are kept within a factor `WIDE` of the
    strength, which falls after every long step that leaves them within `NEAR`. At any
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
    record, slow = np.full(C, np.inf), np.zeros(C)
    constraints = np.maximum(copies.total(state.there.sum(axis=1).astype(float)), 1.0)
    mean = copies.total((state.multiplier * state.slack).sum(axis=1)) / constraints
    target = np.maximum(mean, strength)
    for _ in range(LIMIT):
        gap = copies.total((state.multiplier * state.slack).sum(axis=1))
        wrong = copies.total(norms(state.residual) ** 2 / m)
        goal = 1e-3 * tolerance * (scale + copies.total(m * norms(state.x) ** 2))
        off, blur = -copies.least(-state.distance(strength)), state.blur(copies)
        close = (gap <= goal) if strength == 0 else (off <= 1e-11 * strength)
        good |= ~done & close & (wrong <= goal)
        done |= good
        stuck = ~done & (slow >= PATIENCE)
        hidden = rounding(terms, fixed, state.x) + state.noise
        floor = 100 * copies.total(hidden**2 / m)
        if stuck.any():  # at the floor of rounding, or for no good reason
            close = (gap <= goal + 2 * blur) if strength == 0 else (off <= 1e-6 * strength)
            good |= stuck & close & (wrong <= goal + floor)
        done |= stuck
        if done.all():
            break
        lowest = np.maximum(np.maximum(goal, blur) / (2 * constraints), strength)
        above = target > (1.5 * lowest if strength == 0 else lowest)
        state, size = _step(terms, fixed, copies, state, target, done)
        after = copies.total(norms(state.residual) ** 2 / m)
        if strength > 0:
            after += copies.least(-state.distance(strength)) ** 2
        long = (size >= 0.5) | (after <= floor)  # no step is long where all is rounding
        central = long & (state.spread(copies, target) <= NEAR)
        falls = (central | (size == 0)) & above
        target = np.where(falls, np.maximum(SHARE * target, lowest), target)
        better = falls | (after < 0.5 * record)
        record = np.where(falls, np.inf, np.where(better, after, record))
        slow = np.where(better, 0, slow + np.where(~above & (long | (size == 0)), TIRED, 1))
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

    @property
    def noise(self) -> Floats:
        """What rounding may do to the constraints' part of `residual`, shape (F,)."""
        steep = np.sqrt(np.einsum("mpj,mpj->mp", self.slope, self.slope))
        found: Floats = 4 * EPS * (self.multiplier * steep).sum(axis=1)
        return found

    def blur(self, copies: Copies) -> Floats:
        """By how much rounding may change ``sum_i -l_i g_i``, with a factor of 100, shape (C,)."""
        return copies.total(25 * norms(self.x) * self.noise)

    def distance(self, strength: float) -> Floats:
        """The largest ``|-l_i g_i - strength|`` of every action, shape (F,)."""
        central = np.where(self.there, np.abs(self.multiplier * self.slack - strength), 0.0)
        found: Floats = central.max(axis=1, initial=0.0)
        return found

    def spread(self, copies: Copies, strength: Floats) -> Floats:
        """The largest factor between a product ``-l_i g_i`` and the strength, shape (C,)."""
        ratio = self.multiplier * self.slack / strength[copies.row][:, None]
        with np.errstate(divide="ignore"):
            factor = np.where(self.there, np.maximum(ratio, 1 / ratio), 1.0)
        return -copies.least(-factor.max(axis=1, initial=1.0))


def _step(
    terms: Terms, fixed: Floats, copies: Copies, now: _State, strength: Floats, done: Booleans
) -> tuple[_State, Floats]:
    """Return the next state, and how much of the Newton step every copy took."""
    target = strength[copies.row][:, None]
    ratio = now.multiplier / now.slack
    own = np.einsum("mp,mpj,mpk->mjk", ratio, now.slope, now.slope)
    own += np.einsum("mp,mpjk->mjk", now.multiplier, now.bend)
    pull = np.where(now.there, target / now.slack, 0.0)
    right = now.gradient + np.einsum("mp,mpj->mj", pull, now.slope)
    matrix = sparse.csr_array(terms.hessian(now.x, fixed)[0] + _diagonal(own))
    dx = -solve_copies(copies, matrix, right, done)
    forward = np.einsum("mpj,mj->mp", now.slope, dx)
    with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
        room = np.where(forward > 0, now.slack / forward, np.inf).min(axis=1, initial=np.inf)
        size = np.minimum(1.0, STAY * copies.least(room))
        fall = copies.total(np.einsum("mj,mj->m", right, dx))
        settled = done | ~(fall < 0)
        taken = np.zeros(len(size))
        for _ in range(TRIALS):
            if settled.all():
                break
            a = np.where(settled, 0.0, size)[copies.row][:, None]
            far, inside = _ahead(terms, fixed, copies, now, now.x + a * dx, dx, target)
            half, _ = _ahead(terms, fixed, copies, now, now.x + a / 2 * dx, dx, target)
            fine = ~settled & inside & ((far <= 0) | (far + half <= 0.1 * fall))
            taken = np.where(fine, size, taken)
            settled |= fine
            size = np.where(settled, size, size / 2)
        dl = pull - now.multiplier + ratio * forward
        room = np.where(dl < 0, -now.multiplier / dl, np.inf).min(axis=1, initial=np.inf)
        dual = np.where(taken > 0, np.minimum(1.0, STAY * copies.least(room)), 0.0)
    after = _State.of(terms, fixed, now.x + taken[copies.row][:, None] * dx, now.multiplier)
    even = np.where(now.there, target / after.slack, 0.0)
    raised = now.multiplier + np.where(dual > 0, dual, 0.0)[copies.row][:, None] * np.where(
        np.isfinite(dl), dl, 0.0
    )
    moved = np.clip(raised, even / WIDE, even * WIDE)
    multiplier = np.where(done[copies.row][:, None], now.multiplier, moved)
    return replace(after, multiplier=multiplier), taken


def _ahead(
    terms: Terms, fixed: Floats, copies: Copies, now: _State, x: Floats, dx: Floats, target: Floats
) -> tuple[Floats, Booleans]:
    """Return the slope of the barrier function along dx at x, and whether x is well inside."""
    g, slope, _ = terms.problem.feasible.constraints(*_tv(terms), x)
    there = now.there & np.isfinite(g)
    ratio = np.where(now.there, -g / now.slack, 1.0)
    inside = copies.least(ratio.min(axis=1, initial=np.inf)) >= 1 - STAY
    pull = np.where(there, -target / np.where(g == 0, 1.0, g), 0.0)
    uphill = terms.gradient(x, fixed) + np.einsum("mp,mpj->mj", pull, slope)
    return copies.total(np.einsum("mj,mj->m", uphill, dx)), inside


def _certified(
    terms: Terms, fixed: Floats, copies: Copies, state: _State, taken: Floats, good: Booleans
) -> Solved:
    """Return the answer with its duality gap, and ``m |x - x*|^2 <= gap + |R| |x - x*|``."""
    m, wrong = terms.scale[0], norms(state.residual)
    gap = copies.total((state.multiplier * state.slack).sum(axis=1))
    hidden = rounding(terms, fixed, state.x) + state.noise
    square = copies.total((wrong + hidden) ** 2 / m)
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
