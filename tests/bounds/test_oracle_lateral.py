"""The lateral energy bounds (E2) against the rows of all agents at once."""

import numpy as np
import pytest

from nearsight.bounds import energy
from nearsight.bounds.decay import slice_decay

from . import oracles as oracle
from .oracle_support import GUARD, graph, growth, result

ROWS = {"own": energy.OWN, "next": energy.NEXT, "neighbours": energy.NEIGHBOURS}
ENERGY = [
    ("ring:9", 2, 1, 1.0, 1.0),
    ("ring:9", 3, 2, 0.3, 1.0),
    ("ring:9", 4, 3, 3.0, 3.0),
    ("path:7", 3, 2, 1.0, 0.1),
    ("star:5", 3, 1, 0.1, 1.0),
    ("complete:4", 4, 1, 0.5, 0.5),
    ("cubic tree", 3, 2, 1.0, 2.0),
    ("grid:3x3", 3, 2, 0.2, 2.0),
    ("ring-of-blocks:4x2", 2, 2, 1.0, 1.0),
    ("ring-of-blocks:6x2", 3, 2, 1.0, 4.0),
]


def eta(found, r):
    """``max_u sum_{v: d(u,v)=r} #{w ~ u: d(v,w) = r-1}`` by its definition."""
    d = found.distance
    return max(
        sum(
            np.count_nonzero((d[u] == 1) & (d[v] == r - 1))
            for v in range(found.vertices)
            if d[u, v] == r
        )
        for u in range(found.vertices)
    )


def weights(row, a, a_S, found, k, r, share):
    """(E2) from its text: A and w for ``F = share/200``; None if it admits no weights."""
    x, F = found.degree * a_S, share / 200
    if k == 2:
        F = 0.0
    b = {2: 0.0, 3: 0.5}.get(k, 1.0)
    e = {"own": a, "neighbours": a, "next": a if k == 3 else 2 * a}[row] if k > 2 else 0.0
    alpha = np.arccosh(1 + F / (b * a)) if k > 2 else 0.0
    beta = np.arccosh(1 + 2 * (1 - F) / x)
    around = max(found.degree - 1, 1) * a_S if row == "neighbours" else x
    q, j0 = (2 * r - 3 if row == "neighbours" else 2 * r - 1), int(row == "next")
    X = e * np.exp(alpha) + around * np.exp(beta)
    below = 4 + 4 * (e + around) - 2 * e * around * (np.cosh(alpha - beta) - 1)
    if below <= 0:
        return None
    A = a_S * eta(found, r) / 4 * (4 * X / below) * np.exp(-beta * q)
    return A, np.exp(-2 * alpha * np.abs(np.arange(k - 1) - j0))


def row_map(instance, row, k, r):
    """All agents' rows as a linear map of the lateral field ``dz`` (step by step, all agents)."""
    found, n = instance.graph, instance.n
    parts = []
    for v in range(found.vertices):
        s = oracle.sensitivity(instance, v, k, r)
        if "lateral" not in s.part:
            continue
        step = 2 if row == "next" else 1
        whose = np.flatnonzero(found.distance[v] == 1) if row == "neighbours" else [v]
        take = [i for i, (t, u) in enumerate(s.free) if t == step and u in whose]
        part = np.zeros((len(take) * n, (k - 1) * instance.slice))
        for j in np.flatnonzero(s.part == "lateral"):
            t, u = s.boundary[j]
            column = instance.at(t, u)
            blocks = [s.map[i * n : (i + 1) * n, j * n : (j + 1) * n] for i in take]
            part[:, column] = np.vstack(blocks)
        parts.append(part)
    return np.vstack(parts)


def largest_response(L, sizes, rng):
    """``max |L dz|`` over fields whose step j has size ``sizes[j]``, by ascent."""
    best = 0.0
    for _ in range(4):
        z = rng.normal(size=(len(sizes), L.shape[1] // len(sizes)))
        for _ in range(60):
            z *= (sizes / np.linalg.norm(z, axis=1))[:, None]
            value = np.linalg.norm(L @ z.ravel())
            best, z = max(best, value), (L.T @ (L @ z.ravel())).reshape(z.shape)
            z += 1e-300
    return best


CASES = [
    (row, *case)
    for row, (k, r) in {"own": (2, 1), "next": (3, 1), "neighbours": (2, 2)}.items()
    for case in ENERGY
    if case[1] >= k and case[2] >= r
]


@pytest.mark.parametrize(("row", "spec", "k", "r", "a", "x"), CASES)
def test_lateral_energy(row, spec, k, r, a, x):
    found, rng = graph(spec), np.random.default_rng(6)
    a_S = x / found.degree
    count = growth(spec).eta(r)
    assert count == eta(found, r)
    c = energy.Couplings(a, a_S, 1.0, found.degree)
    shares = [1, 20, 60, 100, 140, 180, 199]
    s = [float(slice_decay(a, d)) for d in range(k + 1)]
    sizes = {
        "D_part": np.ones(k - 1),
        "y_part": np.array([s[j + 1] for j in range(k - 1)]),
        "Z_part": np.array([s[k - 1 - j] for j in range(k - 1)]),
    }
    highest = {"weighted": 0.0, **dict.fromkeys(sizes, 0.0)}
    for trial in range(9):
        instance = oracle.random_instance(
            rng,
            found,
            k,
            a,
            a_S,
            l_f=rng.choice([1.0, 3.0]) if trial else 1.0,
            n=1 if trial % 3 or found.vertices > 7 else 2,
            style=oracle.STYLES[trial % 3],
        )
        L = row_map(instance, row, k, r)
        response = {part: largest_response(L, size, rng) for part, size in sizes.items()}
        for share in shares:
            bound = energy.row_bound(ROWS[row], c, count, k, r, share)
            by_text = weights(row, a, a_S, found, k, r, share)
            if by_text is None:
                assert bound.D_part == np.inf
                continue
            A, w = by_text
            scaled = L / np.sqrt(np.repeat(w, instance.slice))
            ratio = np.linalg.norm(scaled, 2) ** 2 / A
            assert ratio <= GUARD
            highest["weighted"] = max(highest["weighted"], ratio)
            for part, size in sizes.items():
                promise = getattr(bound, part)
                assert promise == pytest.approx(np.sqrt(A * np.sum(w * size**2)), rel=1e-9)
                assert response[part] <= promise * GUARD
                highest[part] = max(highest[part], response[part] / promise)
        listed = result("nearsight:lateral-energy", "sharp", spec, a, x, k, r)
        assert listed.guarantee
        assert response["D_part"] <= listed.values[row] * GUARD
    assert min(highest.values()) > 0.02
