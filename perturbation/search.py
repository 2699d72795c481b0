"""The largest sensitivity over a class of costs, from below: a search that ends in an instance."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field

import numpy as np
from scipy.optimize import minimize

from ..bounds import Parameters
from ..graphs import Growth, InputError, network_growth
from ..lpc.arrays import Floats
from ..lpc.window import Window
from .couplings import Couplings
from .found import Found
from .response import Response
from .target import Target, place, promises, window_at

Progress = Callable[[int, int], None]
POLISH = 6  # times that the best point is taken up again
SMALLEST = 1e-300  # values below are as good as 0


@dataclass(eq=False)
class Climb:
    """``log |block|`` as a function of the parameters of `Couplings`, and how to climb it.

    The logarithm, as values decay over many orders of magnitude.
    """

    couplings: Couplings
    response: Response
    evaluations: int = field(default=0, init=False)

    @classmethod
    def of(
        cls, window: Window, target: Target, parameters: Parameters, rank: int | None = None
    ) -> Climb:
        """Return the function for one block of a window."""
        terms = window.terms
        response = Response(terms, target.rows(terms), target.columns(terms))
        return cls(Couplings(terms, parameters, rank), response)

    def value(self, theta: Floats) -> float:
        """Return ``|block|``."""
        return self.response.value(self.couplings.blocks(theta))

    def descent(self, theta: Floats) -> tuple[float, Floats]:
        """Return ``-log |block|`` and its gradient; 0 gradient where the block vanishes."""
        self.evaluations += 1
        sigma, bars = self.response.with_gradient(self.couplings.blocks(theta))
        if sigma < SMALLEST:
            return -float(np.log(SMALLEST)), np.zeros_like(theta)
        return -float(np.log(sigma)), -self.couplings.gradient(theta, bars) / sigma

    def climb(self, start: Floats, iterations: int = 1000) -> Floats:
        """Return a point that L-BFGS-B reaches [Byrd, Lu, Nocedal, Zhu 1995], not below start."""
        low, high = self.couplings.bounds
        options = {"maxiter": iterations, "maxfun": 2 * iterations, "maxcor": 20}
        tight = {"ftol": 1e-15, "gtol": 1e-11}
        found = minimize(
            self.descent,
            np.clip(start, low, high),
            jac=True,
            method="L-BFGS-B",
            bounds=np.stack([low, high], axis=1),
            options=options | tight,
        ).x
        return np.asarray(found if self.value(found) >= self.value(start) else start)

    def polished(self, theta: Floats) -> Floats:
        """Climb on from a point, forgetting curvature, until it gains no more than rounding."""
        value = self.value(theta)
        for _ in range(POLISH):
            theta = self.climb(theta)
            before, value = value, self.value(theta)
            if value <= before * (1 + 1e-14):
                break
        return theta


def search(
    window: Window,
    target: Target,
    parameters: Parameters,
    *,
    starts: int = 8,
    seed: int = 0,
    structured: bool = True,
    guesses: Sequence[Floats] = (),
    rank: int | None = None,
    growth: Growth | None = None,
    progress: Progress | None = None,
) -> Found:
    """Return the largest sensitivity found among quadratic costs with constants (mu, .., l_S).

    Every value is a *lower* bound on the supremum over the class, and comes with an instance;
    nothing is said about how close it is.

    Parameters
    ----------
    window : Window
        A `LocalProblem` or a `GlobalProblem`, at most 1500 unknowns; of its problem only the
        network, H and n matter.
    target : Target
        Which block of the sensitivity.
    parameters : Parameters
        The constants of the class.
    starts : int
        Random starts.
    seed : int
        Of the random starts; the same seed gives the same answer.
    structured : bool
        Whether to begin also at uniform differences, and at couplings tilted at the boundary.
    guesses : sequence of ndarray
        More starts, parameters of `Couplings`.
    rank : int, optional
        Of the pair blocks, see `Couplings`.
    growth : Growth, optional
        For the bounds; of the window's network if omitted.
    progress : callable, optional
        Called as ``progress(done, total)`` after every start.

    Raises
    ------
    InputError
        If nothing is free, the target is no block of the window, there is no start, or the window
        is too large.
    """
    where = place(window)
    climb = Climb.of(window, target, parameters, rank)
    begin = _starts(climb, starts, seed, structured, guesses)
    best, value = begin[0], -np.inf
    for j, start in enumerate(begin):
        point = climb.climb(start)
        reached = climb.value(point)
        if reached > value:
            best, value = point, reached
        if progress is not None:
            progress(j + 1, len(begin))
    best = climb.polished(best)
    problem = climb.couplings.problem(best)
    return Found(
        climb.value(best),
        window_at(problem, where),
        target,
        parameters,
        promises(window, target, parameters, growth or network_growth(problem.network)),
        best,
        climb.evaluations,
    )


def _starts(
    climb: Climb, starts: int, seed: int, structured: bool, guesses: Sequence[Floats]
) -> list[Floats]:
    rng = np.random.default_rng(seed)
    couplings = climb.couplings
    found = [np.asarray(guess, dtype=np.float64) for guess in guesses]
    for guess in found:
        if guess.shape != (couplings.size,):
            raise InputError(
                f"guesses: {guess.shape} where ({couplings.size},) parameters are needed", "guesses"
            )
    if structured:
        found += [couplings.differences(), couplings.differences(climb.response.columns)]
    found += [couplings.random(rng) for _ in range(starts)]
    if not found:
        raise InputError("starts = 0 without structured starts or guesses: nothing to begin at")
    return found
