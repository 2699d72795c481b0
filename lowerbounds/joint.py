"""The lower bound in time and space together: who can know a number, and when."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..graphs import InputError, Network
from ..lpc import Problem, Quadratic
from ..lpc.arrays import Floats, Ints
from .grounded import Grounded
from .sources import Charges, charges
from .spatial import distances, edges

LARGEST = 100_000  # unknowns of one sparse factorisation


@dataclass(frozen=True, eq=False)
class Joint:
    r"""Targets ``theta_(t,v)`` on a network over H steps, with difference couplings.

    Costs ``(mu/2)(x - theta)^2``, ``(l_T/4)(x_t - x_{t-1})^2``, ``(l_S/4)(x_u - x_v)^2``, and
    ``x_0 = 0``. Agents see k steps ahead and r hops around, and what others did before tells them
    more; but at step t nobody further than ``r (t - t1 + 1)`` from j can know anything about
    ``theta_(tau,j)``, ``t1 = max(1, tau-k+1)``, and before t1 nobody at all. With independent
    targets of mean zero any algorithm then pays, S the steps and agents that may know,

    .. math:: CR \ge 1 + \frac{\sum_s Var_s (B_{ss} - ((M_{SS})^{-1})_{ss})}
        {\sum_s Var_s (1 - B_{ss})}, \qquad s = (\tau, j),

    M the Hessian over mu, ``B = M^{-1}``. The best variances leave one target random.

    Parameters
    ----------
    network : Network
    a_T, a_S : float
        ``l_T/mu``, ``l_S/mu``, ``>= 0``.
    k, r : int
        Look-ahead ``>= 1`` and radius ``>= 0``.
    H : int
        Horizon, ``>= 1``.
    agents : array_like of int, optional
        The agents that take part: couplings with others are 0, as the class allows. All if
        omitted.

    Raises
    ------
    InputError
        If a parameter is out of range, or there are too many unknowns.
    """

    network: Network
    a_T: float
    a_S: float
    k: int
    r: int
    H: int
    agents: Ints = None  # type: ignore[assignment]

    def __post_init__(self) -> None:
        for name, option in (("a_T", "l_T"), ("a_S", "l_S")):
            value = getattr(self, name)
            if not (np.isfinite(value) and value >= 0):
                raise InputError(f"{name} = {value}: a finite number >= 0 is needed", option)
        for name, least in (("k", 1), ("r", 0), ("H", 1)):
            value = getattr(self, name)
            if isinstance(value, bool) or int(value) != value or value < least:
                raise InputError(f"{name} = {value}: an integer >= {least} is needed", name)
        N = self.network.vertices
        given: object = self.agents
        chosen = np.arange(N) if given is None else np.unique(np.asarray(given))
        if chosen.dtype.kind not in "iu" or not len(chosen) or chosen[0] < 0 or chosen[-1] >= N:
            raise InputError(f"agents: numbers from 0 to {N - 1} are needed", "agents")
        object.__setattr__(self, "agents", chosen.astype(np.int64))
        if self.H * len(chosen) > LARGEST:
            raise InputError(
                f"H = {self.H} steps of {len(chosen)} agents: at most {LARGEST} in all", "H"
            )

    @cached_property
    def system(self) -> Grounded:
        """M; ``(t, v)`` has the number ``(t - 1) n + place of v in agents``."""
        n, H = len(self.agents), self.H
        inner = _renumbered(edges(self.network), self.agents, self.network.vertices)
        grid = np.arange(H * n).reshape(H, n)
        space = (grid[:, :1, None] + inner).reshape(-1, 2)
        time = np.stack([grid[:-1].ravel(), grid[1:].ravel()], axis=1)
        weight = np.repeat([self.a_S / 2, self.a_T / 2], [len(space), len(time)])
        extra = np.zeros(H * n)
        extra[:n] = self.a_T / 2  # x_0 = 0
        return Grounded(extra, np.concatenate([space, time]), weight)

    def number(self, tau: int, agent: int) -> int:
        """Return the number of ``(tau, agent)``."""
        place = int(np.searchsorted(self.agents, agent))
        if not (1 <= tau <= self.H and place < len(self.agents) and self.agents[place] == agent):
            raise InputError(f"step {tau}, agent {agent}: not among those that take part")
        return (tau - 1) * len(self.agents) + place

    def seen(self, sources: Ints) -> list[Ints]:
        """Return who may know each of some targets, and when."""
        n = len(self.agents)
        steps, places = np.divmod(sources, n)
        apart = distances(self.network, self.agents[places])[:, self.agents]
        t = np.arange(self.H)[:, None]
        found = []
        for step, row in zip(steps, apart, strict=True):
            first = max(0, int(step) - self.k + 1)
            found.append(np.flatnonzero((t >= first) & (row <= self.r * (t - first + 1))))
        return found

    def charges(
        self,
        sources: ArrayLike | None = None,
        progress: Callable[[int, int], None] | None = None,
    ) -> Charges:
        """Return what each of some targets costs; by number, all if omitted."""
        every = np.arange(self.H * len(self.agents))
        chosen = every if sources is None else np.atleast_1d(np.asarray(sources, dtype=np.int64))
        return charges(self.system, chosen, self.seen, progress)

    def cr_minus_one(self, agent: int, tau: int | None = None) -> float:
        """Return the lower bound on ``CR - 1`` from one random target, by default the last."""
        source = self.number(self.H if tau is None else tau, agent)
        return float(self.charges([source]).ratios[0])

    def problem(
        self, agent: int, tau: int | None = None, mu: float = 1.0, w: float = 1.0
    ) -> Problem:
        """Return the realisation with one target w and all others 0 as a problem.

        Any algorithm pays the bound at w or at -w; one that is odd in the targets (LPC) at both.
        """
        tau = self.H if tau is None else tau
        self.number(tau, agent)
        N = self.network.vertices
        centre = np.zeros((self.H, N, 1))
        centre[tau - 1, agent] = w
        pair = mu / 2 * np.array([[1.0, -1.0], [-1.0, 1.0]])
        taking = np.zeros(N)
        taking[self.agents] = 1.0
        ends = edges(self.network)
        joined: Floats = taking[ends].prod(axis=1)
        return Problem(
            self.network,
            self.H,
            Quadratic([[mu]], centre),
            Quadratic(self.a_T * taking[:, None, None] * pair),
            Quadratic(self.a_S * pair * (joined[:, None, None] if len(ends) else 0.0)),
        )


def _renumbered(ends: Ints, agents: Ints, N: int) -> Ints:
    """Return the edges among some agents by their places."""
    place = np.full(N, -1)
    place[agents] = np.arange(len(agents))
    at = place[ends]
    found: Ints = at[(at >= 0).all(axis=1)]
    return found
