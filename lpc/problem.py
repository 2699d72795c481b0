"""A networked online convex problem: what is to be paid, and what is allowed."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import ArrayLike

from ..graphs import InputError, Network
from .arrays import Floats, Ints, integer
from .costs import Cost, Quadratic
from .sets import Everywhere, FeasibleSet


@dataclass(frozen=True, eq=False)
class Problem:
    """Minimise the sum of node, temporal and spatial costs over steps ``t = 1..H``::

        sum_t [ sum_v f_t^v(x_t^v) + sum_v c_t^v(x_t^v, x_{t-1}^v)
                + sum_{(u,v)} s_t^{uv}(x_t^u, x_t^v) ]

    with ``x_t^v`` in ``D_t^v``, a set of R^n, from given actions ``x_0``.

    Parameters
    ----------
    network : Network
        The graph; its vertices are the agents ``v = 0..N-1``.
    H : int
        The number of steps, at least 1.
    node : Cost
        The costs f, members the agents, arguments of n numbers.
    temporal : Cost, optional
        The costs c of ``(x_t, x_{t-1})``, members the agents, 2 n numbers; none if omitted.
    spatial : Cost, optional
        The costs s of ``(x_u, x_v)``, ``u < v``, members the edges in the order of `edges`, 2 n
        numbers; none if omitted.
    feasible : FeasibleSet
        The sets D.
    x_0 : array_like, shape (N, n) or one that broadcasts to it
        The actions before the first step; zero if omitted. They need not be feasible.

    Raises
    ------
    InputError
        If sizes do not fit, a cost is not convex, a node cost is not strongly convex, or a set is
        empty.

    References
    ----------
    Paper, Section 2 (``sec:setting``), Assumption 2.1 (``assump:costs-and-feasible-sets``).
    """

    network: Network
    H: int
    node: Cost
    temporal: Cost = None  # type: ignore[assignment]
    spatial: Cost = None  # type: ignore[assignment]
    feasible: FeasibleSet = field(default_factory=Everywhere)
    x_0: Floats = None  # type: ignore[assignment]

    def __post_init__(self) -> None:
        object.__setattr__(self, "H", integer(self.H, "H", 1))
        for name, kind in (("network", Network), ("node", Cost), ("feasible", FeasibleSet)):
            if not isinstance(getattr(self, name), kind):
                given = type(getattr(self, name)).__name__
                raise InputError(f"{name}: a {given} where a {kind.__name__} is needed", name)
        n = self.node.size
        for name in ("temporal", "spatial"):
            if getattr(self, name) is None:
                object.__setattr__(self, name, Quadratic(np.zeros((2 * n, 2 * n))))
        self.node.check(self.H, self.N, n, "node cost")
        self.temporal.check(self.H, self.N, 2 * n, "temporal cost")
        self.spatial.check(self.H, len(self.edges), 2 * n, "spatial cost")
        self.feasible.check(self.H, self.N, n)
        object.__setattr__(self, "x_0", _start(self.x_0, self.N, n))
        low = self.node.curvature()
        flat = np.argwhere(~(low.lower > low.error))
        if len(flat):
            t, v = flat[0]
            raise InputError(
                f"node cost at step {t + 1}, agent {v}: not strongly convex, least curvature "
                f"{low.lower[t, v]:g}; mu > 0 is needed"
            )

    @property
    def N(self) -> int:
        """The number of agents."""
        return self.network.vertices

    @property
    def n(self) -> int:
        """The number of entries of one action."""
        return self.node.size

    @cached_property
    def edges(self) -> Ints:
        """The two ends ``u < v`` of every edge, in lexicographic order, shape (E, 2)."""
        rows = np.repeat(np.arange(self.N), self.network.degrees)
        forward = rows < self.network.indices
        found = np.stack([rows[forward], self.network.indices[forward]], axis=1).astype(np.int64)
        found.setflags(write=False)
        return found

    @cached_property
    def edge_of(self) -> Ints:
        """The edge behind every entry of ``network.indices``, shape (2 E,)."""
        rows = np.repeat(np.arange(self.N), self.network.degrees)
        ends = np.sort(np.stack([rows, self.network.indices.astype(np.int64)]), axis=0)
        keys = self.edges[:, 0] * self.N + self.edges[:, 1]
        found: Ints = np.searchsorted(keys, ends[0] * self.N + ends[1]).astype(np.int64)
        return found

    @property
    def quadratic(self) -> bool:
        """Whether all costs are quadratic."""
        return all(isinstance(c, Quadratic) for c in (self.node, self.temporal, self.spatial))

    @property
    def steady(self) -> bool:
        """Whether no Hessian changes with the step (targets may)."""
        return all(c.steady for c in (self.node, self.temporal, self.spatial))

    def costs(self, x: Floats) -> dict[str, Floats]:
        """Return what a trajectory costs, by kind and step.

        Parameters
        ----------
        x : ndarray, shape (H, N, n)
            The actions of steps 1..H.

        Returns
        -------
        dict
            ``"node"``, ``"temporal"`` and ``"spatial"``, each of shape (H,).
        """
        if np.shape(x) != (self.H, self.N, self.n):
            raise InputError(f"x: shape {np.shape(x)}; {(self.H, self.N, self.n)} is needed", "x")
        found = {name: np.zeros(self.H) for name in ("node", "temporal", "spatial")}
        agents, edges = np.arange(self.N), np.arange(len(self.edges))
        before = self.x_0
        for s in range(self.H):
            now, t = x[s], np.full(self.N, s + 1)
            pair = np.concatenate([now, before], axis=1)
            ends = now[self.edges].reshape(len(edges), 2 * self.n)
            found["node"][s] = self.node.value(t, agents, now).sum()
            found["temporal"][s] = self.temporal.value(t, agents, pair).sum()
            found["spatial"][s] = self.spatial.value(np.full(len(edges), s + 1), edges, ends).sum()
            before = now
        return found

    def cost(self, x: Floats) -> float:
        """Return the total cost of a trajectory of shape (H, N, n).

        Raises
        ------
        InputError
            If it has another shape.
        """
        return float(sum(part.sum() for part in self.costs(x).values()))


def _start(x_0: ArrayLike | None, N: int, n: int) -> Floats:
    try:
        found = np.broadcast_to(np.asarray(0.0 if x_0 is None else x_0, dtype=float), (N, n)).copy()
    except (TypeError, ValueError) as error:
        raise InputError(f"x_0: numbers of shape ({N}, {n}) are needed, not {x_0!r:.60}") from error
    bad = np.argwhere(~np.isfinite(found))
    if len(bad):
        raise InputError(f"x_0 of agent {bad[0][0]}: {found[tuple(bad[0])]}; a finite number")
    found.setflags(write=False)
    return found
