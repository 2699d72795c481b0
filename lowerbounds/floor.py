"""What nobody beats on one network: all lower bounds side by side, and the worst instance."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from ..bounds import Setting
from ..bounds.lower import final_excess, temporal_excess
from ..graphs import InputError, NearsightError, Network
from ..lpc import Problem
from ..lpc.information import check_sight
from .asymmetric import asymmetric, asymmetric_excess
from .infinite import infinite_excess
from .joint import Joint
from .spatial import LARGEST, Spatial
from .stated import Stated, stated

MOST = 1_000_000  # steps of look-ahead, and hops
JOINT = 20_000  # unknowns in time and space up to which the joint bound is computed
SEARCHED = 1_500  # up to which all its sources are tried
LONGEST = 100_000  # steps times agents of a saved instance


@dataclass(frozen=True)
class Part:
    """One lower bound.

    Attributes
    ----------
    cr_minus_one : float or None
        No algorithm with this sight has a smaller ``CR - 1``; None if not computed.
    details : mapping
        How it comes about.
    reason : str
        Why there is no number.
    """

    cr_minus_one: float | None
    details: Mapping[str, Any] = field(default_factory=dict)
    reason: str = ""


@dataclass(frozen=True, eq=False)
class Floor:
    """What no decentralised online algorithm beats, over all costs with the given constants.

    Attributes
    ----------
    setting : Setting
        Constants and network.
    network : Network or None
        None for an infinite network.
    k, r : int
        What agents see.
    temporal, spatial, joint : Part
        One agent alone; one step; time and space with all couplings at full strength, which ties
        everything down: it is often the least, and that of problems like those of the network.
    stated : Stated
        What the paper prints.
    """

    setting: Setting
    network: Network | None
    k: int
    r: int
    temporal: Part
    spatial: Part
    joint: Part
    stated: Stated

    @property
    def best(self) -> str:
        """The name of the largest bound."""
        found = {n: getattr(self, n).cr_minus_one for n in ("temporal", "spatial", "joint")}
        return max(found, key=lambda n: -1.0 if found[n] is None else float(found[n]))

    @property
    def cr_minus_one(self) -> float:
        """The largest bound; the temporal one is always there."""
        return float(getattr(self, self.best).cr_minus_one)

    def problem(self) -> Problem:
        """Return the instance behind the largest bound, on the network.

        Any algorithm pays the bound there or where the one number in it has the other sign; an
        algorithm that is odd in the data, such as LPC, at both.

        Raises
        ------
        InputError
            For an infinite network, or an instance too long to write down.
        """
        network, p = self.network, self.setting.parameters
        if network is None:
            raise InputError("an instance needs a finite graph, not a growth", "save")
        mu, a_T, a_S = float(p.mu), float(p.a_T), float(p.a_S)
        if self.best == "spatial":
            w = np.zeros(network.vertices)
            w[self.spatial.details["agent"]] = -1.0
            return Spatial(network, a_S, self.r).problem(w, mu)
        if self.best == "joint":
            d = self.joint.details
            whole = Joint(network, a_T, a_S, self.k, self.r, d["horizon"])
            return whole.problem(d["agent"], d["step"], mu)
        if (self.k + 1) * network.vertices > LONGEST:
            raise InputError(
                f"k = {self.k}: {self.k + 1} steps of {network.vertices} agents are too many to "
                f"save; at most {LONGEST} in all",
                "k",
            )
        return asymmetric(a_T, self.k).problem(1.0, mu, network)


def floor(
    setting: Setting,
    network: Network | None,
    k: int,
    r: int,
    progress: Callable[[int, int], None] | None = None,
) -> Floor:
    """Return all lower bounds for the sight (k, r).

    Parameters
    ----------
    setting : Setting
        Constants as floats, and the growth of the network.
    network : Network or None
        None for an infinite network.
    k, r : int
        Look-ahead ``>= 1`` and radius ``>= 0``.
    progress : callable, optional
        Called as ``progress(done, total)``.
    """
    check_sight(k, r)
    for name, value in (("k", k), ("r", r)):
        if value > MOST:
            raise InputError(f"{name} = {value}: an integer <= {MOST} is needed", name)
    p = setting.parameters
    if any(np.ndim(x) for x in (p.mu, p.l_T, p.l_S)):
        raise InputError("lower bounds on a network take single numbers, not arrays")
    a_T, a_S = float(p.a_T), float(p.a_S)
    temporal = _temporal(a_T, k)
    spatial = _spatial(setting, network, a_S, r, progress)
    joint = _joint(network, spatial, a_T, a_S, k, r)
    proven = float(temporal.cr_minus_one or 0.0)
    return Floor(setting, network, k, r, temporal, spatial, joint, stated(setting, k, proven))


def _temporal(a_T: float, k: int) -> Part:
    """Return the bound of one agent; other couplings are 0, as every class allows."""
    found = {
        "asymmetric": float(asymmetric_excess(a_T, k)),
        "last_target": float(final_excess(a_T, k)),
        "all_targets": float(temporal_excess(a_T, k)),
    }
    instance = {"instance": max(found, key=lambda n: found[n]), "horizon": k + 1}
    return Part(max(found.values()), {**instance, "bounds": found})


def _spatial(
    s: Setting,
    network: Network | None,
    a_S: float,
    r: int,
    progress: Callable[[int, int], None] | None,
) -> Part:
    if network is None:
        found = infinite_excess(s.growth, a_S, r)
        known = "line, grid2 (r <= 100, l_S <= 1e8 mu), tree:DELTA (r <= 2000), ring-of-blocks:D"
        reason = f"{s.growth.source}: known for {known}, and for finite graphs"
        return Part(found, reason="" if found is not None else reason)
    if network.vertices > LARGEST:
        return Part(None, reason=f"{network.vertices} agents; at most {LARGEST} are factorised")
    try:
        charged = Spatial(network, a_S, r).search(progress)
    except NearsightError as error:
        return Part(None, reason=str(error))
    best = charged.best
    agent = int(charged.agents[best])
    details = {"agent": agent, "name": network.names[agent], "tried": len(charged.agents)}
    return Part(float(charged.ratios[best]), details)


def _joint(network: Network | None, spatial: Part, a_T: float, a_S: float, k: int, r: int) -> Part:
    """Return the bound with all couplings at full strength, over ``k + 1`` steps."""
    if network is None or spatial.cr_minus_one is None:
        finite = "computed for finite graphs of moderate size"
        return Part(None, reason=finite if network is None else spatial.reason)
    H, N = k + 1, network.vertices
    if H * N > JOINT:
        return Part(None, reason=f"{H} steps of {N} agents; computed up to {JOINT} in all")
    whole = Joint(network, a_T, a_S, k, r, H)
    every = None if H * N <= SEARCHED else [whole.number(H, spatial.details["agent"])]
    try:
        found = whole.charges(every)
    except NearsightError as error:
        return Part(None, reason=str(error))
    step, agent = divmod(int(found.agents[found.best]), N)
    details = {"horizon": H, "step": step + 1, "agent": agent, "name": network.names[agent]}
    return Part(float(found.ratios[found.best]), details)
