r"""The sharp bound on time slices is attained: scalar chains with the best couplings.

One agent, one number, node costs ``x^2/2`` (mu = 1), steps 1, 2, .., x_0 held fixed; the coupling
of steps i-1 and i is ``(a/2)(cos(phi_i) x_{i-1} - sin(phi_i) x_i)^2`` with ``t_i = tan(phi_i)``.
Eliminating steps from the last, d, on, with the stiffness ``kappa_d = 1``,

.. math:: \frac{dx_i}{dx_{i-1}} = \frac{a t_i}{\kappa_i (1 + t_i^2) + a t_i^2}, \qquad
          \kappa_{i-1} = 1 + \frac{a \kappa_i}{\kappa_i (1 + t_i^2) + a t_i^2}.

*The best couplings.* (E1) weighs step i by ``nu_i = gamma^{2(d-i)-1} a/(1+a)``, ``i < d``; where
all its inequalities are equalities, the gradient that a coupling puts on each of its ends is
known, and with it, by the optimality conditions, every angle (``gamma = gamma_T``,
``gamma + 1/gamma = 2 + 2/a``):

* ``d = 1``: ``t_1^2 = 1/(1+a)``;
* ``d >= 2``: ``t_1^2 = 1/sqrt(1+2a)``, ``t_d^2 = sqrt(1+2a)/(1+a)``, and ``t_i = 1`` between.

So uniform differences are right in the bulk, where ``dx_i/dx_{i-1} = gamma``; at the ends
``dx_1/dx_0 = t_1 gamma/(1-gamma)`` and ``dx_d/dx_{d-1} = t_d (1-gamma) a/2``. The product is
``s_d = (a/(2 sqrt(1+a))) gamma^{d-1}``: the bound is attained, not only approached.

*No tail.* What follows step d adds to its stiffness a Schur complement of a positive semidefinite
matrix, and can but lower the value. So the supremum is a maximum over d free steps, for the
problem until the end as it is, for the two-point problem with a last coupling that does not touch
step d; longer chains give nothing.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from ..bounds import Parameters
from ..bounds.arithmetic import Number, sqrt
from ..graphs import InputError, Network
from ..lpc.arrays import Floats
from ..lpc.costs import Quadratic
from ..lpc.global_problem import GlobalProblem
from ..lpc.problem import Problem
from .couplings import Couplings
from .found import Found
from .search import Progress, search
from .target import Target

LOWEST, HIGHEST = 1e-3, 1e3  # where a threshold is looked for


def best_tangents(a: Number, d: int) -> list[Number]:
    """Return ``t_1..t_d`` of the chain that attains ``s_d``, ``a > 0``; in any arithmetic."""
    _check(d)
    if d == 1:
        return [1 / sqrt(1 + a)]
    root = sqrt(sqrt(1 + 2 * a))
    return [1 / root, *[1 + 0 * a] * (d - 2), root / sqrt(1 + a)]


def chain_sensitivity(a: Number, tangents: Sequence[Number]) -> Number:
    """Return ``dx_d/dx_0`` of a chain of d steps with mu = 1, by elimination."""
    found, kappa = 1 + 0 * a, 1 + 0 * a
    for t in reversed(tangents):
        below = kappa * (1 + t * t) + a * t * t
        found, kappa = found * a * t / below, 1 + a * kappa / below
    return found


def chain(d: int, *, until_end: bool = False, beyond: int = 0) -> GlobalProblem:
    """Return a window of one agent with ``d + beyond`` free steps from step 1 on.

    It runs to the end, or to a fixed action one step after the last free one.
    """
    _check(d)
    H = d + beyond + (not until_end)
    problem = Problem(Network.from_edges(1, []), H, Quadratic([[1.0]]))
    return GlobalProblem(problem, 1, None if until_end else H)


def best_chain(window: GlobalProblem, parameters: Parameters, d: int) -> Floats:
    """Return the parameters of `Couplings` of the chain that attains ``s_d``."""
    couplings = Couplings(window.terms, parameters)
    theta = couplings.differences()
    _, temporal, _ = couplings.split(theta)
    if temporal.size:
        t = window.terms.temporal.t
        tangents = np.array([float(x) for x in best_tangents(parameters.a_T, d)])
        inside = t <= d
        temporal[:, 0] = inside
        # (cos, sin) are the weights of (x_t, x_{t-1})
        temporal[inside, 1] = -np.arctan2(1.0, tangents[t[inside] - 1])
    return np.asarray(theta)


def search_chain(
    a: float,
    d: int,
    *,
    until_end: bool = False,
    beyond: int = 0,
    known: bool = False,
    structured: bool = True,
    starts: int = 4,
    seed: int = 0,
    progress: Progress | None = None,
) -> Found:
    """Search the sensitivity of step d to x_0 over all scalar chains with ``l_T/mu = a``.

    Parameters
    ----------
    a : float
        ``l_T``; ``mu = l_f = 1``.
    d : int
        At least 1.
    until_end, beyond
        See `chain`.
    known : bool
        Whether to begin at the couplings that are known to be best.
    structured, starts, seed, progress
        See `search`.
    """
    window = chain(d, until_end=until_end, beyond=beyond)
    parameters = Parameters(1.0, 1.0, a, 0.0)
    return search(
        window,
        Target((d, 0), (0, 0)),
        parameters,
        starts=starts,
        seed=seed,
        structured=structured,
        guesses=[best_chain(window, parameters, d)] if known else [],
        progress=progress,
    )


@dataclass(frozen=True, eq=False)
class Threshold:
    """Where a tier of ``thm:global-exp-decay`` begins to survive the search.

    Parameters
    ----------
    d : int
    violated, survived : float
        The largest ``a = l_T/mu`` at which an instance was found that violates it, and the least
        above at which none was.
    found : Found
        The instance at `violated`.
    """

    d: int
    violated: float
    survived: float
    found: Found


def threshold(
    d: int,
    *,
    tier: str = "stated",
    tolerance: float = 1e-10,
    until_end: bool = False,
    starts: int = 2,
    seed: int = 0,
    progress: Progress | None = None,
) -> Threshold:
    """Bisect for the coupling below which the search violates ``|dx_d/dx_0| <= C_G rho_G^d``.

    For the printed ``C_G = 2 a`` the ratio of supremum and bound is
    ``1/(4 gamma_T sqrt(1+a))`` at every d: decreasing in a, 1 at a = 0.6109..

    Parameters
    ----------
    d : int
    tier : str
        Of the theorem.
    tolerance : float
        Relative, of the answer.
    until_end, starts, seed
        As in `search_chain`.
    progress : callable, optional
        Called as ``progress(done, total)`` after every step of the bisection.

    Raises
    ------
    InputError
        If the tier is violated nowhere, or everywhere, between 1e-3 and 1e3.
    """

    def look(a: float) -> Found:
        return search_chain(a, d, until_end=until_end, starts=starts, seed=seed)

    low, high = LOWEST, HIGHEST
    found = look(low)
    if tier not in found.bounds:
        raise InputError(f"tier = {tier!r}: one of {', '.join(found.bounds)}", "tier")
    if found.ratios[tier] <= 1 or look(high).ratios[tier] > 1:
        raise InputError(f"tier = {tier!r}: no threshold between {LOWEST:g} and {HIGHEST:g}")
    steps = max(int(np.ceil(np.log2(np.log(high / low) / tolerance))), 1)
    for step in range(steps):
        middle = float(np.sqrt(low * high))
        seen = look(middle)
        if seen.ratios[tier] > 1:
            low, found = middle, seen
        else:
            high = middle
        if progress is not None:
            progress(step + 1, steps)
    return Threshold(d, low, high, found)


def _check(d: int) -> None:
    if isinstance(d, bool) or int(d) != d or d < 1:
        raise InputError(f"d = {d}: an integer >= 1 is needed", "d")
