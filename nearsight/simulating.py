"""One call for what ``nearsight simulate`` does."""

from __future__ import annotations

from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .api import Graph
    from .lpc import Problem, Simulation
    from .lpc.simulation import Progress


def random_problem(
    *,
    graph: Graph,
    mu: float,
    l_f: float,
    l_T: float,
    l_S: float,
    horizon: int,
    style: str = "attraction",
    targets: Any = "normal",
    n: int = 1,
    varying: bool = False,
    box: tuple[Any, Any] | None = None,
    seed: int = 0,
    clean: bool = False,
) -> Problem:
    """Return a random problem with exactly these constants on a network.

    Parameters
    ----------
    graph : str, path, networkx.Graph or Network
        The network: a file, a family such as ``"grid:10x20"``, or an object.
    mu, l_f, l_T, l_S : float
        Strengths of the costs, see `nearsight.Parameters`.
    horizon : int
        Number of steps H.
    style, targets, n, varying, box, seed
        See `nearsight.lpc.instance`; the seed is also that of random graphs.
    clean : bool
        Drop directions, parallel edges and self-loops of a file or networkx graph.

    Raises
    ------
    InputError
        If an argument cannot be used; the message says what would be accepted.
    """
    from .api import network
    from .bounds import Parameters
    from .lpc import instance

    return instance(
        network(graph, seed, clean),
        horizon,
        Parameters(mu, l_f, l_T, l_S),
        style=style,
        targets=targets,
        n=n,
        seed=seed,
        box=box,
        varying=varying,
    )


def simulate(
    given: Problem | str | PathLike[str] | None = None,
    /,
    *,
    k: int,
    r: int,
    method: str = "auto",
    workers: int = 1,
    tolerance: float = 1e-9,
    checkpoint: str | PathLike[str] | None = None,
    progress: Progress | None = None,
    **arguments: Any,
) -> Simulation:
    """Run LPC on a problem and compare it with the clairvoyant optimum.

    Parameters
    ----------
    given : Problem or path, optional
        The problem, or a file of `nearsight.save_problem`. If omitted, a random one is drawn.
    k, r : int
        Prediction horizon ``>= 1`` and communication radius ``>= 0``.
    method, workers, tolerance
        See `nearsight.lpc.Controller`.
    checkpoint : path, optional
        A file that takes every completed step, from which an interrupted simulation goes on.
    progress : callable, optional
        Called as ``progress(what, done, total)``.
    **arguments
        As for `random_problem`, in place of `given`.

    Raises
    ------
    InputError
        If an argument cannot be used; the message says what would be accepted.

    Examples
    --------
    >>> import nearsight as ns
    >>> run = ns.simulate(graph="ring:13", mu=1, l_f=1, l_T=1, l_S=0.5, horizon=12, k=3, r=2)
    >>> 1 <= run.ratio < 1.01
    True
    """
    from .graphs import InputError
    from .lpc import load_problem
    from .lpc import simulate as run

    if given is None:
        chosen = random_problem(**arguments)
    elif arguments:
        names = ", ".join(arguments)
        raise InputError(f"a problem is given: {names} would have no effect")
    else:
        chosen = load_problem(given).problem if isinstance(given, str | PathLike) else given
    return run(
        chosen,
        k,
        r,
        method=method,
        workers=workers,
        tolerance=tolerance,
        checkpoint=None if checkpoint is None else fspath(checkpoint),
        progress=progress,
    )
