r"""The temporal lower bound: one agent that sees k steps ahead, in closed form."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ..bounds.arithmetic import Number, power, sqrt
from ..bounds.decay import gamma_T
from ..bounds.formula import formula
from ..bounds.lower import final_excess, temporal_excess
from ..graphs import InputError, Network, parse_graph
from ..lpc import Box, Problem, Quadratic
from ..lpc.arrays import Floats
from ..lpc.sets import Everywhere


@formula(counts=("k", "H", "tau"))
def blind_excess(a_T: Number, k: Any, H: Any, tau: Any) -> Number:
    r"""Return what not seeing ``theta_tau`` before step ``tau-k+1`` costs, over ``(mu/2) Var``.

    .. math:: \frac{\gamma^{2k} (1+\gamma^{2(H-\tau)+1})^2 (1-\gamma^{2(\tau-k)})}
        {\sqrt{1+2a}\,(1+\gamma^{2(H-\tau+k)+1})(1+\gamma^{2H+1})}, \qquad \gamma = \gamma_T,

    and 0 for ``tau <= k``: the square of the one entry of ``M_OS (M_SS)^{-1} e_tau``, times an
    entry of the inverse of the chain with x_0 fixed and a free end.
    """
    k, tau = np.asarray(k), np.asarray(tau)
    gamma, one = gamma_T(a_T), 1
    free = one + power(gamma, 2 * (H - tau) + 1)
    # gamma^{2k} (1 - gamma^{2(tau-k)}) with the exponent kept >= 0
    seen = 1 - power(gamma, 2 * np.maximum(tau - k, 0))
    below = (one + power(gamma, 2 * (H - tau + k) + 1)) * (one + power(gamma, 2 * H + 1))
    return power(gamma, 2 * k) * free * free * seen / (sqrt(1 + 2 * a_T) * below)


@formula(counts=("H", "tau"))
def blind_optimum(a_T: Number, H: Any, tau: Any) -> Number:
    r"""Return ``1 - B_tautau``, what ``theta_tau`` costs the optimum, over ``(mu/2) Var``.

    ``2 gamma/(1+gamma) - (gamma^{2(H-tau)+1} - gamma^{2 tau} - 2 gamma^{2H+1})/(s
    (1+gamma^{2H+1}))`` with ``1/s = (1-gamma)/(1+gamma)``.
    """
    gamma, tau = gamma_T(a_T), np.asarray(tau)
    last = power(gamma, 2 * H + 1)
    ends = power(gamma, 2 * (H - tau) + 1) - power(gamma, 2 * tau) - 2 * last
    return (2 * gamma - (1 - gamma) * ends / (1 + last)) / (1 + gamma)


@dataclass(frozen=True)
class Temporal:
    r"""One agent pays ``(mu/2) sum_t (x_t - theta_t)^2 + (l_T/4) sum_t (x_t - x_{t-1})^2``.

    Targets are independent; at step t the agent knows ``theta_1, ..., theta_{t+k-1}``. The best
    policy plans with the means of what it does not see (dynamic programming; the costs are
    quadratic). Its actions, like those of the optimum, are averages of x_0, targets and means:
    with all of these in an interval D, a constraint to D changes neither cost, and everything
    here holds for ``x_t`` in D as it stands.

    Parameters
    ----------
    a_T : float
        ``l_T/mu >= 0``.
    k : int
        Steps of look-ahead, the present one included, ``>= 1``.
    H : int
        Horizon, ``>= 1``.

    Raises
    ------
    InputError
        If a parameter is out of range.

    References
    ----------
    Paper, ``thm:bottleneck``, step 1 of its proof (with ``(l_T/2)(x_t - x_{t-1})^2``, which is
    ``2 l_T``-smooth).
    """

    a_T: float
    k: int
    H: int

    def __post_init__(self) -> None:
        if not (np.isfinite(self.a_T) and self.a_T >= 0):
            raise InputError(f"a_T = {self.a_T}: a finite number >= 0 is needed", "l_T")
        for name in ("k", "H"):
            value = getattr(self, name)
            if isinstance(value, bool) or int(value) != value or value < 1:
                raise InputError(f"{name} = {value}: an integer >= 1 is needed", name)

    @property
    def excess(self) -> Floats:
        """The best policy's expected excess by target, over ``(mu/2) Var``, shape (H,)."""
        found: Floats = blind_excess(self.a_T, self.k, self.H, np.arange(1, self.H + 1))
        return found

    @property
    def optimal(self) -> Floats:
        """The optimum's expected cost by target, over ``(mu/2) Var``, shape (H,)."""
        found: Floats = blind_optimum(self.a_T, self.H, np.arange(1, self.H + 1))
        return found

    def ratio(self, variances: ArrayLike = 1.0) -> float:
        """Return ``E[excess]/E[OPT]`` of the best policy for given variances."""
        weights = np.broadcast_to(np.asarray(variances, dtype=float), (self.H,))
        if not (np.isfinite(weights).all() and (weights >= 0).all() and weights.any()):
            raise InputError("variances: finite numbers >= 0, not all 0, are needed", "variances")
        best = float(weights @ self.optimal)
        return float(weights @ self.excess) / best if best > 0 else 0.0

    @property
    def step(self) -> int:
        """The target that the best variances leave random, all others known (1..H)."""
        optimal, excess = self.optimal, self.excess
        safe = np.where(excess > 0, optimal, 1.0)
        return int(np.argmax(np.where(excess > 0, excess / safe, 0.0)[::-1]) * -1 + self.H)

    @property
    def cr_minus_one(self) -> float:
        """The lower bound on ``CR - 1`` with the best variances, for this horizon."""
        weights = np.zeros(self.H)
        weights[self.step - 1] = 1.0
        return self.ratio(weights)

    @property
    def limit(self) -> float:
        """``cr_minus_one`` as H goes to infinity; see `bounds.lower.final_excess`."""
        return float(final_excess(self.a_T, self.k))

    @property
    def long_run(self) -> float:
        """``ratio()`` as H goes to infinity; see `bounds.lower.temporal_excess`."""
        return float(temporal_excess(self.a_T, self.k))

    def problem(
        self,
        theta: ArrayLike | None = None,
        mu: float = 1.0,
        interval: tuple[float, float] | None = None,
        network: Network | None = None,
    ) -> Problem:
        """Return a realisation as a problem.

        Parameters
        ----------
        theta : array_like, shape (H,), optional
            Targets; if omitted, 0 (the middle of the interval) but for the one of `step`, which
            is 1 (the upper end): of its two signs any algorithm pays the bound at one, LPC at both.
        mu : float
            The unit of costs, > 0.
        interval : (low, high), optional
            The set D of all actions.
        network : Network, optional
            A network whose agent 0 it is, all others without cost; a single vertex if omitted.
        """
        low, high = (-1.0, 1.0) if interval is None else interval
        if not (np.isfinite([low, high]).all() and low < high):
            raise InputError(f"interval = {interval}: two finite numbers, the first less")
        middle = (low + high) / 2
        if theta is None:
            theta = np.full(self.H, middle)
            theta[self.step - 1] = high
        targets = np.asarray(theta, dtype=float)
        if targets.shape != (self.H,):
            raise InputError(f"theta: {self.H} numbers are needed, not {targets.shape}", "theta")
        network = parse_graph("path:1") if network is None else network
        centre = np.full((self.H, network.vertices, 1), middle)
        centre[:, 0, 0] = targets
        pair = mu * self.a_T / 2 * np.array([[1.0, -1.0], [-1.0, 1.0]])
        free = Everywhere() if interval is None else Box(low, high)
        return Problem(
            network,
            self.H,
            Quadratic([[mu]], centre),
            Quadratic(pair),
            feasible=free,
            x_0=np.array(middle),
        )
