"""Instances with given constants: uniform, random, at given angles, and worse by climbing."""

import numpy as np

from .instance import Instance


def difference(norm, n=1):
    """Factor of ``(l/4) |y - z|^2``, whose Hessian has the norm l."""
    return np.sqrt(norm / 2) * np.hstack([np.eye(n), -np.eye(n)])


def tilted(norm, phi, sign=-1.0):
    """Factors of ``(l/2) (cos(phi) y + sign sin(phi) z)^2``, shape (*phi.shape, 1, 2)."""
    phi = np.asarray(phi)
    return np.sqrt(norm) * np.stack([np.cos(phi), sign * np.sin(phi)], axis=-1)[..., None, :]


def couplings(rng, shape, norm, n, style):
    """Factors of couplings with Hessians of norm at most ``norm``, shape (*shape, 2n, 2n)."""
    found = np.zeros((*shape, 2 * n, 2 * n))
    if style == "difference":
        found[..., :n, :] = difference(norm, n)
    elif style == "tilted":  # near the angle that is worst for one step; one sign for all
        base = rng.choice(
            [np.pi / 4, np.arctan(np.sqrt(1 + norm)), np.arctan(1 / np.sqrt(1 + norm))]
        )
        phi = base + rng.choice([0.0, 0.1, 0.5]) * rng.normal(size=shape)
        pair = tilted(norm, phi, rng.choice([-1.0, 1.0]))
        for i in range(n):
            found[..., i, i::n] = pair[..., 0, :]
    else:  # any Hessian of that norm
        matrix = rng.normal(size=(*shape, 2 * n, 2 * n)) * rng.choice([0.0, 0.3, 1.0], size=2 * n)
        u, s, v = np.linalg.svd(matrix + 1e-3 * rng.normal(size=matrix.shape))
        found = np.sqrt(norm) * np.einsum("...ij,...j,...jk->...ik", u, s / s[..., :1], v)
    return found


def node_factors(rng, shape, l_f, n):
    """Factors F with ``I <= F'F <= l_f I``, shape (*shape, n, n)."""
    _, _, v = np.linalg.svd(rng.normal(size=(*shape, n, n)))
    return np.sqrt(1 + (l_f - 1) * rng.random((*shape, n, 1))) * v


def uniform(graph, H, a, a_S):
    """Uniform difference couplings, node costs ``(x - theta)^2 / 2``."""
    N, E = graph.vertices, len(graph.edges)
    return Instance(
        graph,
        np.ones((H, N, 1, 1)),
        np.broadcast_to(difference(a), (H, N, 1, 2)),
        np.broadcast_to(difference(a_S), (H, E, 1, 2)),
    )


STYLES = ("difference", "tilted", "any")


def random_instance(rng, graph, H, a, a_S, *, l_f=1.0, n=1, style="any", shifts=False):
    """An instance of the class with exactly these constants."""
    N, E = graph.vertices, len(graph.edges)
    return Instance(
        graph,
        node_factors(rng, (H, N), l_f, n),
        couplings(rng, (H, N), a, n, style),
        couplings(rng, (H, E), a_S, n, style),
        shifts,
    )


def angles(graph, H, a, a_S, temporal, spatial):
    """Scalar couplings of full strength at given angles (H, N) and (H, E)."""
    node = np.ones((H, graph.vertices, 1, 1))
    return Instance(graph, node, tilted(a, temporal), tilted(a_S, spatial))


def climb(rng, value, start, rounds, sigma=0.3):
    """Random hill climbing; returns the best value and where it is."""
    best, here = value(start), start
    for _ in range(rounds):
        moved = rng.random(here.size) < rng.choice([1.0, 0.2, 0.05])
        there = here + sigma * moved * rng.normal(size=here.size)
        found = value(there)
        if found > best:
            best, here, sigma = found, there, min(1.0, 1.5 * sigma)
        else:
            sigma = max(0.01, 0.95 * sigma)
    return best, here
