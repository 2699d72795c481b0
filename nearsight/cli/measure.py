"""``nearsight measure``: how boundary errors really decay, beside what is promised."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .options import FINITE, JSON, box_of, input_errors, options, strengths
from .output import Progress, print_json

if TYPE_CHECKING:
    from ..perturbation import Measurement, Searched
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
    click.option("--search", is_flag=True, help="Also search for worse costs within the class."),
    click.option(
        "--save",
        type=click.Path(path_type=Path),
        help="With --search: write the worst instance to a problem file.",
    ),
    click.option(
        "--checkpoint",
        type=click.Path(path_type=Path),
        help="Keep completed instances in a file, and go on after those it holds.",
    ),
]


@click.command("measure", short_help="Measured perturbation decay beside the promised one.")
@options(FINITE, strengths(required=True), _OPTIONS, JSON)
def COMMAND(as_json: bool, box: str | None, search: bool, save: Path | None, **given: Any) -> None:
    """Measure sensitivities of random local problems, by distance in time and space.

    For every boundary part (top, bottom, lateral) and distance: the largest derivative
    of an action in one boundary action, over random instances with exactly the given
    constants, beside the bounds of all tiers. A bound that an instance exceeds is listed
    as violated. The seed and the number of an instance reproduce it.

    With --search the couplings of one local problem, around an agent with most
    neighbours, are also optimised to exceed the printed bounds.
    """
    if save is not None and not search:
        raise click.UsageError(f"--save {save}: it needs --search, which finds what to save")
    progress = Progress()
    with input_errors():
        from ..measuring import measure, search_sensitivity

        found = measure(box=box_of(box), progress=progress.instances, **given)
        worse = None
        if search:
            names = ("graph", "mu", "l_f", "l_T", "l_S", "k", "r", "n", "seed", "clean")
            same = {name: given[name] for name in names}
            worse = search_sensitivity(progress=progress.entries, **same)
        if worse is not None and save is not None:
            worse.worst.found.save(save)
        progress.close()
    if as_json:
        print_json(document(found, worse))
        return
    from .measurement_tables import print_measurement

    print_measurement(found, worse)


def document(found: Measurement, worse: Searched | None = None) -> dict[str, Any]:
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
    violations += [
        {"tier": tier, "part": "whole boundary", "moved_over_promised": value}
        for tier, value in found.jumps.items()
        if value > 1
    ]
    if worse is not None:
        violations += [
            {"tier": tier, "part": part, "dt": dt, "ds": ds, "searched_max": value}
            for tier, part, dt, ds, value in exceeded(found, worse)
        ]
    cells = worse.cells if worse is not None else {}
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
        "profiles": [
            {**_cell(cell), **_searched(cell, cells), "bounds": cell.bounds}
            for cell in found.profiles
        ],
        "slices": [
            {
                "dt": d,
                "measured_max": value,
                "bounds": {tier: values[j] for tier, values in slices.bounds.items()},
            }
            for j, (d, value) in enumerate(zip(slices.distance, slices.measured_max, strict=True))
        ],
        "jumps": found.jumps,
        "fit": rates,
        "violations": violations,
    }


def exceeded(found: Measurement, worse: Searched) -> list[tuple[str, str, int, int, float]]:
    """Return every (tier, part, dt, ds, value) whose bound the search exceeds."""
    return [
        (tier, cell.part, cell.dt, cell.ds, value)
        for cell in found.profiles
        if (value := worse.cells.get((cell.part, cell.dt, cell.ds))) is not None
        for tier, bound in cell.bounds.items()
        if value > bound * (1 + 1e-9)
    ]


def _searched(cell: Cell, cells: dict[tuple[str, int, int], float]) -> dict[str, float]:
    key = (cell.part, cell.dt, cell.ds)
    return {"searched_max": cells[key]} if key in cells else {}


def _cell(cell: Cell) -> dict[str, Any]:
    return {
        "dt": cell.dt,
        "ds": cell.ds,
        "part": cell.part,
        "measured_max": cell.measured_max,
        "instance": cell.instance,
    }
