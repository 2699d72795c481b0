r"""``thm: l-power``: products of exponentially decaying matrices decay."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import reduce

import numpy as np

from ...graphs import InputError, Network, NetworkGrowth, parse_graph
from ...lpc.arrays import Floats
from ..comparison import Comparison, worst
from ._hierarchy import block_norms, distances

LABEL = "thm: l-power"
TITLE = "products of exponentially decaying matrices decay"
GRAPHS = ("path:1", "path:9", "ring:8", "ring:9", "tree:2x3", "tree:3x2", "star:7", "grid:3x4")
DENSER = ("complete:5", "ring-of-blocks:5x2", "ring-of-blocks:4x3", "hypercube:3")
RANDOM = ("erdos-renyi:10x0.15", "erdos-renyi:12x0.3", "regular:3x10")


def compare(
    network: Network,
    factors: Sequence[Floats],
    constants: Sequence[float],
    rate: float,
    slower: float,
    *,
    instance: str = "",
    seed: int | None = None,
) -> tuple[Comparison, ...]:
    r"""Compare the blocks of a product with ``C' lambda'^{d(u,q)}``.

    If ``|(A_i)_{u,q}| <= C_i lambda^{d(u,q)}`` for all blocks and ``lambda < lambda' < 1``, then

    .. math:: \|(A_1 \cdots A_\ell)_{u,q}\|
        \le \tilde a^\ell \prod_i C_i \, \lambda'^{d(u,q)}, \qquad
        \tilde a = \sum_{q \ge 0} (\lambda/\lambda')^q h(q).

    *stated* is that; *sharp* has one factor ``a~`` less: of the ``l`` distances along
    ``u, s_1, ..., s_{l-1}, q`` only ``l - 1`` are summed over once q is fixed, and the last power
    of ``lambda/lambda'`` is at most 1. It is attained at ``l = 1`` and, for finite graphs, by
    positive blocks at their bound as ``lambda -> 1``.

    Parameters
    ----------
    network : Network
    factors : sequence of ndarray, shape (N d, N d)
    constants : sequence of float
        The C_i.
    rate, slower : float
        lambda and lambda'.
    instance, seed
        As in `Comparison`.

    Raises
    ------
    InputError
        If there is no factor, shapes or numbers of constants differ, or a rate is out of range.

    References
    ----------
    Paper, ``thm: l-power``.
    """
    if not 0 <= rate < slower < 1:
        raise InputError(f"rates {rate:g}, {slower:g}: 0 <= lambda < lambda' < 1 is needed")
    shapes = {f.shape for f in factors}
    if len(shapes) != 1 or len(factors) != len(constants):
        raise InputError("factors: at least one, of one shape, with a constant each")
    distance = distances(network)
    d = factors[0].shape[0] // network.vertices
    limits = [C * rate**distance * (1 + 1e-12) for C in constants]
    decay = all((block_norms(f, d) <= b).all() for f, b in zip(factors, limits, strict=True))
    total = NetworkGrowth(network).transform(rate / slower)
    product = block_norms(reduce(np.matmul, factors), d)
    one = math.prod(constants) * slower**distance
    tiers = {"stated": total ** len(factors), "sharp": total ** (len(factors) - 1)}
    return tuple(
        c
        for part, power in tiers.items()
        for c in worst(
            LABEL, part, product, power * one, instance=instance, seed=seed, hypotheses=decay
        )
    )


def measure(seed: int) -> tuple[Comparison, ...]:
    """Compare on random graphs; the blocks are random, or all positive and at their bounds."""
    rng = np.random.default_rng([seed, 0])
    graph = str(rng.choice(GRAPHS + DENSER + RANDOM))
    network = parse_graph(graph, seed)
    factors, d = int(rng.integers(1, 7)), int(rng.integers(1, 4))
    rate = 0.0 if rng.random() < 0.05 else float(1 - 10 ** rng.uniform(-3, 0))
    slower = float(rate + (1 - rate) * rng.uniform(0.01, 0.99))
    constants = [float(C) for C in rng.uniform(0.1, 3.0, factors)]
    extreme = bool(rng.random() < 0.5)
    made = [decaying(network, d, C, rate, rng, extreme=extreme) for C in constants]
    kind = "positive blocks at their bounds" if extreme else "random blocks"
    text = f"{graph}, {kind}, l = {factors}, d = {d}, lambda = {rate:.6g}, lambda' = {slower:.6g}"
    return compare(network, made, constants, rate, slower, instance=text, seed=seed)


def decaying(
    network: Network,
    d: int,
    constant: float,
    rate: float,
    rng: np.random.Generator,
    *,
    extreme: bool = False,
) -> Floats:
    """Return a matrix with blocks of norm at most ``constant rate^{d(u,q)}``, shape (N d, N d).

    If `extreme`, all blocks are that number times ``1 1'/d``: their products add up without any
    cancellation. Else they are normal, with norms uniform up to the bound.
    """
    N = network.vertices
    limit = constant * rate ** distances(network)
    if extreme:
        return np.kron(limit, np.full((d, d), 1.0 / d))
    blocks = rng.standard_normal((N, N, d, d))
    size = np.linalg.norm(blocks, 2, axis=(2, 3))
    blocks *= (limit * rng.random((N, N)) / size)[:, :, None, None]
    return blocks.swapaxes(1, 2).reshape(N * d, N * d)
