"""One call for what ``nearsight measure`` does."""

from __future__ import annotations

from os import PathLike, fspath
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .api import Graph
    from .perturbation import Measurement, Searched
    from .perturbation.measure import Progress


def measure(
    *,
    graph: Graph,
    mu: float,
    l_f: float,
    l_T: float,
    l_S: float,
    k: int,
    r: int,
    instances: int = 100,
    seed: int = 0,
    clean: bool = False,
    workers: int = 1,
    cluster: str | None = None,
    checkpoint: str | PathLike[str] | None = None,
    progress: Progress | None = None,
    **options: Any,
) -> Measurement:
    """Measure how boundary errors decay on random instances, beside what theorems promise.

    Parameters
    ----------
    graph : str, path, networkx.Graph or Network
        The network: a file, a family such as ``"grid:10x20"``, or an object.
    mu, l_f, l_T, l_S : float
        Constants of the costs, see `nearsight.Parameters`.
    k, r : int
        Prediction horizon ``>= 2`` and communication radius ``>= 1`` of the local problems.
    instances : int
        How many random instances.
    seed : int
        Of the instances, and of random graphs.
    clean : bool
        Drop directions, parallel edges and self-loops of a file or networkx graph.
    workers : int
        Processes; 0 for one a core. More than one need joblib (the extra ``parallel``).
    cluster : str, optional
        Address of a Dask scheduler.
    checkpoint : path, optional
        A file that keeps what is done, and from which an interrupted run goes on.
    progress : callable, optional
        Called as ``progress(done, total)``.
    **options
        ``styles``, ``n``, ``box``, ``spread``: see `nearsight.perturbation.Spec`.

    Raises
    ------
    InputError
        If an argument cannot be used; the message says what would be accepted.

    Examples
    --------
    >>> import nearsight as ns
    >>> found = ns.measure(graph="ring:13", mu=1, l_f=1, l_T=1, l_S=0.01, k=3, r=2, instances=20)
    >>> {tier for tier, cell in found.violations}  # the printed bound fails at weak couplings
    {'stated'}
    """
    from .api import network
    from .bounds import Parameters
    from .perturbation import Runner, Spec
    from .perturbation import measure as measured

    spec = Spec(
        network(graph, seed, clean), Parameters(mu, l_f, l_T, l_S), k, r, seed=seed, **options
    )
    return measured(
        spec,
        instances,
        runner=Runner(workers, cluster),
        checkpoint=None if checkpoint is None else fspath(checkpoint),
        progress=progress,
    )


def search_sensitivity(
    *,
    graph: Graph,
    mu: float,
    l_f: float,
    l_T: float,
    l_S: float,
    k: int,
    r: int,
    tier: str = "stated",
    agent: int | None = None,
    starts: int = 2,
    n: int = 1,
    seed: int = 0,
    clean: bool = False,
    progress: Progress | None = None,
) -> Searched:
    """Push the sensitivities of one local problem up within the class, against a tier's bounds.

    Parameters
    ----------
    graph, mu, l_f, l_T, l_S, k, r, seed, clean
        As for `measure`.
    tier : str
        Whose bound is attacked.
    agent : int, optional
        Whose local problem; that of an agent with most neighbours if omitted.
    starts : int
        Random starts of a full search.
    n : int
        Entries of one action.
    progress : callable, optional
        Called as ``progress(done, total)``.

    Returns
    -------
    Searched
        ``worst.ratio`` is measured over promised; ``worst.found.save(path)`` keeps the instance.

    Examples
    --------
    >>> import nearsight as ns
    >>> found = ns.search_sensitivity(graph="path:3", mu=1, l_f=1, l_T=1, l_S=0.01, k=2, r=1)
    >>> found.worst.ratio > 1  # an instance of the class exceeds the printed bound
    True
    """
    from .api import network
    from .bounds import Parameters
    from .perturbation import Spec, searched

    spec = Spec(network(graph, seed, clean), Parameters(mu, l_f, l_T, l_S), k, r, n=n, seed=seed)
    return searched(spec, v=agent, tier=tier, starts=starts, progress=progress)
