"""How much more one trajectory costs than another, without subtracting their costs."""

from __future__ import annotations

import numpy as np

from .arrays import Floats, Ints
from .costs import Cost, Quadratic
from .problem import Problem

# nodes and weights of the integral of (1 - s) f(s) over [0, 1]
_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(10)
_NODES = 0.5 * (_NODES + 1.0)
_WEIGHTS = 0.5 * _WEIGHTS * (1.0 - _NODES)
CLOSE = 1e-4  # relative excess below which general costs are integrated, not subtracted


def excess(problem: Problem, x: Floats, best: Floats) -> float:
    """Return ``cost(x) - cost(best)``, accurate also where the two are nearly equal.

    The difference is ``<gradient at best, x - best>`` plus, for every cost, its distance from the
    tangent at `best`: ``d'Pd/2`` for a quadratic with matrix P. For other costs this is
    ``int_0^1 (1 - s) d' Hessian(best + s d) d ds``, by 10 Gauss nodes, where x is close enough to
    `best` for that to be exact to rounding; the plain difference elsewhere.

    Parameters
    ----------
    problem : Problem
    x, best : ndarray, shape (H, N, n)
    """
    if not problem.quadratic:
        plain = problem.cost(x) - (base := problem.cost(best))
        if abs(plain) > CLOSE * base:
            return plain
    total, slope = 0.0, 0.0
    agents, edges = np.arange(problem.N), np.arange(len(problem.edges))
    before, best_before = problem.x_0, problem.x_0
    for s in range(problem.H):
        now, now_best = x[s], best[s]
        families = (
            (problem.node, agents, now_best, now),
            (
                problem.temporal,
                agents,
                np.concatenate([now_best, best_before], axis=1),
                np.concatenate([now, before], axis=1),
            ),
            (
                problem.spatial,
                edges,
                now_best[problem.edges].reshape(len(edges), 2 * problem.n),
                now[problem.edges].reshape(len(edges), 2 * problem.n),
            ),
        )
        for cost, members, base_w, w in families:
            t = np.full(len(members), s + 1)
            slope += float((cost.gradient(t, members, base_w) * (w - base_w)).sum())
            total += _bend(cost, t, members, base_w, w - base_w)
        before, best_before = now, now_best
    return total + slope


def _bend(cost: Cost, t: Ints, i: Ints, w: Floats, d: Floats) -> float:
    """Return the sum of the distances from the tangents at w, d further on."""
    if isinstance(cost, Quadratic):
        return 0.5 * float(np.einsum("ij,ijk,ik->", d, cost.hessian(t, i, w), d))
    found = 0.0
    for node, weight in zip(_NODES, _WEIGHTS, strict=True):
        found += weight * float(np.einsum("ij,ijk,ik->", d, cost.hessian(t, i, w + node * d), d))
    return found
