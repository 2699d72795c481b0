"""One call for what ``nearsight worst-case`` does."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import dataclass
from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .api import Graph
    from .graphs import Network
    from .lowerbounds.climb import Searched
    from .lowerbounds.worst_case import WorstCase
    from .lpc import Problem
    from .lpc.promise import Promise

Progress = Callable[[str], None]


@dataclass(frozen=True, eq=False)
class Worsened:
    """The exact worst case of one problem's couplings, beside what is promised.

    Parameters
    ----------
    worst : WorstCase
        Over all targets and ``x_0``, with the couplings given.
    promised : Promise
        At the constants of the couplings given.
    searched : Searched or None
        The worst couplings that a search found within the same constants.
    seconds : float
        Wall-clock time.
    """

    worst: WorstCase
    promised: Promise
    searched: Searched | None
    seconds: float

    @property
    def cr_minus_one(self) -> float:
        """The largest ratio minus 1 of all instances found."""
        return max(self.worst.cr_minus_one, self._searched)

    @property
    def problem(self) -> Problem:
        """The instance that has it."""
        if self.searched is not None and self._searched > self.worst.cr_minus_one:
            return self.searched.worst.problem
        return self.worst.problem

    @property
    def _searched(self) -> float:
        return 0.0 if self.searched is None else self.searched.cr_minus_one


def worst_case(
    given: Problem | str | PathLike[str] | None = None,
    /,
    *,
    k: int,
    r: int,
    search: int = 0,
    save: str | PathLike[str] | None = None,
    method: str = "auto",
    tolerance: float = 1e-8,
    seed: int = 0,
    workers: int = 1,
    checkpoint: str | PathLike[str] | None = None,
    progress: Progress | None = None,
    **arguments: Any,
) -> Worsened:
    """Return the exact worst ratio of LPC over all data of a quadratic network.

    Parameters
    ----------
    given : Problem or path, optional
        Quadratic and unconstrained; only its Hessians count. If omitted, one is drawn.
    k, r : int
        Prediction horizon ``>= 1`` and communication radius ``>= 0``.
    search : int
        Climbs over the couplings, too, within the same constants (actions of one number, small
        networks); 0 for none.
    save : path, optional
        Where to write the worst instance, as a problem file.
    method, tolerance, workers
        See `nearsight.lowerbounds.worst_case`.
    seed : int
        Of all that is random.
    checkpoint : path, optional
        A file that keeps finished climbs of a search, so that an interrupted one can go on.
    progress : callable, optional
        Called with a short text now and then.
    **arguments
        In place of `given`: ``graph, mu, l_f, l_T, l_S, horizon``, perhaps ``style`` (one of
        attraction, blocks, repulsion, tilted), ``n, varying, clean``.

    Raises
    ------
    InputError
        If an argument cannot be used; the message says what would be accepted.

    Examples
    --------
    >>> import nearsight as ns
    >>> found = ns.worst_case(graph="ring:13", mu=1, l_f=1, l_T=1, l_S=0.5, horizon=12, k=3, r=2)
    >>> f"{found.worst.cr_minus_one:.4e} <= {found.promised.cr_minus_one:.4e}"
    '6.9643e-03 <= 7.1239e-02'
    """
    from .graphs import InputError
    from .lowerbounds.worst_case import worst_case as exact
    from .lpc import load_problem
    from .lpc.arrays import integer
    from .lpc.promise import promise

    start = time.perf_counter()
    integer(search, "search", 0)
    if given is None:
        problem = _drawn(seed=seed, **arguments)
    elif arguments:
        raise InputError(f"a problem is given: {', '.join(arguments)} would have no effect")
    else:
        problem = load_problem(given).problem if isinstance(given, str | PathLike) else given
    if checkpoint is not None and not search:
        raise InputError("checkpoint: of a search over couplings only", "checkpoint")
    if search and problem.n > 1:
        raise InputError("search: over couplings of actions of one number only", "search")
    worst = exact(
        problem,
        k,
        r,
        method=method,
        tolerance=tolerance,
        seed=seed,
        workers=workers,
        progress=progress,
    )
    promised = promise(problem, k, r)
    searched = None
    if search:
        from .lowerbounds.climb import search_couplings

        p = promised.constants.parameters()
        searched = search_couplings(
            *(problem.network, problem.H, p, k, r),
            starts=search,
            seed=seed,
            checkpoint=checkpoint,
            progress=progress,
        )
    found = Worsened(worst, promised, searched, time.perf_counter() - start)
    if save is not None:
        _save(found, save)
    return found


def _drawn(
    *,
    graph: Graph | Network,
    mu: float,
    l_f: float,
    l_T: float,
    l_S: float,
    horizon: int,
    style: str = "attraction",
    n: int = 1,
    varying: bool = False,
    clean: bool = False,
    seed: int = 0,
) -> Problem:
    from .api import network
    from .bounds import Parameters
    from .lowerbounds.styles import quadratic_style
    from .lpc import instance

    return instance(
        network(graph, seed, clean),
        horizon,
        Parameters(mu, l_f, l_T, l_S),
        style=quadratic_style(style),
        n=n,
        varying=varying,
        seed=seed,
    )


def _save(found: Worsened, path: str | PathLike[str]) -> None:
    from .graphs import InputError
    from .lpc import save_problem

    notes = {"k": found.worst.k, "r": found.worst.r, "cr_minus_one": found.cr_minus_one}
    try:
        save_problem(found.problem, fspath(path), {"what": "worst case", **notes})
    except InputError as error:
        raise InputError(str(error), error.argument or "save") from error
