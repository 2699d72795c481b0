"""One call for what ``nearsight worst-case --table`` does."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .api import Graph
    from .lowerbounds.rows import Sandwich


def sandwich(
    *,
    graph: Graph,
    mu: float,
    l_f: float,
    l_T: float,
    l_S: float,
    horizon: int,
    ks: Iterable[int],
    rs: Iterable[int],
    clean: bool = False,
    seed: int = 0,
    save: str | PathLike[str] | None = None,
    **options: Any,
) -> Sandwich:
    """Return lower bounds, worst cases and certificates over a range of k and r.

    Parameters
    ----------
    graph : str, path, networkx.Graph or Network
        The network: a file, a family such as ``"grid:10x20"``, or an object.
    mu, l_f, l_T, l_S : float
        Constants of the costs, see `nearsight.Parameters`.
    horizon : int
        Number of steps H of the worst cases.
    ks, rs : iterable of int
        The horizons ``>= 2`` and the radii ``>= 1``.
    clean : bool
        Drop directions, parallel edges and self-loops of a file or networkx graph.
    seed : int
        Of all that is random.
    save : path, optional
        Where to write the rows as CSV.
    **options
        ``style, starts, workers, checkpoint, progress``: see `nearsight.lowerbounds.sandwich`.

    Examples
    --------
    >>> import nearsight as ns
    >>> found = ns.sandwich(graph="ring:6", mu=1, l_f=1, l_T=1, l_S=0.5, horizon=5, ks=[3], rs=[2])
    >>> row = found.rows[0]
    >>> row.lower < row.worst < row.sharp, found.violations
    (True, ())
    """
    from .api import network
    from .bounds import Parameters
    from .lowerbounds.rows import write_csv
    from .lowerbounds.sandwich import sandwich as layers

    place = network(graph, seed, clean)
    found = layers(place, horizon, Parameters(mu, l_f, l_T, l_S), ks, rs, seed=seed, **options)
    if save is not None:
        write_csv(found, save)
    return found
