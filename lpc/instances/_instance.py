"""A random problem with given constants, on any network."""

from __future__ import annotations

import pkgutil
from functools import cache
from importlib import import_module
from types import ModuleType
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from ...bounds.arithmetic import kind_of
from ...bounds.parameters import Parameters
from ...graphs import InputError, Network
from ..arrays import Floats, family, fits, spread
from ..problem import Problem
from ..sets import Box, Everywhere
from ._draw import Draw
from ._targets import draw_targets


def instance(
    network: Network,
    H: int,
    parameters: Parameters,
    *,
    style: str = "attraction",
    targets: str | ArrayLike = "normal",
    n: int = 1,
    seed: int = 0,
    box: tuple[ArrayLike, ArrayLike] | None = None,
    varying: bool = False,
) -> Problem:
    """Return a random problem whose constants are exactly mu, l_f, l_T and l_S.

    "Exactly" means that no Hessian leaves them, and that they are attained: mu and l_f by a node
    cost each (mu only, if there is but one eigenvalue: one agent, n = 1, not `varying`), l_T by a
    temporal cost, l_S by a spatial cost (if there is an edge). The bent styles, which are not
    quadratic, attain the smoothness at one point and approach mu far away. Node costs are 0 at the
    targets.

    Parameters
    ----------
    network : Network
    H : int
        The number of steps, at least 1.
    parameters : Parameters
        mu, l_f, l_T, l_S: one float each.
    style : str
        The kind of costs, one of `styles`.
    targets : str or array_like, shape ([[H,] N,] n)
        The kind of targets, one of `target_kinds`, or the targets. ``"far:3,2"`` is zero within
        3 steps and 2 hops of a random agent, ``"far:3,2,7"`` of agent 7.
    n : int
        The number of entries of one action, at least 1.
    seed : int
        At least 0. The targets depend on nothing but the network, H, n and the seed, so that
        instances of different styles share them.
    box : (lower, upper), optional
        Bounds of the actions, see `Box`; the targets may lie outside. All of R^n if omitted.
    varying : bool
        Whether Hessians change with the step and strengths from member to member, within the
        constants. If not, Hessians are steady; targets change in either case.

    Raises
    ------
    InputError
        If an argument cannot be used; the message says what would be accepted.

    References
    ----------
    Paper, Assumption 2.1 (``assump:costs-and-feasible-sets``).
    """
    counts: tuple[tuple[str, Any, int], ...] = (("H", H, 1), ("n", n, 1), ("seed", seed, 0))
    for name, value, least in counts:
        whole = isinstance(value, int | np.integer) and not isinstance(value, bool)
        if not whole or value < least:
            raise InputError(f"{name} = {value!r}: an integer >= {least} is needed", name)
    constants = (parameters.mu, parameters.l_f, parameters.l_T, parameters.l_S)
    if kind_of(*constants) != "float" or any(np.ndim(c) for c in constants):
        raise InputError("parameters: one float each is needed for mu, l_f, l_T, l_S", "parameters")
    known = _modules()
    if style not in known:
        raise InputError(f"style = {style!r}: one of {', '.join(known)}", "style")
    theta = _theta(targets, network, H, n, seed)
    draw = Draw(network, H, n, parameters, theta, np.random.default_rng([seed, 1]), varying)
    node, temporal, spatial = known[style].build(draw)
    feasible = Everywhere() if box is None else Box(*box)
    return Problem(network, H, node, temporal, spatial, feasible)


def styles() -> dict[str, str]:
    """Return every style of instances with one line on it, in alphabetical order."""
    return {name: str(module.ABOUT) for name, module in _modules().items()}


@cache
def _modules() -> dict[str, ModuleType]:
    """Import the modules of this folder that do not start with an underscore, by `NAME`."""
    package = import_module(__package__ or "")
    names = [m.name for m in pkgutil.iter_modules(package.__path__) if not m.name.startswith("_")]
    found = [import_module(f"{__package__}.{name}") for name in sorted(names)]
    return {str(module.NAME): module for module in found}


def _theta(targets: str | ArrayLike, network: Network, H: int, n: int, seed: int) -> Floats:
    if isinstance(targets, str):
        return draw_targets(targets, network, H, n, np.random.default_rng([seed, 0]))
    given = family(targets, 1, "targets")
    fits(given, H, network.vertices, "targets")
    if given.shape[-1] != n:
        raise InputError(f"targets: {given.shape[-1]} entries, not n = {n}", "targets")
    return spread(given, H, network.vertices)
