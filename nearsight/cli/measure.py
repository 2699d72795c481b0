"""``nearsight measure``: how boundary errors really decay, beside what is promised."""

from __future__ import annotations

import math
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .options import FINITE, JSON, box_of, input_errors, options, strengths
from .output import Progress, print_json
from .paths import writable

if TYPE_CHECKING:
    from ..graphs import Network
    from ..perturbation import Measurement, Searched
    from .measurement_tables import Row

_FILE = click.Path(dir_okay=False, path_type=Path)

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
        type=_FILE,
        help="With --search: write the worst instance to a problem file.",
    ),
    click.option(
        "--checkpoint",
        type=_FILE,
        help="Keep completed instances in a file, and go on after those it holds.",
    ),
]


@click.command("measure", short_help="Measured perturbation decay beside the promised one.")
@options(FINITE, strengths(required=True), _OPTIONS, JSON)
def COMMAND(as_json: bool, search: bool, save: Path | None, **given: Any) -> None:
    """Measure sensitivities of random local problems, by distance in time and space.

    For every boundary part (top, bottom, lateral) and distance: the largest derivative
    of an action in one boundary action, over random instances with exactly the given
    constants, beside the bounds of all tiers. A bound that an instance exceeds is listed
    as violated. The seed and the number of an instance reproduce it.

    With --search the couplings of one local problem, around an agent with most
    neighbours, are also optimised to exceed the printed bounds.
    """
    if given["graph"] is None:
        raise click.UsageError("--graph needed: a file, or a family such as ring:13")
    if save is not None and not search:
        raise click.UsageError(f"--save {save}: it needs --search, which finds what to save")
    for option, path in (("--save", save), ("--checkpoint", given["checkpoint"])):
        writable(option, path)  # rather than find out after hours
    progress = Progress()
    with input_errors():
        from ..api import network
        from ..measuring import measure, search_sensitivity

        given |= {"box": box_of(given["box"])}
        given["graph"] = network(given["graph"], given["seed"], given["clean"])
        names = ("graph", "mu", "l_f", "l_T", "l_S", "k", "r", "n", "seed")
        same = {name: given[name] for name in names}
        if search:
            _searchable(given["graph"], given["k"], given["r"], given["n"])
        found = measure(progress=progress.instances, **given)
        worse = search_sensitivity(progress=progress.entries, **same) if search else None
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
    from .measurement_tables import rows_of

    spec, p = found.spec, found.spec.parameters
    rows = rows_of(found, worse)
    whole: dict[str, Any] = {
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
        "profiles": [_profile(row) for row in rows],
        "slices": _slices(found),
        "jumps": found.jumps,
        "fit": _fit(found),
    }
    if not whole["slices"]:
        whole["slices_reason"] = "what one agent sees is too large"
    endless = {tier: _ENDLESS for tier, value in found.jumps.items() if value == math.inf}
    if endless:
        whole["jumps_reasons"] = endless
    if worse is not None:
        whole["search"] = _search(worse)
    return whole | {"violations": _violations(found, rows)}


_ENDLESS = "the bound is 0, what it bounds is not"


def _profile(row: Row) -> dict[str, Any]:
    found: dict[str, Any] = {**_place(row), "measured_max": row.measured, "instance": row.instance}
    if row.measured is None:
        found["reason"] = "in no instance measured"
    if row.searched is not None:
        found["searched_max"] = row.searched
    return {**found, "bounds": row.bounds}


def _slices(found: Measurement) -> list[dict[str, Any]]:
    slices = found.slices
    return [
        {
            "dt": d,
            "measured_max": value,
            "bounds": {tier: values[j] for tier, values in slices.bounds.items()},
        }
        for j, (d, value) in enumerate(zip(slices.distance, slices.measured_max, strict=True))
    ]


def _fit(found: Measurement) -> dict[str, Any]:
    fit = found.fit
    rates: dict[str, Any] = {
        "rho_T": fit.rho_T,
        "rho_S": fit.rho_S,
        "ci": {name: list(ci) if ci else None for name, ci in fit.ci.items()},
        "cells": fit.cells,
    }
    reason = fit.reason
    if reason is None and None in fit.ci.values():
        reason = "one instance gives no interval"
    return rates | ({"reason": reason} if reason else {})


def _search(worse: Searched) -> dict[str, Any]:
    tier, best = worse.worst.tier, worse.worst.found
    names = best.problem.network.names
    free, fixed = ([t, str(names[v or 0])] for t, v in (best.target.free, best.target.fixed))
    found = {"agent": str(names[0]), "free": free, "fixed": fixed, "value": best.value}
    found |= {"tier": tier, "bound": best.bounds[tier], "ratio": worse.worst.ratio}
    return found | ({"reason": _ENDLESS} if worse.worst.ratio == math.inf else {})


def _violations(found: Measurement, rows: list[Row]) -> list[dict[str, Any]]:
    """Return every bound exceeded: by an instance, by the search, by a slice, by a jump."""
    listed: list[dict[str, Any]] = []
    for row in rows:
        seen = {"measured_max": row.measured, "instance": row.instance}
        for values, value in ((seen, row.measured), ({"searched_max": row.searched}, row.searched)):
            listed += [
                {"tier": tier, **_place(row), **values, "bound": row.bounds[tier]}
                for tier in row.exceeded(value)
            ]
    listed += [{"tier": tier, "part": "slice", "dt": d} for tier, d in found.slices.violations]
    jumped = [(tier, value) for tier, value in found.jumps.items() if value > 1]
    return listed + [{"tier": tier, "part": "jump", "ratio": value} for tier, value in jumped]


def _place(row: Row) -> dict[str, Any]:
    return {"dt": row.dt, "ds": row.ds, "part": row.part}


def _searchable(network: Network, k: int, r: int, n: int) -> None:
    """Raise before the long part what a search would raise after it."""
    from ..graphs import InputError
    from ..lpc.information import information_set
    from ..perturbation.response import LARGEST

    if min(k - 1, r, n) < 1:
        return  # `measure` says so
    v = int(network.degrees.argmax())
    unknowns = (k - 1) * n * len(information_set(network, 1, v, 1, r - 1).outer)
    if unknowns > LARGEST:
        raise InputError(
            f"--search: k = {k}, r = {r}, n = {n} give {unknowns} unknowns around agent "
            f"{network.names[v]}; at most {LARGEST} can be searched"
        )
