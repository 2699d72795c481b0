"""Policies of the spatial instance as matrices, and realisations that show their price."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from ..graphs import InputError
from ..lpc.arrays import Floats
from .spatial import Spatial

DENSE = 3000  # agents up to which a policy is a dense matrix


def team_policy(spatial: Spatial) -> Floats:
    """Return the matrix K of the best policies ``x = K w`` of radius r, shape (N, N).

    Column j is ``-(M_SS)^{-1} e_j`` on the ball S of radius r around j, and 0 elsewhere.

    References
    ----------
    R. Radner, *Team decision problems*, Ann. Math. Statist. 33 (1962), Theorem 5.
    """
    N = _dense(spatial)
    K = np.zeros((N, N))
    for j, members in enumerate(spatial.seen(np.arange(N))):
        part, *_ = spatial.system.part(members)
        K[members, j] = -part.solve((members == j).astype(float))
    return K


def conditional_policy(spatial: Spatial) -> Floats:
    """Return the matrix of ``x_i = E[x*_i | w in the ball of i]``: -B, cut off at distance r.

    References
    ----------
    Paper, ``thm:spatial_lower_bound:e1``.
    """
    N = _dense(spatial)
    K = np.zeros((N, N))
    for j, members in enumerate(spatial.seen(np.arange(N))):
        column = np.zeros(N)
        column[j] = 1.0
        K[members, j] = -spatial.system.solve(column)[members]
    return K


def excess(spatial: Spatial, K: Floats, w: ArrayLike) -> tuple[float, float]:
    """Return what ``x = K w`` costs more than the optimum, and the optimum, both over mu/2.

    ``(x - x*)' M (x - x*)`` and ``|x* + w|^2 + (a_S/2) x*' L x*``, sums of squares.
    """
    w = np.asarray(w, dtype=float)
    system, best = spatial.system, spatial.optimum(w)
    off = (K @ w - best)[:, None]
    steps = best[system.ends[:, 0]] - best[system.ends[:, 1]]
    optimal = ((w + best) ** 2).sum() + (system.weight * steps**2).sum()
    return float(system.energy(off)[0]), float(optimal)


def realisation(spatial: Spatial, K: Floats, variances: ArrayLike = 1.0) -> Floats:
    r"""Return ``w``, ``w_j = +-sd_j``, at which the policy K pays at least its expected ratio.

    By conditional expectations: with ``rho = E[excess]/E[OPT]`` the quadratic form
    ``Q = (K+B)'M(K+B) - rho (I - B)`` has the mean ``sum_j Var_j Q_jj = 0``; signs are chosen one
    after the other so that the mean over those left does not fall. All w_j may come out equal:
    then the optimum costs nothing, and the ratio of a policy that pays is infinite.

    Parameters
    ----------
    spatial : Spatial
    K : ndarray, shape (N, N)
        A linear policy.
    variances : array_like, shape (N,) or a number
        Of the w_j.
    """
    N = _dense(spatial)
    sd = np.sqrt(np.broadcast_to(np.asarray(variances, dtype=float), (N,)))
    if not (np.isfinite(sd).all() and sd.any()):
        raise InputError("variances: finite numbers >= 0, not all 0, are needed", "variances")
    B = spatial.system.solve(np.eye(N))
    off = K + B
    more = off.T @ (spatial.system.matrix @ off)
    base = np.eye(N) - B
    base = (base + base.T) / 2
    mean = float(sd**2 @ np.diag(base))
    rho = float(sd**2 @ np.diag(more)) / mean if mean > 0 else 0.0
    Q = more - rho * base
    w = np.zeros(N)
    for j in range(N):
        w[j] = sd[j] if Q[j, :j] @ w[:j] >= 0 else -sd[j]
    return w


def _dense(spatial: Spatial) -> int:
    N = spatial.network.vertices
    if N > DENSE:
        raise InputError(f"{spatial.network.source}: {N} agents; at most {DENSE} for a matrix")
    return N
