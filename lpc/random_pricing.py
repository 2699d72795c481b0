"""Random pricing problems within the paper's assumptions."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..graphs import InputError, Network
from .pricing import Pricing, ends, load


def random_pricing(
    network: Network,
    H: int,
    *,
    seed: int = 0,
    mu: float = 1.0,
    spread: float = 2.0,
    gamma: float = 0.25,
    carry: float = 0.25,
    complements: float = 0.5,
    cap: float = np.inf,
    x_0: float = 0.0,
) -> Pricing:
    """Return a pricing problem with ``mu/2 <= xi <= spread mu/2``, the lower bound attained.

    Nominal demands are uniform in [1, 2], carries in [0, carry], the two ``|eta|`` of an edge in
    [0, gamma], of one sign; elasticities are what xi then asks for, so that all assumptions of
    the paper hold.

    Parameters
    ----------
    network : Network
    H : int
        The number of steps, at least 1.
    seed : int
        At least 0.
    mu : float
        Strong convexity of the node costs, > 0.
    spread : float
        The largest ratio of two xi, >= 1.
    gamma, carry : float
        The largest ``|eta|`` and b, >= 0.
    complements : float
        The share of edges that join complements, in [0, 1]; the others join substitutes.
    cap : float
        The cap of a price over ``a/(2 xi)``, the best price of a product alone; > 0.
    x_0 : float
        All prices before the first step.

    Raises
    ------
    InputError
        If a number is out of its range.
    """
    counts: tuple[tuple[str, Any, int], ...] = (("H", H, 1), ("seed", seed, 0))
    for name, value, least in counts:
        whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
        if not whole or value < least:
            raise InputError(f"{name} = {value!r}: an integer >= {least} is needed", name)
    for name, number, good, accepted in (
        ("mu", mu, 0 < mu < np.inf, "> 0"),
        ("spread", spread, 1 <= spread < np.inf, ">= 1"),
        ("gamma", gamma, 0 <= gamma < np.inf, ">= 0"),
        ("carry", carry, 0 <= carry < np.inf, ">= 0"),
        ("complements", complements, 0 <= complements <= 1, "within [0, 1]"),
        ("cap", cap, cap > 0, "> 0"),
    ):
        if not good:
            raise InputError(f"{name} = {number}: a number {accepted} is needed", name)
    rng = np.random.default_rng(seed)
    N, E = network.vertices, network.edges
    nominal = rng.uniform(1.0, 2.0, (H, N))
    carries = rng.uniform(0.0, carry, (H, N))
    signs = np.where(rng.random(E) < complements, 1.0, -1.0)
    cross = rng.uniform(0.0, gamma, (H, E, 2)) * signs[:, None]
    xi = rng.uniform(mu / 2, spread * mu / 2, (H, N))
    xi.flat[rng.integers(xi.size)] = mu / 2
    elasticity = xi + load(ends(network), 0.5 * cross[..., 0] + 0.5 * cross[..., 1], carries)
    caps, start = cap * nominal / (2 * xi), np.full(N, x_0)
    return Pricing(network, nominal, elasticity, cross, carries, caps, start)
