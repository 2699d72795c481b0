"""What a user types after --graph and --growth."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from .errors import InputError
from .plugins import modules

if TYPE_CHECKING:
    from .growth import Growth
    from .network import Network


def parse_graph(spec: str | Path, seed: int = 0, clean: bool = False) -> Network:
    """Return the finite graph that a file holds or a specification describes.

    Parameters
    ----------
    spec : str or Path
        An existing file, see `read_graph`, or a family such as ``"grid:10x20"``. A file goes
        before a family of the same name.
    seed : int
        Seed of the random families, at least 0; the others ignore it.
    clean : bool
        Drop directions, parallel edges and self-loops of a file instead of rejecting them.

    Returns
    -------
    Network

    Raises
    ------
    InputError
        If it is neither, if the file cannot be used, or if an argument of the family is wrong.

    Examples
    --------
    >>> parse_graph("ring:13").edges
    13
    """
    from .files import SUFFIXES, read_graph
    from .network import Network

    text = str(spec)
    name, _, rest = text.partition(":")
    families = modules("families")
    if isinstance(spec, Path) or _is_file(text):
        return read_graph(Path(text), clean=clean)
    if name not in families:
        if Path(text).suffix in SUFFIXES:
            return read_graph(Path(text), clean=clean)  # to say that the file does not exist
        accepted = "  ".join(family.SYNTAX for family in families.values())
        raise InputError(
            f"--graph {text!r} is neither a file nor a family; accepted: a file "
            f"({' '.join(SUFFIXES)}) or {accepted}"
        )
    if seed < 0:
        raise InputError(f"--seed is an integer >= 0, not {seed}")
    family = families[name]
    from .arguments import convert

    try:
        arguments = convert(
            tuple(rest.split("x")) if rest else (), family.PARAMETERS, family.SYNTAX
        )
        n, edges = family.build(*arguments, seed=seed)
    except InputError as error:
        raise InputError(f"--graph {text!r}: {error}") from error
    names = getattr(family, "NAMES", None)
    return Network.from_edges(n, edges, names=names, source=text, transitive=family.TRANSITIVE)


def parse_growth(spec: str, max_degree: int | None = None) -> Growth:
    """Return the growth of an infinite family, or one typed in.

    Parameters
    ----------
    spec : str
        Such as ``"grid2"``, ``"tree:3"``, ``"poly:4,1"`` or ``"values:1,4,8,12"``.
    max_degree : int, optional
        The largest degree, where the family does not tell it (``poly`` and ``values``).

    Returns
    -------
    Growth

    Raises
    ------
    InputError
        If there is no such family, an argument is wrong, or the degree is missing or contradicts.

    Examples
    --------
    >>> parse_growth("grid2").h(3)
    12
    """
    name, colon, rest = spec.partition(":")
    families = modules("infinite")
    if name not in families:
        accepted = "  ".join(family.SYNTAX for family in families.values())
        raise InputError(f"--growth {spec!r} is no known family; accepted: {accepted}")
    try:
        growth: Growth = families[name].build(tuple(rest.split(",")) if colon else (), max_degree)
    except InputError as error:
        raise InputError(f"--growth {spec!r}: {error}") from error
    return growth


def _is_file(text: str) -> bool:
    """Whether a file of this name exists; a name the system cannot hold does not."""
    try:
        return Path(text).is_file()
    except (OSError, ValueError):
        return False
