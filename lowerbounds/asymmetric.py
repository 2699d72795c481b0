r"""A larger temporal lower bound: couplings that weigh the two steps differently."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..bounds.arithmetic import Number, geometric_sum, power, sqrt
from ..bounds.decay import gamma_T
from ..bounds.formula import formula
from ..graphs import InputError, Network, parse_graph
from ..lpc import Problem, Quadratic
from ..lpc.arrays import Floats


@formula(counts=("k",))
def asymmetric_excess(a_T: Number, k: Any) -> Number:
    r"""Return the lower bound on ``CR - 1`` of `Asymmetric` in closed form: a for ``k = 1``, else

    .. math:: \frac{a\,(1+2a)\,\gamma^{2n}\,pq/(1+q)}{A A'}, \qquad n = k - 2,

    with ``p = a P``, ``q = a - p``, P of `first_share`, ``phi = (1+s)/2``, ``psi = (s-1)/2``,
    ``s = sqrt(1+2a)``, ``b = a/2`` and

    .. math:: A = \frac{1+a}{1+q} (\phi + \psi\gamma^{2n}) + b (1-\gamma^{2n}), \quad
        A' = (1+p) [\phi + \psi\gamma^{2n} + a (1-\gamma^{2n})] + b (1-\gamma^{2n})
            + a (\psi + \phi\gamma^{2n}) .

    The elimination of symmetric couplings, ``F -> 1 + b F/(F+b)``, has the fixed points phi and
    -psi and contracts by ``gamma_T^2``. The rate is that of LPC, ``gamma_T^{2k}``; for weak
    couplings it is twice `bounds.lower.final_excess`, for strong ones many times.
    """
    if np.ndim(k) == 0 and int(k) == 1:
        return 1 * a_T
    n = np.asarray(k) - 2
    gamma, s = gamma_T(a_T), sqrt(1 + 2 * a_T)
    p = a_T * first_share(a_T)
    q = p * sqrt((1 + 2 * a_T) / (1 + a_T))
    phi, psi, b = (1 + s) / 2, a_T / (s + 1), a_T / 2
    squared = power(gamma, 2)
    tail = power(squared, n)
    # 1 - gamma^{2n}, 1 - gamma = 2/(s + 1)
    rest = 2 / (s + 1) * (1 + gamma) * geometric_sum(1 + 0 * squared, squared, n)
    near = phi + psi * tail
    free = (1 + a_T) / (1 + q) * near + b * rest
    held = (1 + p) * (near + a_T * rest) + b * rest + a_T * (psi + phi * tail)
    return a_T * (1 + 2 * a_T) * tail * p * q / ((1 + q) * free * held)


@formula()
def first_share(a_T: Number) -> Number:
    r"""Return ``1/(1 + sqrt((1+2a)/(1+a)))``, the best share of the first coupling.

    For ``k = 2`` the maximiser of ``((1+a)^2 - a p)(1+p)/(1+a+p)``, by differentiation; for more
    steps, with 1/2 for all other couplings, the best that a search finds.
    """
    return 1 / (1 + sqrt((1 + 2 * a_T) / (1 + a_T)))


@dataclass(frozen=True)
class Asymmetric:
    r"""One agent, ``H = k + 1`` steps, one random number w in the last temporal cost.

    With ``p_t = sqrt(a P_t)``, ``q_t = sqrt(a (1 - P_t))``, all over ``mu/2``: the node costs are
    ``x_t^2``, ``c_1 = 0``, ``c_t = (p_t x_t - q_t x_{t-1})^2`` for ``2 <= t <= k``, and
    ``c_{k+1} = a (x_k - w)^2``. Each c is convex and exactly ``l_T``-smooth. An algorithm that
    sees k steps learns w at step 2, so ``x_1`` does not depend on it. Eliminating
    ``x_1, ..., x_{k-1}``, the rest pulls at ``x_k`` with strength D if ``x_1`` is free (the
    optimum) and ``D' > D`` if it is not, and for w of mean zero, whatever the algorithm,

    .. math:: CR \ge \frac{1 + a/D}{1 + a/D'}, \qquad CR - 1 = \frac{a (D' - D)}{D (D' + a)} .

    For ``k = 1``: ``x_1`` itself is blind, ``D' = infinity``, and ``CR >= 1 + a``.

    Parameters
    ----------
    a_T : float
        ``a = l_T/mu >= 0``.
    shares : tuple of float, length k - 1
        ``P_2, ..., P_k``, each in [0, 1]: any give a valid bound, see `asymmetric`.

    Raises
    ------
    InputError
        If a parameter is out of range.
    """

    a_T: float
    shares: tuple[float, ...]

    def __post_init__(self) -> None:
        if not (np.isfinite(self.a_T) and self.a_T >= 0):
            raise InputError(f"a_T = {self.a_T}: a finite number >= 0 is needed", "l_T")
        values = tuple(float(share) for share in self.shares)
        if not all(0 <= share <= 1 for share in values):
            raise InputError("shares: numbers from 0 to 1 are needed", "shares")
        object.__setattr__(self, "shares", values)

    @property
    def k(self) -> int:
        """Steps of look-ahead that it defeats."""
        return len(self.shares) + 1

    @property
    def cr_minus_one(self) -> float:
        """The lower bound on ``CR - 1``, by elimination step by step."""
        if self.a_T == 0:
            return 0.0
        return float(np.exp(log_excess(self.a_T, np.array(self.shares))))

    def problem(self, w: float = 1.0, mu: float = 1.0, network: Network | None = None) -> Problem:
        """Return a realisation as a problem.

        Parameters
        ----------
        w : float
            Any algorithm pays the bound at w or at -w; one that is odd in w (LPC) at both.
        mu : float
            The unit of all costs, > 0.
        network : Network, optional
            A network whose agent 0 it is, all others without cost; a single vertex if omitted.
        """
        network = parse_graph("path:1") if network is None else network
        H = self.k + 1
        p = np.sqrt([0.0, *self.shares, 0.0])
        q = np.sqrt([0.0, *(1.0 - share for share in self.shares), 1.0])
        rows = np.sqrt(mu * self.a_T) * np.stack([p, -q], axis=1)
        matrix = np.zeros((H, network.vertices, 2, 2))
        matrix[:, 0] = rows[:, :, None] * rows[:, None, :]
        centre = np.zeros((H, network.vertices, 2))
        centre[-1, 0, 1] = w
        return Problem(network, H, Quadratic([[mu]]), Quadratic(matrix, centre))


def log_excess(a: float, shares: Floats) -> Floats:
    r"""Return ``log(CR - 1)`` for shares of shape (..., k - 1); ``-inf`` if a share is 0 or 1.

    With ``R_t = a^2 P_t (1 - P_t)`` the elimination is ``D_t = F_t + a (1 - P_{t+1})``,
    ``F_t = 1 + a P_t F_{t-1}/D_{t-1}`` from ``F_1 = 1``, resp. ``F'_1/D'_1 = 1``, and
    ``D'_t - D_t = (D'_{t-1} - D_{t-1}) R_t/(D_{t-1} D'_{t-1})``: positive terms only.
    """
    m = shares.shape[-1]
    if m == 0:
        return np.full(shares.shape[:-1], np.log(a))
    P, Q = a * shares, a * (1 - shares)
    after = np.concatenate([Q[..., 1:], np.zeros((*Q.shape[:-1], 1))], axis=-1)
    with np.errstate(divide="ignore"):
        R = np.log(P) + np.log(Q)
    free: Floats = 1 + Q[..., 0]  # D_1
    found: Floats = R[..., 0] - np.log(free)  # log(D'_2 - D_2)
    F, G = 1 + P[..., 0] / free, 1 + P[..., 0]
    for t in range(1, m):
        D, held = F + after[..., t - 1], G + after[..., t - 1]
        found = found + R[..., t] - np.log(D) - np.log(held)
        F, G = 1 + P[..., t] * F / D, 1 + P[..., t] * G / held
    total: Floats = np.log(a) + found - np.log(F) - np.log(G + a)
    return total


def asymmetric(a_T: float, k: int) -> Asymmetric:
    """Return the instance with `first_share` first and 1/2 for all other couplings."""
    if isinstance(k, bool) or int(k) != k or k < 1:
        raise InputError(f"k = {k}: an integer >= 1 is needed", "k")
    shares = (float(first_share(float(a_T))), *[0.5] * max(k - 2, 0))
    return Asymmetric(float(a_T), shares[: k - 1])
