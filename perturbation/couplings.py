"""All quadratic costs of a class around given free actions, as a function of free parameters."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from ..bounds import Parameters
from ..bounds.arithmetic import kind_of
from ..graphs import InputError
from ..lpc.arrays import Floats, Ints
from ..lpc.costs import Quadratic
from ..lpc.problem import Problem
from ..lpc.terms import Terms
from .spectra import Spectra


class Blocks(NamedTuple):
    """Hessians of the terms: node (F, n, n), temporal (m, 2 n, 2 n) and spatial (m', 2 n, 2 n)."""

    node: Floats
    temporal: Floats
    spatial: Floats


@dataclass(frozen=True, eq=False)
class Couplings:
    """Every node and pair cost that touches a free action has a Hessian of its own::

        mu I <= node <= l_f I,    0 <= temporal <= l_T I,    0 <= spatial <= l_S I,

    in floating point as well, see `Spectra`. There are no constraints, and targets are 0: they
    do not change the sensitivity of a quadratic problem.

    Parameters
    ----------
    terms : Terms
        Of its costs nothing is used but where they are.
    parameters : Parameters
        The constants of the class, one float each.
    rank : int, optional
        Of the pair blocks. 1 if omitted and n = 1: blocks
        ``l s (cos phi, sin phi)' (cos phi, sin phi)``; else 2 n, which is all of the class.

    References
    ----------
    Paper, Assumption 2.1 (``assump:costs-and-feasible-sets``).
    """

    terms: Terms
    parameters: Parameters
    rank: int | None = None

    def __post_init__(self) -> None:
        p = self.parameters
        values = (p.mu, p.l_f, p.l_T, p.l_S)
        if kind_of(*values) != "float" or any(np.ndim(value) for value in values):
            raise InputError("parameters: one float each is needed", "parameters")
        if len(self.terms.free) == 0:
            raise InputError("nothing is free within the horizon: there is no sensitivity")

    @cached_property
    def families(self) -> tuple[Spectra, Spectra, Spectra]:
        """The node, temporal and spatial blocks."""
        p, n = self.parameters, self.terms.problem.n
        rank = self.rank or (1 if n == 1 else 2 * n)
        temporal, spatial = len(self.terms.temporal.t), len(self.terms.spatial.t)
        return (
            Spectra(len(self.terms.free), n, float(p.mu), float(p.l_f), n),
            Spectra(temporal, 2 * n, 0.0, float(p.l_T), rank),
            Spectra(spatial, 2 * n, 0.0, float(p.l_S), rank),
        )

    @property
    def size(self) -> int:
        """The number of parameters."""
        return sum(f.count * f.each for f in self.families)

    @property
    def bounds(self) -> tuple[Floats, Floats]:
        """The least and the largest value of every parameter; angles are unbounded."""
        low, high = self._filled(-np.inf, 0.0), self._filled(np.inf, 1.0)
        return low, high

    def blocks(self, theta: Floats) -> Blocks:
        """Return the Hessians at parameters of shape (size,)."""
        parts = zip(self.families, self.split(theta), strict=True)
        return Blocks(*(f.matrices(part) for f, part in parts))

    def gradient(self, theta: Floats, bars: Blocks) -> Floats:
        """Return the derivative of ``sum <bar, block>`` in the parameters, shape (size,)."""
        parts = zip(self.families, self.split(theta), bars, strict=True)
        return np.concatenate([f.gradient(part, bar).ravel() for f, part, bar in parts])

    def split(self, theta: Floats) -> list[Floats]:
        """Return the parameters of node, temporal and spatial blocks, shape (count, each)."""
        ends = np.cumsum([f.count * f.each for f in self.families])[:-1]
        parts = np.split(np.asarray(theta, dtype=np.float64), ends)
        return [p.reshape(f.count, f.each) for f, p in zip(self.families, parts, strict=True)]

    def random(self, rng: np.random.Generator) -> Floats:
        """Return parameters: strengths uniform in [0, 1], angles uniform on the circle."""
        low, _ = self.bounds
        found = rng.uniform(0.0, 1.0, self.size)
        found[np.isinf(low)] = rng.uniform(-np.pi, np.pi, int(np.isinf(low).sum()))
        return found

    def differences(self, columns: Ints | None = None) -> Floats:
        r"""Return parameters of difference couplings ``(l/2)|cos(phi) y - sin(phi) z|^2``, node mu.

        ``tan(phi) = 1`` (which is ``(l/4)|y - z|^2``) without `columns`. With them the couplings to
        these fixed actions are tilted, ``tan(phi) = 1/sqrt(1+a)`` on the free action, which is
        best one step from it, and the couplings to other fixed actions are cut.

        Parameters
        ----------
        columns : ndarray of int, optional
            Rows of ``terms.fixed``.
        """
        p, n = self.parameters, self.terms.problem.n
        found = self._filled(0.0, 1.0)
        node, *both = self.split(found)
        node[:] = 0.0
        pairs, ratios = (self.terms.temporal, self.terms.spatial), (p.a_T, p.a_S)
        for family, part, pair, a in zip(self.families[1:], both, pairs, ratios, strict=True):
            if not family.each:
                continue
            fixed = pair.ends - len(self.terms.free)
            tilt = np.zeros(len(pair.t))
            if columns is not None:
                mine = np.isin(fixed, columns)
                tilt = np.where(mine[:, 0], -1.0, np.where(mine[:, 1], 1.0, 0.0))
                part[(fixed >= 0).any(axis=1) & ~mine.any(axis=1), : family.rank] = 0.0
            turned = np.flatnonzero(family.planes[:, 1] == family.planes[:, 0] + n)
            turned = turned[family.planes[turned, 0] < n]
            angle = np.arctan((1.0 + a) ** (tilt / 2))
            part[:, family.rank + turned] = -angle[:, None]
            part[:, n : family.rank] = 0.0
        return found

    def problem(self, theta: Floats) -> Problem:
        """Return a problem with these Hessians; elsewhere the nodes have mu I, pairs nothing."""
        old, n = self.terms.problem, self.terms.problem.n
        blocks = self.blocks(theta)
        node = np.tile(float(self.parameters.mu) * np.eye(n), (old.H, old.N, 1, 1))
        node[self.terms.free[:, 1] - 1, self.terms.free[:, 2]] = blocks.node
        temporal = np.zeros((old.H, old.N, 2 * n, 2 * n))
        spatial = np.zeros((old.H, len(old.edges), 2 * n, 2 * n))
        for into, pair, block in (
            (temporal, self.terms.temporal, blocks.temporal),
            (spatial, self.terms.spatial, blocks.spatial),
        ):
            into[pair.t - 1, pair.i] = block
        costs = (
            Quadratic(node),
            Quadratic(temporal),
            Quadratic(spatial) if len(old.edges) else None,
        )
        return Problem(old.network, old.H, *costs)  # type: ignore[arg-type]

    def _filled(self, angle: float, strength: float) -> Floats:
        """Return parameters that are all the same."""
        parts = [np.full((f.count, f.each), angle) for f in self.families]
        for f, part in zip(self.families, parts, strict=True):
            part[:, : f.rank] = strength
        return np.concatenate([part.ravel() for part in parts])
