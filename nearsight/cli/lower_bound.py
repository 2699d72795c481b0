"""``nearsight lower-bound``: what no algorithm beats on this network."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import click

from .options import JSON, NETWORK, input_errors, options, strengths
from .output import Progress, print_json

_OPTIONS = [
    click.option("-k", type=int, required=True, help="Steps of look-ahead, >= 1."),
    click.option("-r", type=int, required=True, help="Communication radius, >= 0."),
    click.option(
        "--save",
        type=click.Path(dir_okay=False, path_type=Path),
        help="Write the worst instance to a problem file, for simulate --problem.",
    ),
]


@click.command("lower-bound", short_help="What no algorithm beats on this network.")
@options(NETWORK, strengths(required=True), _OPTIONS, JSON)
def COMMAND(as_json: bool, **given: Any) -> None:
    """Tell what no decentralised online algorithm beats that sees k steps and r hops.

    Over all costs with the given constants on this network: in time (one agent), in space
    (one step, the best policies together), and in both with all couplings at full
    strength. Beside them stands what the paper prints, and whether it is a guarantee.
    """
    progress = Progress()
    with input_errors():
        from ..flooring import lower_bound

        found = lower_bound(progress=lambda i, n: progress.step("source", i, n), **given)
        progress.close()
    from .floor_tables import document, print_floor

    if as_json:
        print_json(document(found))
    else:
        print_floor(found)
