"""One call for what ``nearsight lower-bound`` does."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .api import Graph
    from .graphs import Growth
    from .lowerbounds import Floor


def lower_bound(
    *,
    mu: float,
    l_f: float,
    l_T: float,
    l_S: float,
    k: int,
    r: int,
    graph: Graph = None,
    growth: str | Growth | None = None,
    max_degree: int | None = None,
    seed: int = 0,
    clean: bool = False,
    save: str | PathLike[str] | None = None,
    progress: Callable[[int, int], None] | None = None,
) -> Floor:
    """Return what no algorithm that sees k steps and r hops beats on a network.

    Over all costs with the given constants, unconstrained or not: some instance makes any
    decentralised online algorithm pay that much more than the optimum.

    Parameters
    ----------
    mu, l_f, l_T, l_S : float
        Constants of the costs, see `nearsight.Parameters`.
    k, r : int
        Look-ahead ``>= 1`` and communication radius ``>= 0``.
    graph : str, path, networkx.Graph or Network
        The network: a file, a family such as ``"grid:10x20"``, or an object.
    growth : str or Growth
        In place of a graph, an infinite family such as ``"grid2"``; exactly one of the two.
    max_degree : int, optional
        Largest degree, for the growths ``poly`` and ``values``.
    seed : int
        For random families of graphs.
    clean : bool
        Drop directions, parallel edges and self-loops of a file or networkx graph.
    save : path, optional
        Where to write the worst instance found, as a problem file.
    progress : callable, optional
        Called as ``progress(done, total)`` while sources are compared.

    Raises
    ------
    InputError
        If an argument cannot be used; the message says what would be accepted.

    Examples
    --------
    >>> import nearsight as ns
    >>> found = ns.lower_bound(graph="ring:13", mu=1, l_f=1, l_T=1, l_S=1, k=3, r=2)
    >>> round(found.temporal.cr_minus_one, 6), round(found.spatial.cr_minus_one, 6)
    (0.003544, 0.001011)
    """
    from .api import network, setting
    from .graphs import InputError
    from .lowerbounds import floor

    if (graph is None) == (growth is None):
        raise InputError("exactly one of graph and growth is needed (--graph, --growth)")
    if save is not None and graph is None:
        raise InputError("an instance needs a finite graph, not a growth", "save")
    finite = None if graph is None else network(graph, seed, clean)
    asked = setting(
        mu=mu, l_f=l_f, l_T=l_T, l_S=l_S, graph=finite, growth=growth, max_degree=max_degree
    )
    found = floor(asked, finite, k, r, progress)
    if save is not None:
        from .lpc import save_problem

        notes = {
            "lower_bound": {
                "cr_minus_one": found.cr_minus_one,
                "instance": found.best,
                "k": k,
                "r": r,
            }
        }
        try:
            save_problem(found.problem(), save, notes)
        except InputError as error:
            raise InputError(str(error), error.argument or "save") from error
    return found
