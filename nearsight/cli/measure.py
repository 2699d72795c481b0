"""``nearsight measure``: how boundary errors really decay, beside what is promised."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .options import FINITE, JSON, box_of, input_errors, options, strengths
from .output import Progress, print_json

if TYPE_CHECKING:
    from ..perturbation import Measurement
    from ..perturbation.profile import Cell

_OPTIONS = [
    click.option("-k", type=int, required=True, help="Prediction horizon, >= 2."),
    click.option("-r", type=int, required=True, help="Communication radius, >= 1."),
    click.option("--instances", type=int, default=100, show_default=True, help="Random instances."),
    click.option(
        "--style",
        "styles",
        multiple=True,
        help="Costs: attraction repulsion blocks tilted logcosh softplus; repeat it for several, "
        "leave it out for all.",
    ),
    click.option(
        "--dimension", "n", type=int, default=1, show_default=True, help="Entries of one action."
    ),
    click.option("--box", metavar="LO,HI", help="Every action lies between two numbers."),
    click.option(
        "--spread",
        type=float,
        default=1.0,
        show_default=True,
        help="Standard deviation of targets and boundary values.",
    ),
    click.option(
        "--workers", type=int, default=1, show_default=True, help="Processes; 0 for one a core."
    ),
    click.option("--cluster", metavar="ADDRESS", help="A Dask scheduler that does the work."),
    click.option(
        "--checkpoint",
        type=click.Path(path_type=Path),
        help="Keep completed instances in a file, and go on after those it holds.",
    ),
]


@click.command("measure", short_help="Measured perturbation decay beside the promised one.")
@options(FINITE, strengths(required=True), _OPTIONS, JSON)
def COMMAND(as_json: bool, box: str | None, **given: Any) -> None:
    """Measure sensitivities of random local problems, by distance in time and space.

    For every boundary part (top, bottom, lateral) and distance: the largest derivative
    of an action in one boundary action, over random instances with exactly the given
    constants, beside the bounds of all tiers. A bound that an instance exceeds is listed
    as violated. The seed and the number of an instance reproduce it.
    """
    progress = Progress()
    with input_errors():
        from ..measuring import measure

        found = measure(box=box_of(box), progress=progress.instances, **given)
        progress.close()
    if as_json:
        print_json(document(found))
        return
    from .measurement_tables import print_measurement

    print_measurement(found)


def document(found: Measurement) -> dict[str, Any]:
    """Return the JSON of `measure`."""
    spec, slices = found.spec, found.slices
    p = spec.parameters
    rates: dict[str, Any] = {
        "rho_T": found.fit.rho_T,
        "rho_S": found.fit.rho_S,
        "ci": {name: list(ci) if ci else None for name, ci in found.fit.ci.items()},
        "cells": found.fit.cells,
    }
    if found.fit.reason:
        rates["reason"] = found.fit.reason
    violations = [
        {"tier": tier, **_cell(cell), "bound": cell.bounds[tier]} for tier, cell in found.violations
    ]
    violations += [{"tier": tier, "part": "slice", "dt": d} for tier, d in slices.violations]
    return {
        "parameters": {"mu": p.mu, "l_f": p.l_f, "l_T": p.l_T, "l_S": p.l_S},
        "graph": {
            "source": spec.network.source,
            "vertices": spec.network.vertices,
            "edges": spec.network.edges,
            "max_degree": spec.network.max_degree,
        },
        "k": spec.k,
        "r": spec.r,
        "instances": found.instances,
        "seed": spec.seed,
        "styles": list(spec.styles),
        "profiles": [{**_cell(cell), "bounds": cell.bounds} for cell in found.profiles],
        "slices": [
            {
                "dt": d,
                "measured_max": value,
                "bounds": {tier: values[j] for tier, values in slices.bounds.items()},
            }
            for j, (d, value) in enumerate(zip(slices.distance, slices.measured_max, strict=True))
        ],
        "fit": rates,
        "violations": violations,
    }


def _cell(cell: Cell) -> dict[str, Any]:
    return {
        "dt": cell.dt,
        "ds": cell.ds,
        "part": cell.part,
        "measured_max": cell.measured_max,
        "instance": cell.instance,
    }
