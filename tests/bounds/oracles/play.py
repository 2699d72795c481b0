"""Constrained play by projected gradient, many data at once (columns)."""

from dataclasses import dataclass

import numpy as np

from .instance import by_step


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
    for (t, v), F in by_step(instance.node):
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
