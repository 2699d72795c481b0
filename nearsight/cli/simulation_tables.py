"""A simulation, as JSON and for people."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import click

from .output import size_of
from .tables import number

if TYPE_CHECKING:
    from ..lpc import Simulation
    from ..lpc.promise import Promise

_CONSTANTS = ("mu", "l_f", "l_T", "l_S")


def document(run: Simulation, promised: Promise) -> dict[str, Any]:
    """Return the JSON of `simulate`."""
    lower, upper = run.interval
    p, best = promised.constants, run.optimum
    why = undetermined(run)
    certificate: dict[str, Any] = {
        "ratio_minus_one": [lower, upper],
        "optimum_gap": best.gap,
        "optimum_error": best.error,
        "optimum_method": best.method,
        "action_error": run.action_error,
        "violation": run.violation,
    }
    unbounded = {
        "ratio_minus_one": (upper, "the optimum may be 0, within its gap: no upper end"),
        "optimum_gap": (best.gap, "no bound is known"),
        "optimum_error": (best.error, "no bound is known"),
        "action_error": (run.action_error, f"{run.method} gives no bound"),
    }
    reasons = {name: text for name, (x, text) in unbounded.items() if not math.isfinite(x)}
    return {
        "k": run.k,
        "r": run.r,
        "horizon": run.problem.H,
        "dimension": run.problem.n,
        "cost": run.cost,
        "optimal_cost": best.cost,
        "ratio": None if why else run.ratio,
        "ratio_minus_one": None if why else run.ratio_minus_one,
        **({"ratio_reason": why} if why else {}),
        "costs": {name: float(part.sum()) for name, part in run.costs.items()},
        "optimal_costs": {n: float(part.sum()) for n, part in run.problem.costs(best.x).items()},
        "certificate": certificate | ({"reasons": reasons} if reasons else {}),
        "parameters": {n: getattr(p, n).value for n in _CONSTANTS},
        "parameters_source": {n: getattr(p, n).source for n in _CONSTANTS},
        "promised_cr_minus_one": promised.cr_minus_one,
        **({"promised_reason": promised.reason} if promised.reason else {}),
        "method": run.method,
        "seconds": run.seconds,
    }


def undetermined(run: Simulation) -> str | None:
    """Return why there is no ratio to speak of; None if there is one.

    If the optimum costs nothing, so does LPC: every cost is then 0 at the node minimisers, which
    are all that its local problems see of the boundary. What computers find are two amounts of
    rounding; their quotient means nothing.
    """
    if run.determined:
        return None
    cost, gap = run.optimum.cost, run.optimum.gap
    return f"the optimum, {cost:.3g} up to a gap of {gap:.3g}, cannot be told from 0"


def print_simulation(run: Simulation, promised: Promise) -> None:
    """Print costs side by side, the ratio with its interval, and the promise."""
    problem, found = run.problem, promised.constants
    network = problem.network
    click.echo(
        f"{network.source}: {size_of(problem.N, network.edges)}; "
        f"{problem.H} steps, actions of {problem.n} number{'s' * (problem.n > 1)}"
    )
    shown = (f"{name} = {getattr(found, name).value:g}" for name in _CONSTANTS)
    sets = "every set all of R^n" if problem.feasible.everywhere else problem.feasible.kind
    click.echo(f"{', '.join(shown)}; {sets}")
    click.echo(f"\nLPC with k = {run.k}, r = {run.r} ({run.method})")
    best = problem.costs(run.optimum.x)
    click.echo(f"{'cost':>12} {'LPC':>14} {'optimum':>14}")
    for name, part in run.costs.items():
        click.echo(f"{name:>12} {part.sum():14.8g} {best[name].sum():14.8g}")
    click.echo(f"{'total':>12} {run.cost:14.8g} {run.optimum.cost:14.8g}")
    click.echo(f"\nratio - 1   {_ratio(run)}")
    if promised.cr_minus_one is None:
        click.echo(f"promised    no guarantee: {promised.reason}")
    else:
        click.echo(f"promised    at most {number(promised.cr_minus_one)} on any such instance")
    if sum(run.seconds.values()) > 1:  # below, it would say more about the machine
        times = ", ".join(f"{name} {value:.3g} s" for name, value in run.seconds.items())
        click.echo(f"time        {times}")


def _ratio(run: Simulation) -> str:
    why = undetermined(run)
    if why:
        return f"not determined: {why}"
    lower, upper = run.interval
    return f"{number(run.ratio_minus_one)}, certified in [{number(lower)}, {number(upper)}]"
