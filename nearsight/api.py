"""One call for what one command does."""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from .bounds import Plan, Result, Setting
    from .graphs import Growth, Network

Graph = Any
"""A family (``"ring:13"``), a file, a `networkx.Graph` or a `Network`."""


def setting(
    *,
    mu: Any,
    l_f: Any,
    l_T: Any,
    l_S: Any,
    graph: Graph = None,
    growth: str | Growth | None = None,
    max_degree: int | None = None,
    seed: int = 0,
    clean: bool = False,
    k: Any = None,
    r: Any = None,
    unconstrained: bool = False,
    b: tuple[float, float] | None = None,
    measuring: Callable[[int, int], None] | None = None,
) -> Setting:
    """Return the setting that `bound` and `plan` evaluate theorems in.

    Parameters
    ----------
    mu, l_f, l_T, l_S : float or array
        Strengths of the costs, see `nearsight.Parameters`.
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
    k, r, unconstrained, b
        See `nearsight.Setting`.
    measuring : callable, optional
        Called with done and total while a large network is measured.

    Raises
    ------
    InputError
        If an argument cannot be used; the message says what would be accepted.
    """
    from .bounds import Parameters, Setting
    from .graphs import InputError, network_growth, parse_growth

    if (graph is None) == (growth is None):
        raise InputError("exactly one of graph and growth is needed (--graph, --growth)")
    parameters = Parameters(mu, l_f, l_T, l_S)
    size: Growth
    if growth is None:
        size = network_growth(network(graph, seed, clean), progress=measuring)
    else:
        size = parse_growth(growth, max_degree) if isinstance(growth, str) else growth
    return Setting(parameters, size, k, r, unconstrained, b)


def bound(*, label: str | None = None, **arguments: Any) -> tuple[Result, ...]:
    """Return what every theorem says: constants, hypotheses with margins, values.

    Parameters
    ----------
    label : str, optional
        Only the theorem of this label, in all its tiers.
    **arguments
        As for `setting`: ``mu, l_f, l_T, l_S``, a graph or a growth, perhaps ``k, r``.

    Examples
    --------
    >>> import nearsight as ns
    >>> sharp = ns.bound(mu=1, l_f=1, l_T=1, l_S=0.5, growth="line", k=4, r=3,
    ...                  label="nearsight:sharp-cr")[0]
    >>> round(sharp.values["cr"], 6), sharp.guarantee
    (1.004824, True)
    """
    from .bounds import bounds_for, catalogue

    s = setting(**arguments)
    return tuple(b.evaluate(s) for b in (bounds_for(label) if label else catalogue()))


def plan(
    *,
    target: float,
    price_k: float = 1.0,
    price_r: float = 1.0,
    max_k: int = 100_000,
    max_r: int = 10_000,
    tiers: tuple[Any, ...] = ("stated", "repaired", "sharp"),
    progress: Any = None,
    **arguments: Any,
) -> Plan:
    """Return the horizons and radii that reach a target competitive ratio, per tier.

    Parameters
    ----------
    target : float
        Competitive ratio, above 1.
    price_k, price_r : float
        Price per unit of horizon and of radius, for the cheapest pair.
    max_k, max_r : int
        Largest horizon and radius considered.
    tiers : tuple of str
        Which tiers to plan.
    progress : callable, optional
        Called with a short text now and then.
    **arguments
        As for `setting`: ``mu, l_f, l_T, l_S``, a graph or a growth.

    Returns
    -------
    Plan
        ``plan["sharp"]`` is the plan of a tier: its pair, frontier, work, bottleneck.

    Examples
    --------
    >>> import nearsight as ns
    >>> plan = ns.plan(mu=1, l_f=1, l_T=1, l_S=0.5, growth="line", target=1.01)
    >>> plan["sharp"].pair.k, plan["sharp"].pair.r
    (4, 3)
    """
    from .bounds import Prices, Search
    from .bounds import plan as planned

    search = Search(max_k, max_r, progress)
    prices = Prices(price_k, price_r)
    return planned(setting(**arguments), target, prices=prices, search=search, tiers=tiers)


def network(graph: Graph, seed: int = 0, clean: bool = False) -> Network:
    """Return the network that a file, a family, a networkx graph or a `Network` is."""
    from .graphs import InputError, Network, parse_graph

    if isinstance(graph, Network):
        return graph
    if isinstance(graph, str | PathLike):
        return parse_graph(graph if isinstance(graph, str) else str(graph), seed, clean)
    if not hasattr(graph, "edges"):
        kind = type(graph).__name__
        raise InputError(
            f"graph: a {kind}; a file, a family, a networkx graph or a Network is needed"
        )
    return Network.from_networkx(graph, clean=clean)
