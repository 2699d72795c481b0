"""The constants of Assumption 2.1, derived from a problem."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import overload

import numpy as np
from numpy.typing import NDArray

from ..bounds import Parameters
from ..graphs import Growth, Network, network_growth
from .arrays import Floats, Ints
from .costs import Cost, Source
from .problem import Problem


@dataclass(frozen=True)
class Extreme:
    """One constant: the least or the largest eigenvalue of all Hessians of one kind of cost.

    Parameters
    ----------
    value : float
        As computed.
    error : float
        By how much rounding may have moved it, at most.
    source : {"exact", "bound", "claimed"}
        As in `nearsight.lpc.costs.Curvature`: the extreme itself, a proven bound on it, or what
        the author of the cost says.
    step : int or None
        The first step at which it is attained; None if there is no cost of this kind.
    member : tuple of int
        The agent (v,), or the ends (u, v) of the edge, where it is attained; empty if none.
    """

    value: float
    error: float
    source: Source
    step: int | None
    member: tuple[int, ...]

    @property
    def place(self) -> str:
        """Where it is attained, in words."""
        if self.step is None:
            return "nowhere"
        who = f"agent {self.member[0]}" if len(self.member) == 1 else f"edge {self.member}"
        return f"step {self.step}, {who}"

    @property
    def above(self) -> float:
        """A number that is certainly not smaller; `value` itself if there is no error."""
        raised = float(np.nextafter(self.value + self.error, np.inf))
        return raised if self.error > 0 else self.value

    @property
    def below(self) -> float:
        """A number that is certainly not larger; `value` itself if there is no error."""
        lowered = float(np.nextafter(self.value - self.error, -np.inf))
        return lowered if self.error > 0 else self.value


@dataclass(frozen=True)
class Constants:
    """``mu, l_f, l_T, l_S`` and the growth ``Delta, h`` of one problem.

    Parameters
    ----------
    mu, l_f, l_T, l_S : Extreme
    network : Network
        The graph behind Delta and h.

    References
    ----------
    Paper, Assumption 2.1 (``assump:costs-and-feasible-sets``) and Section 1 (Notation).
    """

    mu: Extreme
    l_f: Extreme
    l_T: Extreme
    l_S: Extreme
    network: Network

    @property
    def Delta(self) -> int:
        """The largest degree."""
        return self.network.max_degree

    @cached_property
    def growth(self) -> Growth:
        """The growth of the network; computed as far as somebody asks."""
        return network_growth(self.network)

    @overload
    def h(self, q: int) -> int: ...
    @overload
    def h(self, q: NDArray[np.integer]) -> Floats: ...
    def h(self, q: int | NDArray[np.integer]) -> int | Floats:
        """Return ``sup_v |{u : d(u, v) = q}|``."""
        return self.growth.h(q)

    def parameters(self) -> Parameters:
        """Return constants that are safe: mu lowered, the others raised by their errors."""
        return Parameters(self.mu.below, self.l_f.above, self.l_T.above, self.l_S.above)

    @property
    def certified(self) -> bool:
        """Whether no constant rests on a claim."""
        return all(x.source != "claimed" for x in (self.mu, self.l_f, self.l_T, self.l_S))


def constants(problem: Problem) -> Constants:
    """Derive the constants of a problem from its costs and its network.

    Examples
    --------
    >>> from nearsight.graphs import parse_graph
    >>> from nearsight.lpc.costs import Quadratic
    >>> problem = Problem(parse_graph("ring:5"), 3, Quadratic([[2.0]]))
    >>> constants(problem).mu
    Extreme(value=2.0, error=0.0, source='exact', step=1, member=(0,))
    """
    return Constants(
        mu=_extreme(problem, problem.node, least=True),
        l_f=_extreme(problem, problem.node),
        l_T=_extreme(problem, problem.temporal),
        l_S=_extreme(problem, problem.spatial, spatial=True),
        network=problem.network,
    )


def _extreme(
    problem: Problem, cost: Cost, *, least: bool = False, spatial: bool = False
) -> Extreme:
    """Return the least lower or the largest upper bound of a cost, and where it is."""
    if spatial and not len(problem.edges):
        return Extreme(0.0, 0.0, "exact", None, ())
    found = cost.curvature()
    values = found.lower if least else found.upper
    at = np.unravel_index(int(values.argmin() if least else values.argmax()), values.shape)
    ends: Ints = problem.edges[at[1]] if spatial else np.array([at[1]])
    member = tuple(int(v) for v in ends)
    error = float(found.error.max())  # of another member, perhaps: safe
    return Extreme(float(values[at]), error, found.source, int(at[0]) + 1, member)
