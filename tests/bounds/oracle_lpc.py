"""LPC by brute force on quadratic networks: nothing here comes from nearsight.

The costs are sums of squares, ``|R x + W omega|^2 / 2`` in all, with the trajectory
``x = (x_1, ..., x_H)`` and the data ``omega = (x_0, theta_1, ..., theta_H, shifts)``. With
mu = 1 the row blocks are

* node costs ``|F (x - theta)|^2 / 2`` with ``I <= F'F <= l_f I``,
* temporal and spatial costs ``|G z - shift|^2 / 2`` of two blocks z with ``G'G <= l I``.
"""

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations

import numpy as np
from scipy.sparse.csgraph import shortest_path


@dataclass(frozen=True, eq=False)
class Graph:
    """Vertices 0 .. N-1 and edges (E, 2); distances by scipy."""

    vertices: int
    edges: np.ndarray

    @classmethod
    def of(cls, network):
        """Take vertices and edges, and nothing else, from a nearsight `Network`."""
        ends = [(u, int(v)) for u in range(network.vertices) for v in network.neighbours(u)]
        edges = np.array([e for e in ends if e[0] < e[1]], dtype=int)
        return cls(network.vertices, edges.reshape(-1, 2))

    @cached_property
    def distance(self):
        matrix = np.zeros((self.vertices, self.vertices))
        matrix[tuple(self.edges.T)] = 1
        return shortest_path(matrix, directed=False, unweighted=True)

    @cached_property
    def degree(self):
        return int(np.bincount(self.edges.ravel(), minlength=self.vertices).max())


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


@dataclass(frozen=True, eq=False)
class Instance:
    """A network with quadratic costs over steps 1 .. H, n numbers an agent and step.

    Parameters
    ----------
    node : array (H, N, n, n)
        Factors F.
    temporal : array (H, N, p, 2n)
        Factors G of ``(x_{t-1}, x_t)``.
    spatial : array (H, E, p, 2n)
        Factors G of ``(x_u, x_v)``, edge by edge.
    shifts : bool
        Whether the couplings have shifts of their own among the data.
    """

    graph: Graph
    node: np.ndarray
    temporal: np.ndarray
    spatial: np.ndarray
    shifts: bool = False

    @property
    def H(self):
        return self.node.shape[0]

    @property
    def n(self):
        return self.node.shape[-1]

    @property
    def slice(self):
        """Numbers a step."""
        return self.graph.vertices * self.n

    def at(self, t, v):
        """Positions of (t, v) in x, for t = 1 .. H."""
        start = ((t - 1) * self.graph.vertices + v) * self.n
        return np.arange(start, start + self.n)

    def where(self, pairs):
        """Positions of many (t, v)."""
        return np.concatenate([self.at(t, v) for t, v in pairs] or [np.zeros(0, int)])

    @cached_property
    def rows(self):
        """``(R, W)`` of the cost ``|R x + W omega|^2 / 2``."""
        n, size = self.n, self.H * self.slice
        blocks = [(F, [(t, v)]) for (t, v), F in _enumerate(self.node)]
        pairs = [(G, [(t - 1, v), (t, v)]) for (t, v), G in _enumerate(self.temporal)]
        edges = self.graph.edges
        pairs += [(G, [(t, u) for u in edges[e]]) for (t, e), G in _enumerate(self.spatial)]
        extra = sum(len(G) for G, _ in pairs) if self.shifts else 0
        total = sum(len(G) for G, _ in blocks + pairs)
        R, W = np.zeros((total, size)), np.zeros((total, self.slice + size + extra))
        row, shift = 0, self.slice + size
        for G, ends in blocks + pairs:
            here = slice(row, row + len(G))
            for i, (t, v) in enumerate(ends):
                part = G[:, i * n : (i + 1) * n]
                if t == 0:
                    W[here, v * n : (v + 1) * n] += part
                else:
                    R[here, self.at(t, v)] += part
            if len(ends) == 1:
                W[here, self.slice + self.at(*ends[0])] -= G
            elif self.shifts:
                W[here, shift : shift + len(G)] = -np.eye(len(G))
                shift += len(G)
            row += len(G)
        return R, W

    @cached_property
    def gradient(self):
        """``(M, C)`` of the gradient ``M x + C omega``."""
        R, W = self.rows
        return R.T @ R, R.T @ W

    @cached_property
    def optimum(self):
        """The clairvoyant trajectory as a linear map of omega."""
        M, C = self.gradient
        return -np.linalg.solve(M, C)

    @cached_property
    def targets(self):
        """theta as a linear map of omega."""
        size = self.H * self.slice
        theta = np.zeros((size, self.rows[1].shape[1]))
        theta[:, self.slice : self.slice + size] = np.eye(size)
        return theta

    def free(self, t, v, k, r):
        """The free variables of the local problem of (t, v), those past H left out."""
        ball = np.flatnonzero(self.graph.distance[v] <= r - 1)
        return [(s, u) for s in range(t, min(t + k - 2, self.H) + 1) for u in ball]

    def lpc(self, k, r):
        """LPC's trajectory as a linear map of omega; past H nothing is coupled."""
        M, C = self.gradient
        actions = np.zeros_like(self.targets)
        for t in range(1, self.H + 1):
            known = self.targets.copy()  # of all steps but the one before
            before = slice(max(t - 2, 0) * self.slice, (t - 1) * self.slice)
            known[before] = actions[before]
            for v in range(self.graph.vertices):
                free = self.where(self.free(t, v, k, r))
                touched = np.setdiff1d(np.flatnonzero(M[free].any(axis=0)), free)
                right = M[np.ix_(free, touched)] @ known[touched] + C[free]
                plan = -np.linalg.solve(M[np.ix_(free, free)], right)
                here = self.at(t, v)
                actions[here] = plan[np.searchsorted(free, here)]
        return actions

    def worst(self, k, r):
        """The largest ``cost(LPC)/OPT - 1`` over all omega, and such an omega.

        ``cost(LPC) - OPT = |x - x*|_M^2 / 2`` exactly, so nothing is subtracted. The
        quotient lives on the range of OPT: where OPT is 0, LPC pays nothing either.
        """
        root, basis = self.range
        off = root @ (self.lpc(k, r) - self.optimum)
        _, top, directions = np.linalg.svd(off @ basis, full_matrices=False)
        return top[0] ** 2, basis @ directions[0]

    @cached_property
    def range(self):
        """A root of M, and a basis of the range of OPT in which OPT is ``|.|^2 / 2``."""
        R, W = self.rows
        _, s, V = np.linalg.svd(W + R @ self.optimum, full_matrices=False)
        kept = s > 1e-7 * s[0]
        return np.linalg.cholesky(self.gradient[0]).T, V[kept].T / s[kept]

    def cost(self, x, omega):
        """The cost of trajectories, column by column."""
        R, W = self.rows
        return 0.5 * np.sum((R @ x + W @ omega) ** 2, axis=0)


def _enumerate(array):
    """Yield ``((t, i), matrix)``, steps counted from 1."""
    for index in np.ndindex(array.shape[:2]):
        yield (index[0] + 1, index[1]), array[index]


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


# -- constraints, by projected gradient, many data at once (columns) ------------------------


@dataclass(frozen=True, eq=False)
class Sets:
    """For each variable block a box or a disc around a centre (the other one infinite).

    ``centre`` (size, B), ``box`` (size, B) half widths, ``disc`` (size/n, B) radii.
    """

    n: int
    centre: np.ndarray
    box: np.ndarray
    disc: np.ndarray

    def onto(self, x, free):
        """Project the blocks at the positions ``free``, which are whole blocks."""
        off = x - self.centre[free]
        blocks = free[:: self.n] // self.n
        size = np.linalg.norm(off.reshape(len(blocks), self.n, -1), axis=1)
        shrink = np.minimum(1.0, self.disc[blocks] / np.maximum(size, 1e-300))
        off = off * np.repeat(shrink, self.n, axis=0)
        return self.centre[free] + np.clip(off, -self.box[free], self.box[free])


def minimise(M, q, sets, free, x):
    """``argmin x'Mx/2 + q'x`` over the sets, for every column of q."""
    values = np.linalg.eigvalsh(M)
    step, root = 1 / values[-1], np.sqrt(values[0] / values[-1])
    momentum = (1 - root) / (1 + root)
    x = ahead = sets.onto(x, free)
    for _ in range(5000):
        new = sets.onto(ahead - step * (M @ ahead + q), free)
        ahead = new + momentum * (new - x)
        moved, x = np.abs(new - x).max(), new
        if moved < 1e-15 * max(1.0, np.abs(new).max()):
            break
    assert np.abs(sets.onto(x - step * (M @ x + q), free) - x).max() < 1e-12
    return x


@dataclass(frozen=True, eq=False)
class Played:
    """Trajectories of a constrained play, one a column."""

    lpc: np.ndarray
    optimum: np.ndarray
    theta: np.ndarray


def play(instance, omega, sets, k, r):
    """LPC and the optimum under constraints; theta minimises the node cost within its set."""
    M, C = instance.gradient
    every = np.arange(instance.H * instance.slice)
    centre = omega[instance.slice :][: every.size]
    curvature = np.zeros_like(M)
    for (t, v), F in _enumerate(instance.node):
        here = instance.at(t, v)
        curvature[np.ix_(here, here)] = F.T @ F
    theta = minimise(curvature, -curvature @ centre, sets, every, centre)
    right = C @ omega
    optimum = minimise(M, right, sets, every, instance.optimum @ omega)
    actions = np.zeros_like(theta)
    for t in range(1, instance.H + 1):
        known = theta.copy()
        before = slice(max(t - 2, 0) * instance.slice, (t - 1) * instance.slice)
        known[before] = actions[before]
        for v in range(instance.graph.vertices):
            free = instance.where(instance.free(t, v, k, r))
            touched = np.setdiff1d(np.flatnonzero(M[free].any(axis=0)), free)
            q = M[np.ix_(free, touched)] @ known[touched] + right[free]
            plan = minimise(M[np.ix_(free, free)], q, sets, free, known[free])
            here = instance.at(t, v)
            actions[here] = plan[np.searchsorted(free, here)]
    return Played(actions, optimum, theta)


def random_sets(rng, instance, columns, scale=1.0):
    """Boxes and discs of many sizes, some of them all of R^n."""
    size, n = instance.H * instance.slice, instance.n
    shape = (size // n, columns)
    width = scale * rng.choice([0.0, 0.1, 0.5, 2.0, np.inf], size=shape)
    is_disc = rng.random(shape) < (0.5 if n > 1 else 0.0)
    disc = np.where(is_disc, width, np.inf)
    box = np.repeat(np.where(is_disc, np.inf, width), n, axis=0)
    centre = scale * rng.choice([0.0, 0.5]) * rng.normal(size=(size, columns))
    return Sets(n, centre, box, disc)


def everywhere(instance, columns):
    """No constraints."""
    size, n = instance.H * instance.slice, instance.n
    infinite = np.full((size, columns), np.inf)
    return Sets(n, np.zeros((size, columns)), infinite, infinite[: size // n])


# -- one local problem ----------------------------------------------------------------------


@dataclass(frozen=True, eq=False)
class Sensitivity:
    """How the free variables of a local problem follow its boundary.

    ``free`` and ``boundary`` list (step, vertex), the bottom being step 0; ``part`` names
    each boundary variable ("lateral", "top", "bottom"); ``map`` (n |free|, n |boundary|).
    """

    free: list
    boundary: list
    part: np.ndarray
    map: np.ndarray
    n: int

    @cached_property
    def size(self):
        """Norms of the blocks of the map, (|free|, |boundary|)."""
        blocks = self.map.reshape(len(self.free), self.n, len(self.boundary), self.n)
        return np.linalg.norm(blocks, 2, axis=(1, 3))

    def gaps(self, graph):
        """Distances in time and in space between free and boundary variables."""
        (s, u), (t, w) = (np.array(z).T for z in (self.free, self.boundary))
        return np.abs(s[:, None] - t), graph.distance[u][:, w].astype(int)


def sensitivity(instance, v, k, r):
    """The local problem of (1, v): free steps 1 .. k-1, top k, bottom 0."""
    assert k <= instance.H
    graph, (M, C) = instance.graph, instance.gradient
    free = instance.free(1, v, k, r)
    inside = np.flatnonzero(graph.distance[v] <= r - 1)
    rim = np.flatnonzero(graph.distance[v] == r)
    lateral = [(s, u) for s in range(1, k) for u in rim]
    top, bottom = [(k, u) for u in inside], [(0, u) for u in inside]
    positions = instance.where(free)
    first = np.concatenate([np.arange(u * instance.n, (u + 1) * instance.n) for u in inside])
    across = np.hstack(
        [M[np.ix_(positions, instance.where(lateral + top))], C[positions][:, first]]
    )
    part = np.repeat(["lateral", "top", "bottom"], [len(lateral), len(top), len(bottom)])
    moved = -np.linalg.solve(M[np.ix_(positions, positions)], across)
    return Sensitivity(free, lateral + top + bottom, part, moved, instance.n)


def connected_graph(vertices, parents, extra):
    """A spanning tree (``parents[i-1] < i`` after a modulo) and a choice of other edges."""
    tree = {(p % i, i) for i, p in zip(range(1, vertices), parents, strict=True)}
    others = [e for e in combinations(range(vertices), 2) if e not in tree]
    chosen = {others[i % len(others)] for i in extra} if others else set()
    return Graph(vertices, np.array(sorted(tree | chosen), dtype=int).reshape(-1, 2))
