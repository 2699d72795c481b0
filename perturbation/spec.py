"""What a measurement draws: random local problems of a class on a network."""

from __future__ import annotations

import hashlib
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ..bounds import Parameters
from ..graphs import Growth, InputError, Network, network_growth
from ..lpc.arrays import Floats
from ..lpc.information import check_sight
from ..lpc.instances import instance, styles
from ..lpc.local import LocalProblem
from ..lpc.problem import Problem
from .jumps import jumps, tables
from .neighbourhood import Neighbourhood
from .profile import PARTS, Cells
from .promised import TIERS, Promised
from .sensitivity import sensitivity
from .slices import slices


@dataclass(frozen=True, eq=False)
class Spec:
    """What is measured: local problems of random instances of a class on a network.

    Instance i draws an agent of the network, a style of costs, costs with exactly the given
    constants on what the agent can see, and boundary values, all from the seed (seed, i): it is
    the same whatever the number of instances, and whoever computes it.

    Parameters
    ----------
    network : Network
    parameters : Parameters
        The constants of the class, numbers.
    k, r : int
        Prediction horizon ``>= 2`` and communication radius ``>= 1``.
    styles : tuple of str
        Of `nearsight.lpc.instances.styles`; instances take turns. All of them if empty.
    n : int
        Entries of one action.
    box : (float, float), optional
        Every action lies between two numbers, which bind at some of the boundary values.
    spread : float
        Standard deviation of targets and boundary values.
    seed : int
        At least 0.

    Raises
    ------
    InputError
        If a number is out of range, or there is no such style.
    """

    network: Network
    parameters: Parameters
    k: int
    r: int
    styles: tuple[str, ...] = ()
    n: int = 1
    box: tuple[float, float] | None = None
    spread: float = 1.0
    seed: int = 0

    def __post_init__(self) -> None:
        check_sight(self.k, self.r)
        for name, value, least in (("k", self.k, 2), ("r", self.r, 1)):
            if value < least:
                text = f"{name} = {value}: {name} >= {least} is needed, below nothing is free"
                raise InputError(text, name)
        there = styles()
        chosen = self.styles or tuple(there)
        for style in chosen:
            if style not in there:
                raise InputError(f"style = {style!r}: one of {', '.join(there)}", "style")
        object.__setattr__(self, "styles", chosen)
        if self.seed < 0:
            raise InputError(f"seed = {self.seed}: an integer >= 0 is needed", "seed")
        if not 0 < self.spread < np.inf:
            raise InputError(f"spread = {self.spread}: a finite number > 0 is needed", "spread")

    def draw(self, i: int) -> Drawn:
        """Return instance i."""
        rng = np.random.default_rng([self.seed, i])
        v = int(rng.integers(self.network.vertices))
        around = Neighbourhood.of(self.network, v, self.r)
        problem = instance(
            around.network,
            self.k,  # the window ends at the horizon: its top is there
            self.parameters,
            style=self.styles[i % len(self.styles)],
            targets=self.spread * rng.normal(size=(self.k, around.network.vertices, self.n)),
            n=self.n,
            seed=int(rng.integers(1 << 32)),
            box=self.box,
            varying=True,
        )
        window = LocalProblem(problem, 1, 0, self.k, self.r)
        y, z = (
            self.spread * rng.normal(size=(len(pairs), self.n))
            for pairs in (window.bottom, window.boundary)
        )
        return Drawn(i, v, around, problem, window, y, z)

    @property
    def shape(self) -> tuple[int, int, int]:
        """Of the cells of one instance."""
        return len(PARTS), self.k + 1, 2 * self.r + 1

    def cells(self, i: int) -> Floats:
        """Return the cells of instance i, then its slices, then its jumps, as one vector."""
        drawn = self.draw(i)
        found = sensitivity(drawn.window, drawn.y, drawn.z)
        distance = drawn.around.distance
        cells = Cells.of(found, distance, self.k, 2 * self.r).largest.ravel()
        rng = np.random.default_rng([self.seed, i, 1])
        jumped = jumps(drawn.window, found, (drawn.y, drawn.z), distance, self._bounds, rng)
        return np.concatenate([cells, slices(drawn.problem, self.k), jumped])

    @property
    def width(self) -> int:
        """The length of `cells`."""
        return int(np.prod(self.shape)) + self.k + len(TIERS)

    @cached_property
    def growth(self) -> Growth:
        """The growth of the network."""
        return network_growth(self.network)

    @cached_property
    def _bounds(self) -> Floats:
        return tables(Promised(self.parameters, self.growth), self.k, 2 * self.r)

    def identity(self) -> dict[str, object]:
        """Return what tells one measurement from another, as JSON values."""
        digest = hashlib.sha256()
        for array in (self.network.indptr, self.network.indices):
            digest.update(np.ascontiguousarray(array).tobytes())
        p = self.parameters
        return {
            "network": digest.hexdigest(),
            "parameters": [float(v).hex() for v in (p.mu, p.l_f, p.l_T, p.l_S)],
            "k": self.k,
            "r": self.r,
            "styles": list(self.styles),
            "n": self.n,
            "box": None if self.box is None else [float(v).hex() for v in self.box],
            "spread": float(self.spread).hex(),
            "seed": self.seed,
        }


@dataclass(frozen=True, eq=False)
class Drawn:
    """One instance: a problem on what agent v of the network can see, and boundary values."""

    number: int
    v: int
    around: Neighbourhood
    problem: Problem
    window: LocalProblem
    y: Floats
    z: Floats
