"""Options that commands share: the network and the strengths of the costs."""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import contextmanager
from importlib.util import find_spec
from typing import Any

import click

NETWORK = [
    click.option(
        "--graph",
        metavar="SPEC",
        help="A file (.graphml .gml .gexf .edgelist .adjlist .json .mtx) or a family: path:N "
        "ring:N grid:AxB torus:AxB tree:BxDEPTH complete:N star:N hypercube:D "
        "ring-of-blocks:NxD regular:DxN erdos-renyi:NxP barabasi-albert:NxM geometric:NxRADIUS "
        "ieee118.",
    ),
    click.option(
        "--growth",
        metavar="SPEC",
        help="In place of a graph, an infinite family: line grid2 grid3 tree:DELTA "
        "ring-of-blocks:D poly:C,P values:1,4,8,12.",
    ),
    click.option("--max-degree", type=int, help="Largest degree, for --growth poly and values."),
    click.option("--seed", type=int, default=0, show_default=True, help="For all that is random."),
    click.option(
        "--clean", is_flag=True, help="Drop directions, parallel edges and self-loops of a file."
    ),
]

FINITE = [NETWORK[0], *NETWORK[3:]]  # without the infinite families


def strengths(required: bool) -> list[Any]:
    """Return the options for the constants of the costs."""
    return [
        click.option(
            "--mu", type=float, required=required, help="Strong convexity of node costs, > 0."
        ),
        click.option(
            "--l-f", "l_f", type=float, required=required, help="Smoothness of node costs, >= mu."
        ),
        click.option(
            "--l-t",
            "l_T",
            type=float,
            required=required,
            help="Smoothness of temporal costs, >= 0.",
        ),
        click.option(
            "--l-s",
            "l_S",
            type=float,
            required=required,
            help="Smoothness of spatial costs, >= 0.",
        ),
    ]


COSTS = [
    *strengths(required=True),
    click.option("--unconstrained", is_flag=True, help="Every feasible set is all of R^n."),
]

_RENAMED = {"H": "--horizon", "n": "--dimension"}

PROCESSES = click.option(
    "--workers",
    type=int,
    default=0 if find_spec("joblib") else 1,
    help="Processes; 0, the default where joblib is installed, for one a core.",
)

JSON = click.option("--json", "as_json", is_flag=True, help="Print one JSON document.")


def options(*groups: Any) -> Callable[[Callable[..., Any]], Callable[..., Any]]:
    """Return a decorator that adds options, and lists of them, in the order given."""
    flat = [o for group in groups for o in (group if isinstance(group, list) else [group])]

    def add(function: Callable[..., Any]) -> Callable[..., Any]:
        for option in reversed(flat):
            function = option(function)
        return function

    return add


@contextmanager
def input_errors() -> Any:
    """Turn an unusable input into one line that names the option."""
    from ..graphs import NearsightError

    try:
        yield
    except NearsightError as error:  # a solver that fails says what to try in its place
        argument = getattr(error, "argument", None)
        name = f"{option_of(argument)}: " if argument else ""
        raise click.UsageError(name + str(error)) from error
    except MemoryError as error:
        raise click.UsageError(f"too large for the memory here: {error}") from error


def option_of(argument: str) -> str:
    """Return the option that an argument of the Python interface goes by."""
    if argument in _RENAMED:
        return _RENAMED[argument]
    return (
        f"-{argument}"
        if len(argument) == 1 and argument != "b"
        else "--" + argument.replace("_", "-").lower()
    )


def box_of(text: str | None) -> tuple[float, float] | None:
    """Return the two numbers of ``--box LO,HI``."""
    if text is None:
        return None
    try:
        low, high = (float(part) for part in text.split(","))
    except ValueError as error:
        raise click.UsageError(f"--box: {text!r}: two numbers, such as -1,1, are needed") from error
    if not (low <= high and low < math.inf and high > -math.inf):
        raise click.UsageError(f"--box: {text!r}: two numbers, the first at most the second")
    return low, high
