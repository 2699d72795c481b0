"""Random problems of every kind, and an oracle that knows nothing of `nearsight.lpc`'s solvers."""

import functools
import warnings

import cvxpy
import numpy as np

from nearsight.graphs import Network
from nearsight.lpc.costs import LogCosh, Quadratic, Softplus
from nearsight.lpc.problem import Problem
from nearsight.lpc.sets import Ball, Box, Constraints, Everywhere

EDGES = {
    "ring": [(0, 1), (1, 2), (2, 3), (3, 4), (0, 4)],
    "tree": [(0, 1), (0, 2), (2, 3), (2, 4)],
    "dense": [(0, 1), (0, 2), (1, 2), (1, 3), (2, 4), (3, 4)],
}
SETS = ("everywhere", "box", "ball", "formulas")
COSTS = ("quadratic", "log_cosh", "softplus")


def spd(rng, shape, s, least):
    factor = rng.normal(size=(*shape, s, s))
    return factor @ factor.swapaxes(-1, -2) / s + least * np.eye(s)


def random_problem(seed, n=1, H=4, costs="quadratic", feasible="everywhere", graph="ring"):
    rng = np.random.default_rng(seed)
    network = Network.from_edges(5, EDGES[graph])
    N, E = 5, len(EDGES[graph])
    if costs == "quadratic":
        node = Quadratic(spd(rng, (H, N), n, 0.5), 2 * rng.normal(size=(H, N, n)))
        temporal = Quadratic(spd(rng, (H, N), 2 * n, 0.0), rng.normal(size=(H, N, 2 * n)))
        spatial = Quadratic(spd(rng, (H, E), 2 * n, 0.0), rng.normal(size=(H, E, 2 * n)))
    else:
        kind = {"log_cosh": LogCosh, "softplus": Softplus}[costs]

        def ridge(members, s, base):
            return kind(
                rng.normal(size=(H, members, 2, s)),
                rng.normal(size=(H, members, 2)),
                rng.uniform(0.5, 2, size=(H, members, 2)),
                base,
                2 * rng.normal(size=(H, members, s)) if base else 0.0,
            )

        node, temporal, spatial = ridge(N, n, 0.7), ridge(N, 2 * n, 0.0), ridge(E, 2 * n, 0.0)
    x_0 = rng.normal(size=(N, n))
    return Problem(network, H, node, temporal, spatial, sets(feasible, rng, (H, N), n), x_0)


def sets(kind, rng, shape, n):
    if kind == "everywhere":
        return Everywhere()
    if kind == "box":
        low = -rng.uniform(0.1, 1, size=(*shape, n))
        return Box(np.where(rng.random(low.shape) < 0.2, -np.inf, low), low + 1)
    if kind == "ball":
        return Ball(0.3 * rng.normal(size=(*shape, n)), rng.uniform(0.2, 1, size=shape))
    names = [f"y{j}" for j in range(n)]
    ellipse = " + ".join(f"{j + 1}*{name}**2" for j, name in enumerate(names)) + " - r"
    return Constraints(
        [ellipse, f"{names[0]} - c"], names, {"r": rng.uniform(0.3, 2, size=shape), "c": 0.4}
    )


def belongs(problem, t, v, y):
    """The constraints of a CVXPY variable."""
    feasible = problem.feasible
    if isinstance(feasible, Box):
        low, high = feasible.lower[t - 1, v], feasible.upper[t - 1, v]
        there = np.flatnonzero(np.isfinite(low))
        return [y <= high] + ([y[there] >= low[there]] if len(there) else [])
    if isinstance(feasible, Ball):
        return [cvxpy.sum_squares(y - feasible.centre[t - 1, v]) <= feasible.radius[t - 1, v] ** 2]
    if isinstance(feasible, Constraints):
        weights = np.arange(1, problem.n + 1)
        return [weights @ cvxpy.square(y) <= feasible.parameters["r"][t - 1, v], y[0] <= 0.4]
    return []


def charge(cost, t, i, w):
    """One cost of a CVXPY expression."""
    if isinstance(cost, Quadratic):
        T, members = cost.matrix.shape[:2]
        factor = np.linalg.cholesky(
            cost.matrix[min(t, T) - 1, min(i, members - 1)] + 1e-14 * np.eye(cost.size)
        )
        T, members = cost.centre.shape[:2]
        off = w - cost.centre[min(t, T) - 1, min(i, members - 1)]
        return 0.5 * cvxpy.sum_squares(factor.T @ off)
    a, b, c = (part[t - 1, i] for part in (cost.directions, cost.shifts, cost.weights))
    z = a @ w - b
    base, centre = cost.base[0, 0], cost.centre[min(t, len(cost.centre)) - 1]
    centre = centre[min(i, len(centre) - 1)]
    phi = cvxpy.logistic(z) if cost.kind == "softplus" else cvxpy.logistic(2 * z) - z
    return c @ phi + 0.5 * base * cvxpy.sum_squares(w - centre)


def oracle(problem, free, known):
    """Solve for the free actions (t, v), given the others as a dict (t, v) -> action.

    Every cost of a free action within the horizon counts, as the paper writes it.
    """
    variables = {key: cvxpy.Variable(problem.n) for key in free}

    def at(t, v):
        return variables.get((t, v), known.get((t, v)))

    total, rules = [], []
    for t, v in free:
        total.append(charge(problem.node, t, v, variables[t, v]))
        rules += belongs(problem, t, v, variables[t, v])
    for t in range(1, problem.H + 1):
        for v in range(problem.N):
            if (t, v) in variables or (t - 1, v) in variables:
                total.append(charge(problem.temporal, t, v, cvxpy.hstack([at(t, v), at(t - 1, v)])))
        for e, (u, v) in enumerate(problem.edges.tolist()):
            if (t, u) in variables or (t, v) in variables:
                total.append(charge(problem.spatial, t, e, cvxpy.hstack([at(t, u), at(t, v)])))
    program = cvxpy.Problem(cvxpy.Minimize(sum(total)), rules)
    tight = dict.fromkeys(("tol_gap_abs", "tol_gap_rel", "tol_feas"), 1e-12)
    with warnings.catch_warnings():
        # asked for all it can give, Clarabel may say that it gave a little less; the test compares
        warnings.filterwarnings("ignore", "Solution may be inaccurate")
        program.solve(solver="CLARABEL", max_iter=200, **tight)
    return np.array([variables[key].value for key in free])


def clarabel_error(problem):
    """How far its answers are off: a gap of 1e-12 at curved constraints allows 1e-6, seen 3e-6."""
    return 1e-7 if isinstance(problem.feasible, Everywhere | Box) else 5e-6


def everything(problem):
    return [(t, v) for t in range(1, problem.H + 1) for v in range(problem.N)]


@functools.cache
def oracle_optimum(*arguments):
    problem = random_problem(*arguments)
    start = {(0, v): problem.x_0[v] for v in range(problem.N)}
    found = oracle(problem, everything(problem), start)
    return found.reshape(problem.H, problem.N, problem.n)


def dense_system(problem):
    """``A, b`` with gradient ``A x - b`` of a quadratic problem, assembled cost by cost."""
    n, H, N = problem.n, problem.H, problem.N
    size = H * N * n
    A, b = np.zeros((size, size)), np.zeros(size)

    def add(cost, t, i, keys):
        pick = np.zeros((cost.size, size))
        w = np.zeros(cost.size)
        for j, (s, v) in enumerate(keys):
            here = slice(j * n, (j + 1) * n)
            if s == 0:
                w[here] = problem.x_0[v]
            else:
                at = ((s - 1) * N + v) * n
                pick[here, at : at + n] = np.eye(n)
        P = np.broadcast_to(cost.matrix, (H, *cost.matrix.shape[1:]))[t - 1]
        P = P[min(i, len(P) - 1)]
        c = np.broadcast_to(cost.centre, (H, *cost.centre.shape[1:]))[t - 1]
        c = c[min(i, len(c) - 1)]
        A[...] += pick.T @ P @ pick
        b[...] += pick.T @ P @ (c - w)

    for t in range(1, H + 1):
        for v in range(N):
            add(problem.node, t, v, [(t, v)])
            add(problem.temporal, t, v, [(t, v), (t - 1, v)])
        for e, (u, v) in enumerate(problem.edges.tolist()):
            add(problem.spatial, t, e, [(t, u), (t, v)])
    return A, b


def reference(problem, x):
    """The optimum of a quadratic problem in long doubles, by projected gradient steps from x."""
    A, b = (part.astype(np.longdouble) for part in dense_system(problem))
    y, size = x.astype(np.longdouble).ravel(), np.linalg.norm(A.astype(float), 2)
    for _ in range(1500):
        y = projected(problem, (y - (A @ y - b) / size).reshape(x.shape)).ravel()
    return y.reshape(x.shape)


def projected(problem, x):
    feasible = problem.feasible
    if isinstance(feasible, Box):
        return np.clip(x, feasible.lower, feasible.upper)
    if isinstance(feasible, Ball):
        off = x - feasible.centre
        length = np.sqrt((off**2).sum(axis=-1, keepdims=True))
        return feasible.centre + off * np.minimum(1, feasible.radius[..., None] / length)
    return x


def cost_in_long_doubles(problem, x):
    """``x' A x / 2 - b' x``: the cost up to a constant."""
    A, b = (part.astype(np.longdouble) for part in dense_system(problem))
    return x.ravel() @ (A @ x.ravel()) / 2 - b @ x.ravel()
