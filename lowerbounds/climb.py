"""The worst couplings that climbing finds: a lower bracket of what LPC can do to a whole class."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from os import PathLike

import numpy as np
from scipy.optimize import minimize

from ..bounds import Parameters
from ..graphs import InputError, NearsightError, Network
from ..lpc.arrays import Floats, integer
from ..lpc.constants import Constants, constants
from ..lpc.store import Store
from .couplings import Couplings
from .resumed import identity
from .slope import Slope
from .worst_case import WorstCase, worst_case

Progress = Callable[[str], None]
LARGEST = 2000  # variables H N up to which local problems are differentiated densely
JITTER = 0.03  # leaves symmetric points, where the largest eigenvalue is multiple
KICK = 0.2  # of a point that cannot be improved by its gradient
NOTHING = 1e-300  # below, couplings make no difference


@dataclass(frozen=True)
class Climb:
    """One climb: where it began, and ``CR - 1`` at its beginning and after every round."""

    start: str
    values: tuple[float, ...]


@dataclass(frozen=True, eq=False)
class Searched:
    """The worst instance that a search over couplings found.

    Parameters
    ----------
    worst : WorstCase
        The exact worst case over all data at the worst couplings found, with its instance.
    constants : Constants
        Derived from that instance: it lies within the class.
    history : tuple of Climb
        One for every start, in their order.
    """

    worst: WorstCase
    constants: Constants
    history: tuple[Climb, ...]

    @property
    def cr_minus_one(self) -> float:
        """The ratio found, minus 1: no uniform promise for the class can be below."""
        return self.worst.cr_minus_one


def search_couplings(
    network: Network,
    H: int,
    parameters: Parameters,
    k: int,
    r: int,
    *,
    starts: int = 4,
    rounds: int = 3,
    steps: int = 300,
    seed: int = 0,
    checkpoint: str | PathLike[str] | None = None,
    progress: Progress | None = None,
) -> Searched:
    """Climb ``CR - 1`` over all scalar quadratic costs with given constants, ``n = 1``.

    Every climb is a quasi-Newton ascent (L-BFGS-B) of ``log(CR - 1)`` by its exact gradient, then
    again from where that ended, kicked. Climbs begin at uniform differences, at two uniform tilts
    (the angle that is worst for one step, and its mirror image), then at random couplings. What is
    found is attained by an instance; that nothing is worse is not claimed.

    Parameters
    ----------
    network : Network
    H : int
        Steps; ``H N`` at most 2000.
    parameters : Parameters
        mu, l_f, l_T, l_S: one float each.
    k, r : int
        Prediction horizon and communication radius.
    starts : int
        Climbs, at least 1.
    rounds : int
        Ascents of one climb, at least 1.
    steps : int
        Steps of one ascent, at most.
    seed : int
        Of all that is random. Climb i does not depend on how many there are.
    checkpoint : path, optional
        A file that keeps finished climbs: an interrupted search goes on after them, and a longer
        one begins with them.
    progress : callable, optional
        Called with a short text now and then.

    Raises
    ------
    InputError
        If an argument is out of range, or the checkpoint is of another search.
    """
    for name, count in (("starts", starts), ("rounds", rounds), ("steps", steps)):
        integer(count, name, 1)
    if H * network.vertices > LARGEST:
        raise InputError(
            f"H N = {H * network.vertices}: a search takes at most {LARGEST} actions; "
            "a smaller network or horizon is needed"
        )
    slope = Slope(Couplings(network, H, parameters), k, r)
    best, history = -np.inf, []
    at: Floats | None = None
    unit = np.empty(rounds + 1 + slope.couplings.size)  # values, then the best point
    uniform = slope.couplings.point(np.pi / 4, np.pi / 4)
    header = identity(
        slope.couplings.problem(uniform),
        parameters,
        k=k,
        r=r,
        rounds=rounds,
        steps=steps,
        seed=seed,
    )
    with Store(checkpoint, "climb", header, unit.size) as store:
        for i in range(starts):
            rng = np.random.default_rng([seed, i])
            name, point = _start(slope.couplings, i, rng)
            if not store.load(i, unit):
                for j, (value, there) in enumerate(_climb(slope, point, rounds, steps, rng)):
                    unit[j], unit[rounds + 1 :] = value, there
                    if progress is not None:
                        progress(f"climb {i + 1}/{starts}: CR - 1 = {max(best, value):.6g}")
                store.save(i, unit)
            history.append(Climb(name, tuple(unit[: rounds + 1].tolist())))
            if unit[rounds] > best:  # the best of a climb is its last
                best, at = float(unit[rounds]), unit[rounds + 1 :].copy()
    if at is None:
        raise NearsightError("the numbers of this network overflow: rescale its costs")
    worst = worst_case(slope.couplings.problem(at), k, r)
    return Searched(worst, _member(worst, parameters), tuple(history))


def _start(c: Couplings, i: int, rng: np.random.Generator) -> tuple[str, Floats]:
    """Return the name and the point of start i."""
    lean = float(np.arctan(np.sqrt(1 + float(c.parameters.a_T))))
    known = (
        ("uniform differences", np.pi / 4, np.pi / 4),
        ("uniform tilt", lean, np.pi / 4),
        ("uniform tilt, mirrored", np.pi / 2 - lean, np.pi / 4),
    )
    if i >= len(known):
        return f"random {i - len(known)}", c.random(rng)
    name, phi_T, phi_S = known[i]
    return name, c.point(phi_T, phi_S)


def _climb(
    slope: Slope, point: Floats, rounds: int, steps: int, rng: np.random.Generator
) -> Iterator[tuple[float, Floats]]:
    """Yield value and point at the start and after every ascent; the best ones go on."""
    low, high = slope.couplings.bounds
    best, here = slope(point)[0], point
    yield best, here

    def down(p: Floats) -> tuple[float, Floats]:
        value, gradient = slope(p)
        value = max(value, NOTHING)
        return -float(np.log(value)), -gradient / value

    for j in range(rounds):
        size = JITTER if j == 0 else KICK * rng.random()
        there = np.clip(here + size * rng.normal(size=here.size), low, high)
        found = minimize(
            down,
            there,
            jac=True,
            method="L-BFGS-B",
            bounds=list(zip(low, high, strict=True)),
            options={"maxiter": steps},
        )
        value = slope(found.x)[0]
        if value > best:
            best, here = value, found.x
        yield best, here


def _member(worst: WorstCase, parameters: Parameters) -> Constants:
    """Return the constants of the instance; raise `NearsightError` if it leaves the class."""
    found = constants(worst.problem)
    p, q = found.parameters(), parameters
    if p.mu < q.mu or p.l_f > q.l_f or p.l_T > q.l_T or p.l_S > q.l_S:
        raise NearsightError(
            f"the instance found leaves the class: mu = {p.mu!r}, l_f = {p.l_f!r}, "
            f"l_T = {p.l_T!r}, l_S = {p.l_S!r}"
        )
    return found
