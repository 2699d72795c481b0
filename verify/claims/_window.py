"""One step of LPC as a linear map of what it does not know and of where it starts."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from ...lpc.problem import Problem

Floats = Any


def step_map(problem: Problem, k: int, r: int) -> tuple[Floats, Floats]:
    """Return ``e_1`` of LPC as matrices of ``y = x_0 - x_0*`` and ``D = theta - x*``.

    ``e_1 = L (theta - x*_{|0}) = L (D - P y)``: L from the policy of the first step, P how the
    clairvoyant continuation follows the starting point. Shapes (N n, N n) and (N n, H N n).
    """
    from ...lowerbounds.deviation import Deviation
    from ...lowerbounds.energy import Energy

    energy = Energy.of(problem)
    size, total = energy.slice, energy.size
    L = np.zeros((size, total))
    steps = Deviation.of(energy.problem, k, r).steps
    if steps:
        ahead = steps[0].ahead.toarray()[:, :total]  # what lies past the horizon is known
        L[:, : ahead.shape[1]] = ahead
    else:
        L[:, :size] = np.eye(size)
    across = np.zeros((total, size))
    matrix = problem.temporal.matrix[0]  # type: ignore[attr-defined]  # quadratic, as drawn
    n = problem.n
    for v in range(problem.N):
        block = matrix[v if len(matrix) > 1 else 0]
        across[v * n : (v + 1) * n, v * n : (v + 1) * n] = block[:n, n:]
    P = -np.linalg.solve(energy.hessian.toarray(), across)
    return -L @ P, L


def largest(maps: tuple[Floats, Floats], history: float, weights: Floats) -> float:
    """Return ``max |e|^2`` over y, D with ``history |y|^2 + sum_tau weights_tau |D_tau|^2 <= 1``.

    Infinite if a weight is 0 and e depends on that part.
    """
    first, L = maps
    size = len(L)
    factors = np.concatenate([[history], weights])
    blocks = np.split(np.concatenate([first, L], axis=1), L.shape[1] // size + 1, axis=1)
    total = np.zeros((size, size))
    for factor, block in zip(factors, blocks, strict=True):
        if factor > 0:
            total += block @ block.T / factor
        elif np.abs(block).max() > 1e-12:
            return float("inf")
    return float(np.linalg.eigvalsh(total)[-1])
