"""A simulation, for people."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from .tables import number

if TYPE_CHECKING:
    from ..lpc import Simulation
    from ..lpc.promise import Promise


def print_simulation(run: Simulation, promised: Promise) -> None:
    """Print costs side by side, the ratio with its interval, and the promise."""
    problem, found = run.problem, promised.constants
    network = problem.network
    click.echo(
        f"{network.source}: {problem.N} agents, {network.edges} edges; "
        f"{problem.H} steps, actions of {problem.n} number{'s' * (problem.n > 1)}"
    )
    shown = (f"{name} = {getattr(found, name).value:g}" for name in ("mu", "l_f", "l_T", "l_S"))
    sets = "every set all of R^n" if problem.feasible.everywhere else problem.feasible.kind
    click.echo(f"{', '.join(shown)}; {sets}")
    click.echo(f"\nLPC with k = {run.k}, r = {run.r} ({run.method})")
    best = problem.costs(run.optimum.x)
    click.echo(f"{'cost':>12} {'LPC':>14} {'optimum':>14}")
    for name, part in run.costs.items():
        click.echo(f"{name:>12} {part.sum():14.8g} {best[name].sum():14.8g}")
    click.echo(f"{'total':>12} {run.cost:14.8g} {run.optimum.cost:14.8g}")
    lower, upper = run.interval
    click.echo(f"\nratio - 1   {number(run.ratio_minus_one)}, certified in ", nl=False)
    click.echo(f"[{number(lower)}, {number(upper)}]")
    if promised.cr_minus_one is None:
        click.echo(f"promised    no guarantee: {promised.reason}")
    else:
        click.echo(f"promised    at most {number(promised.cr_minus_one)} on any such instance")
    times = ", ".join(f"{name} {value:.3g} s" for name, value in run.seconds.items())
    click.echo(f"time        {times}")
