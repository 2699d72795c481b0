"""Where the node costs of a random instance are least: the targets theta."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from scipy import sparse
from scipy.sparse import csgraph

from ...graphs import InputError, Network
from ..arrays import Floats

Kind = Callable[..., Floats]
KINDS: dict[str, tuple[str, Kind]] = {}


def target_kinds() -> dict[str, str]:
    """Return every kind of targets with one line on it."""
    return {name: about for name, (about, _) in KINDS.items()}


def draw_targets(spec: str, network: Network, H: int, n: int, rng: np.random.Generator) -> Floats:
    """Return targets, shape (H, N, n), of a kind such as ``"walk"`` or ``"far:3,2"``.

    Raises
    ------
    InputError
        If there is no such kind, or its arguments are wrong.
    """
    name, _, rest = spec.partition(":")
    if name not in KINDS or (rest and name != "far"):
        accepted = ", ".join(KINDS)
        raise InputError(
            f"targets = {spec!r}: one of {accepted}, far:K,R[,V], or an array of shape (H, N, n)",
            "targets",
        )
    if not rest:
        return KINDS[name][1](network, H, n, rng)
    parts = rest.split(",")
    if len(parts) not in (2, 3) or not all(p.isdecimal() for p in parts):
        raise InputError(f"targets = {spec!r}: far:K,R or far:K,R,V with integers >= 0", "targets")
    return far(network, H, n, rng, *map(int, parts))


def _kind(name: str, about: str) -> Callable[[Kind], Kind]:
    def register(function: Kind) -> Kind:
        KINDS[name] = about, function
        return function

    return register


@_kind("normal", "independent standard normal numbers")
def normal(network: Network, H: int, n: int, rng: np.random.Generator) -> Floats:
    """Return standard normal numbers."""
    return rng.standard_normal((H, network.vertices, n))


@_kind("walk", "a random walk of every entry, from 0, with standard normal steps")
def walk(network: Network, H: int, n: int, rng: np.random.Generator) -> Floats:
    """Return sums over time of standard normal numbers."""
    found: Floats = normal(network, H, n, rng).cumsum(axis=0)
    return found


@_kind("alternating", "the sign flips at every step, and along a breadth-first search")
def alternating(network: Network, H: int, n: int, rng: np.random.Generator) -> Floats:
    """Return ``(-1)^(t + depth(v))`` times a size of v and its entry, uniform in [1/2, 3/2].

    The depth is that in a breadth-first search from the first vertex of every component: on a
    bipartite graph all neighbours differ in sign.
    """
    flips = np.arange(1, H + 1)[:, None] + _depths(network)
    sizes = rng.uniform(0.5, 1.5, (network.vertices, n))
    return np.where(flips % 2 == 0, 1.0, -1.0)[..., None] * sizes


@_kind("last", "zero up to the last step, then standard normal")
def last(network: Network, H: int, n: int, rng: np.random.Generator) -> Floats:
    """Return zeros, and standard normal numbers at step H: the temporal worst case."""
    found = np.zeros((H, network.vertices, n))
    found[-1] = rng.standard_normal(found.shape[1:])
    return found


@_kind("far", "zero within some steps and hops of an agent, standard normal beyond")
def far(
    network: Network,
    H: int,
    n: int,
    rng: np.random.Generator,
    k: int | None = None,
    r: int | None = None,
    agent: int | None = None,
) -> Floats:
    """Return standard normal numbers where ``t > k`` or ``d(agent, v) > r``, zero elsewhere.

    At step 1 the agent then sees nothing but zeros with horizon k and radius r. Unless given,
    k is half of H, r half of the largest finite distance from the agent, the agent random.

    Raises
    ------
    InputError
        If there is no such agent, or nothing lies beyond.
    """
    N = network.vertices
    chosen = int(rng.integers(N))  # drawn in any case: the numbers below stay the same
    agent = chosen if agent is None else agent
    if not 0 <= agent < N:
        raise InputError(f"targets 'far': agent {agent}; an agent within 0..{N - 1}", "targets")
    away = csgraph.dijkstra(_matrix(network), unweighted=True, indices=agent)
    k = H // 2 if k is None else k
    r = int(away[np.isfinite(away)].max()) // 2 if r is None else r
    beyond = (np.arange(1, H + 1)[:, None] > k) | (away > r)
    if not beyond.any():
        raise InputError(
            f"targets 'far': all {H} steps are within k = {k}, all agents within r = {r} of agent "
            f"{agent}; something has to lie beyond",
            "targets",
        )
    return np.where(beyond[..., None], rng.standard_normal((H, N, n)), 0.0)


@_kind("wave", "sines that travel outwards from one vertex of every component")
def wave(network: Network, H: int, n: int, rng: np.random.Generator) -> Floats:
    """Return ``sin(2 pi (t/P - depth(v)/L) + phase)``: P, L uniform in [3, 12], phase random."""
    period, length = rng.uniform(3.0, 12.0, (2, n))
    phase = rng.uniform(0.0, 2.0 * np.pi, n)
    t = np.arange(1, H + 1)[:, None, None] / period
    found: Floats = np.sin(2.0 * np.pi * (t - _depths(network)[:, None] / length) + phase)
    return found


def _matrix(network: Network) -> sparse.csr_array:
    ones, N = np.ones(len(network.indices)), network.vertices
    # 32 bits throughout: what the routines of csgraph want
    return sparse.csr_array((ones, network.indices, network.indptr.astype(np.int32)), shape=(N, N))


def _depths(network: Network) -> Floats:
    """Return the distance of every vertex from the first one of its component, shape (N,)."""
    matrix = _matrix(network)
    _, component = csgraph.connected_components(matrix, directed=False)
    roots = np.unique(component, return_index=True)[1]
    found: Floats = csgraph.dijkstra(matrix, unweighted=True, indices=roots, min_only=True)
    return found
