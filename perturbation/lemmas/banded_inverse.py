r"""``thm:graph-induced-band-mat-inverse``: inverses of graph-banded matrices decay."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy import sparse

from ...bounds.decay import demko, g
from ...graphs import InputError, Network, parse_graph
from ...lpc.arrays import Floats, Ints
from ..comparison import Comparison, worst
from ..sensitivity import solve_refined
from ._hierarchy import distances
from ._specimen import GRAPHS, Specimen, drawn

LABEL = "thm:graph-induced-band-mat-inverse"
TITLE = "inverses of graph-banded matrices decay"


@dataclass(frozen=True, eq=False)
class Banded:
    """A positive definite A, q-banded on a graph, and a block diagonal ``D >= 0``.

    Parameters
    ----------
    distance : ndarray, shape (V, V)
        Of the vertices; infinite between components.
    sizes : ndarray, shape (V,)
        How many rows each vertex has, p_i.
    A, D : ndarray, shape (p, p), ``p = sum p_i``
    q : int
        Even; blocks of A vanish at distances above ``q/2``.
    least, largest : float
        The extreme eigenvalues of A, or bounds on them.
    """

    distance: Floats
    sizes: Ints
    A: Floats
    D: Floats
    q: int
    least: float
    largest: float

    def __post_init__(self) -> None:
        if self.q < 2 or self.q % 2:
            raise InputError(f"q = {self.q}: an even integer >= 2 is needed", "q")
        if not 0 < self.least <= self.largest:
            raise InputError(f"eigenvalues {self.least:g}, {self.largest:g}: 0 < a_0 <= b_0")

    @property
    def owner(self) -> Ints:
        """The vertex of every row."""
        return np.repeat(np.arange(len(self.sizes)), self.sizes)

    def hypotheses(self) -> bool:
        """Whether A is banded with eigenvalues as said, and D block diagonal and ``>= 0``."""
        apart = self.distance[np.ix_(self.owner, self.owner)]
        values = np.linalg.eigvalsh(self.A)
        slack = 1e-12 * self.largest
        within = self.least - slack <= values[0] and values[-1] <= self.largest + slack
        pattern = not self.A[apart > self.q / 2].any() and not self.D[apart > 0].any()
        scale = np.abs(self.D).max(initial=0.0)
        return bool(within and pattern and np.linalg.eigvalsh(self.D)[0] >= -1e-12 * scale)


def compare(
    banded: Banded,
    sets: Sequence[tuple[Ints, Ints]],
    *,
    part: str = "",
    instance: str = "",
    seed: int | None = None,
) -> tuple[Comparison, ...]:
    r"""Compare blocks of ``(A + D)^{-1}`` between sets of vertices with their bound.

    .. math:: \|((A+D)^{-1})_{S_R,S_C}\| \le C \gamma^{\hat d}, \qquad
        \gamma = \Big(\frac{\sqrt\kappa-1}{\sqrt\kappa+1}\Big)^{2/q},
        \quad \kappa = b_0/a_0, \quad \hat d = d(S_R, S_C).

    *stated* has ``C = 2/a_0``; *sharp* ``C = c(kappa)/a_0`` and the exponent
    ``ceil(2 d/q)`` of ``gamma^{q/2}``; *exact* leaves out the maximum in c, which is 1 at distance
    0 and ``(1 + sqrt(kappa))^2/(2 kappa)`` elsewhere, and is attained at every distance, see
    `extremal_path`. As kappa goes to 1 the three meet.

    Parameters
    ----------
    banded : Banded
    sets : sequence of (rows, columns)
        Pairs of nonempty arrays of vertices, S_R and S_C.
    part : str
        Goes before the names of the parts.
    instance, seed
        As in `Comparison`.

    References
    ----------
    Paper, ``thm:graph-induced-band-mat-inverse``; Demko, Moss, Smith, *Decay rates for inverses
    of band matrices*, Math. Comp. 43 (1984), Theorem 2.4.
    """
    inverse = solve_refined(sparse.csr_array(banded.A + banded.D), np.eye(len(banded.A)))
    owner = banded.owner
    rows = [np.isin(owner, R) for R, _ in sets]
    columns = [np.isin(owner, C) for _, C in sets]
    norms = [np.linalg.norm(inverse[np.ix_(*z)], 2) for z in zip(rows, columns, strict=True)]
    apart = np.array([banded.distance[np.ix_(R, C)].min() for R, C in sets])
    kappa = banded.largest / banded.least
    base = float(g(kappa - 1))
    decayed = base ** np.ceil(2 * apart / banded.q) / banded.least
    bounds = {
        "stated": 2 / banded.least * base ** (2 * apart / banded.q),
        "sharp": float(demko(kappa)) * decayed,
        "exact": np.where(apart > 0, (1 + kappa**0.5) ** 2 / (2 * kappa), 1.0) * decayed,
    }
    holds = banded.hypotheses()
    return tuple(
        c
        for tier, bound in bounds.items()
        for c in worst(
            LABEL,
            part + tier,
            np.array(norms),
            bound,
            instance=instance,
            seed=seed,
            hypotheses=holds,
        )
    )


def measure(seed: int) -> tuple[Comparison, ...]:
    """Compare on a random banded matrix, and on the Hessian of a random local problem."""
    rng = np.random.default_rng([seed, 3])
    graph = str(rng.choice(GRAPHS))
    q, kappa = int(rng.choice([2, 4, 6])), float(10 ** rng.uniform(0, 4))
    banded = random_banded(parse_graph(graph, seed), q, kappa, rng)
    text = f"{graph}, q = {q}, kappa = {kappa:.6g}, sizes {banded.sizes.tolist()}"
    found = compare(banded, pairs(banded, rng), instance=text, seed=seed)
    specimen = drawn(seed, k=4)
    hessian = of_specimen(specimen)
    text = specimen.text
    return found + compare(hessian, pairs(hessian, rng), part="Hessian, ", instance=text, seed=seed)


def pairs(banded: Banded, rng: np.random.Generator) -> list[tuple[Ints, Ints]]:
    """Return all pairs of single vertices, and 10 random pairs of sets."""
    V = len(banded.sizes)
    single = [(np.array([i]), np.array([j])) for i in range(V) for j in range(V)]
    draws = rng.integers(1, V + 1, (10, 2))
    return single + [(rng.permutation(V)[:a], rng.permutation(V)[:b]) for a, b in draws]


def random_banded(network: Network, q: int, kappa: float, rng: np.random.Generator) -> Banded:
    """Return a random A of condition number kappa, with blocks of 1 to 3 rows, and a random D."""
    distance = distances(network)
    sizes = rng.integers(1, 4, network.vertices)
    owner = np.repeat(np.arange(network.vertices), sizes)
    apart = distance[np.ix_(owner, owner)]
    B = rng.standard_normal(apart.shape) * (apart <= q / 2)
    values = np.linalg.eigvalsh(B + B.T)
    spread = max(float(values[-1] - values[0]), 1e-9)  # a single row: A is 1
    A = np.eye(len(B)) * (1 - (kappa - 1) / spread * values[0]) + (kappa - 1) / spread * (B + B.T)
    root = rng.standard_normal(apart.shape) * (apart == 0)
    D = float(rng.choice([0.0, 0.1, 1.0, 100.0])) * root @ root.T
    return Banded(distance, sizes, A, D, q, 1.0, kappa)


def of_specimen(specimen: Specimen) -> Banded:
    """Return M of a local problem on time x network: ``mu I`` plus couplings, plus the rest.

    The couplings' Hessian lies between 0 and ``2 l_T + Delta l_S``; the node costs, less mu, are
    D.
    """
    found, p = specimen.hierarchy, specimen.parameters
    local = found.local
    t, v = local.terms.free[:, 1], local.terms.free[:, 2]
    own = local.problem.node.hessian(t, v, found.x) - p.mu * np.eye(found.n)
    D = np.zeros_like(found.M)
    for i, block in enumerate(own):
        D[i * found.n : (i + 1) * found.n, i * found.n : (i + 1) * found.n] = block
    steps = np.abs(np.subtract.outer(t, t))
    row = np.searchsorted(found.agents, v)
    apart = steps + found.inner_distance[np.ix_(row, row)]
    largest = p.mu * (1 + 2 * p.a_T + specimen.x)
    return Banded(apart, np.full(len(t), found.n), found.M - D, D, 2, float(p.mu), float(largest))
