"""How much more one trajectory costs than another, without subtracting their costs."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from .arrays import Floats, Ints, at
from .certify import EPS
from .costs import Cost, Quadratic
from .problem import Problem

Member = tuple[Cost, Ints, Ints, Floats]
Longs = NDArray[np.longdouble]
LONG = float(np.finfo(np.longdouble).eps)  # that of doubles where there is nothing longer
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(10)
_NODES, _WEIGHTS = 0.5 * (_NODES + 1.0), 0.5 * _WEIGHTS  # of integrals over [0, 1]
CLOSE = 1e-4  # relative excess below which general costs are integrated, not subtracted
AGREE = 1e-10  # relative difference between 10 and 2 x 10 nodes
DEPTH = 40  # bisections


@dataclass(frozen=True)
class Measured:
    """A number, and a bound on its error.

    For quadratic costs the bound is proven, from the number of operations in long doubles and the
    sums of the absolute values of all products. The inner workings of other costs are not known:
    there it is an estimate, from 4 roundings of the value and of the argument.

    Parameters
    ----------
    value, error : float
    nothing : bool
        Whether all costs and all their gradients are exactly 0.
    """

    value: float
    error: float
    nothing: bool = False


def excess(problem: Problem, x: Floats, best: Floats) -> float:
    """Return ``cost(x) - cost(best)``, see `measured_excess`."""
    return measured_excess(problem, x, best).value


def measured_cost(problem: Problem, x: Floats) -> Measured:
    """Return the cost of a trajectory of shape (H, N, n), with a bound on its rounding."""
    total, wrong, size, count, nothing = np.longdouble(0), 0.0, 0.0, 0, True
    for cost, t, i, w in _members(problem, x):
        if isinstance(cost, Quadratic):
            off = _long(w) - at(cost.centre, t, i)
            moved, most = _products(cost, t, i, off, off)
            base = at(cost.offset, t, i)
            values = _long(0.5 * moved + base)
            error = _long(LONG * ((cost.size + 4) * most + np.abs(base)))
        else:
            values = _long(cost.value(t, i, w))
            felt = np.einsum("ij,ij->i", np.abs(cost.gradient(t, i, w)), np.abs(w))
            error = _long(4 * EPS * (np.abs(values) + felt))
        nothing &= not (values.any() or cost.gradient(t, i, w).any())
        total, wrong = total + values.sum(), wrong + float(error.sum())
        size, count = size + float(np.abs(values).sum()), count + len(t)
    wrong += LONG * (count + 1) * size + EPS * abs(float(total))
    return Measured(float(total), wrong, nothing)


def measured_excess(problem: Problem, x: Floats, best: Floats) -> Measured:
    """Return ``cost(x) - cost(best)``, accurate also where the two are nearly equal.

    For a quadratic with matrix P the difference is ``d'P(off + d/2)``, d the step from `best` and
    off its distance from the centre. For other costs it is the slope at `best` along d plus
    ``int_0^1 (1 - s) d' Hessian(best + s d) d ds``, by 10 Gauss nodes on intervals bisected until
    twice as many make no difference and the integral of ``d' Hessian d`` is that of the gradients
    at both ends, so that no sharp bend is overlooked; the plain difference where that is large.

    Parameters
    ----------
    problem : Problem
    x, best : ndarray, shape (H, N, n)
    """
    if not problem.quadratic:
        mine, base = measured_cost(problem, x), measured_cost(problem, best)
        plain = mine.value - base.value
        if abs(plain) > CLOSE * base.value:
            return Measured(plain, mine.error + base.error + EPS * abs(plain))
    total, wrong, size, count = np.longdouble(0), 0.0, 0.0, 0
    pairs = zip(_members(problem, best), _members(problem, x), strict=True)
    for (cost, t, i, w), (_, _, _, further) in pairs:
        d = _long(further) - w
        if isinstance(cost, Quadratic):
            off = _long(w) - at(cost.centre, t, i)
            values, most = _products(cost, t, i, d, off + 0.5 * d)
            error = LONG * (cost.size + 6) * _products(cost, t, i, d, np.abs(off) + np.abs(d))[1]
        else:
            step = d.astype(np.float64)
            slope, bend = cost.gradient(t, i, w), cost.hessian(t, i, w)
            felt = np.abs(slope) + np.einsum("ijk,ik->ij", np.abs(bend), np.abs(w))
            bent, doubt = _bend(cost, t, i, w, step)
            values = _long((slope * step).sum(axis=1) + bent)
            most = np.abs(slope * step).sum(axis=1) + bent
            error = 4 * EPS * ((felt * np.abs(step)).sum(axis=1) + most) + doubt
        total, wrong = total + values.sum(), wrong + float(error.sum())
        size, count = size + float(most.sum()), count + len(t)
    wrong += LONG * (count + 1) * size + EPS * abs(float(total))
    return Measured(float(total), wrong)


def _members(problem: Problem, x: Floats) -> Iterator[Member]:
    """Yield all costs with steps, members and arguments."""
    agents, edges = np.arange(problem.N), np.arange(len(problem.edges))
    before = problem.x_0
    for s, now in enumerate(x):
        t = np.full(problem.N, s + 1)
        ends = now[problem.edges].reshape(len(edges), 2 * problem.n)
        yield problem.node, t, agents, now
        yield problem.temporal, t, agents, np.concatenate([now, before], axis=1)
        if len(edges):
            yield problem.spatial, np.full(len(edges), s + 1), edges, ends
        before = now


def _long(values: Floats | Longs) -> Longs:
    return values.astype(np.longdouble)


def _products(cost: Quadratic, t: Ints, i: Ints, a: Longs, b: Longs) -> tuple[Longs, Longs]:
    """Return ``a'Pb`` and ``|a|'|P||b|`` in long doubles, shape (m,)."""
    P = np.broadcast_to(at(cost.matrix, t, i), (len(t), cost.size, cost.size))
    value = (a * (P * b[:, None, :]).sum(axis=2)).sum(axis=1)
    most = (np.abs(a) * (np.abs(P) * np.abs(b)[:, None, :]).sum(axis=2)).sum(axis=1)
    return value, most


def _bend(cost: Cost, t: Ints, i: Ints, w: Floats, d: Floats) -> tuple[Floats, Floats]:
    """Return the distances from the tangents at w, d further on, and their errors, shape (m,)."""
    found, doubt, row = np.zeros(len(t)), np.zeros(len(t)), np.arange(len(t))
    a, b = np.zeros(len(t)), np.ones(len(t))
    for level in range(DEPTH + 1):
        middle, tt, ii, ww, dd = 0.5 * (a + b), t[row], i[row], w[row], d[row]
        coarse, _ = _gauss(cost, tt, ii, ww, dd, a, b)
        halves = [_gauss(cost, tt, ii, ww, dd, *ends) for ends in ((a, middle), (middle, b))]
        fine, rise = (halves[0][j] + halves[1][j] for j in (0, 1))
        low, high = (cost.gradient(tt, ii, ww + s[:, None] * dd) for s in (a, b))
        known = ((high - low) * dd).sum(axis=1)
        blur = 16 * EPS * ((np.abs(high) + np.abs(low)) * np.abs(dd)).sum(axis=1)
        missed = (1 - a) * np.maximum(np.abs(known - rise) - blur, 0.0)
        off = np.abs(fine - coarse) + missed
        whole = np.bincount(row, np.abs(fine), minlength=len(t)) + found
        good = off <= AGREE * whole[row] + 1e-300
        kept = good if level < DEPTH else np.ones(len(row), dtype=bool)
        found += np.bincount(row[kept], fine[kept], minlength=len(t))
        doubt += np.bincount(row[kept], off[kept], minlength=len(t))
        if kept.all():
            break
        split = ~kept
        a, b = (np.concatenate([x[split], y[split]]) for x, y in ((a, middle), (middle, b)))
        row = np.concatenate([row[split], row[split]])
    return found, doubt


def _gauss(
    cost: Cost, t: Ints, i: Ints, w: Floats, d: Floats, a: Floats, b: Floats
) -> tuple[Floats, Floats]:
    """Return the integrals of ``(1 - s) q(s)`` and of q, ``q = d' Hessian(w + s d) d``."""
    bent, rise = np.zeros(len(t)), np.zeros(len(t))
    for node, weight in zip(_NODES, _WEIGHTS, strict=True):
        s = a + node * (b - a)
        q = np.einsum("ij,ijk,ik->i", d, cost.hessian(t, i, w + s[:, None] * d), d)
        bent += weight * (b - a) * (1 - s) * q
        rise += weight * (b - a) * q
    return bent, rise
