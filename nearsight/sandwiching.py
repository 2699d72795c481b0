"""One call for what ``nearsight worst-case --table`` does."""

from __future__ import annotations

from collections.abc import Iterable
from os import PathLike
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .api import Graph
    from .lowerbounds.augmentation import Augmented
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


def augmentation(
    found: Sandwich,
    *,
    graph: Graph,
    mu: float,
    l_f: float,
    l_T: float,
    l_S: float,
    clean: bool = False,
    seed: int = 0,
) -> tuple[Augmented, ...]:
    """Return for every ``(k*, r*)`` of a sandwich what LPC needs to do as well as anybody could.

    Parameters
    ----------
    found : Sandwich
        From `sandwich` with the same arguments.
    graph, mu, l_f, l_T, l_S, clean, seed
        See `sandwich`.

    Examples
    --------
    >>> import nearsight as ns
    >>> given = dict(graph="ring:6", mu=1, l_f=1, l_T=1, l_S=0.5)
    >>> found = ns.sandwich(**given, horizon=5, ks=[2, 3, 4], rs=[1, 2, 3])
    >>> least = ns.augmentation(found, **given)[0]
    >>> (least.k_star, least.r_star), [(p.k, p.r) for p in least.measured], least.factors
    ((2, 1), [(3, 2)], (1.5, 2.0))
    """
    from .api import network, setting
    from .lowerbounds import augmented

    asked = setting(
        mu=mu, l_f=l_f, l_T=l_T, l_S=l_S, graph=network(graph, seed, clean), unconstrained=True
    )
    return augmented(found.rows, asked)
