"""A measurement, for people."""

from __future__ import annotations

from typing import TYPE_CHECKING

import click

from .measure import exceeded
from .tables import number, show, table

if TYPE_CHECKING:
    from ..perturbation import Measurement, Searched
    from ..perturbation.profile import Cell

_MARK = "!"


def print_measurement(found: Measurement, worse: Searched | None = None) -> None:
    """Print one table a boundary part, the slices, the fitted rates and the violations."""
    spec = found.spec
    p = spec.parameters
    click.echo(
        f"{spec.network.source}: {spec.network.vertices} agents, degree at most "
        f"{spec.network.max_degree}; k = {spec.k}, r = {spec.r}"
    )
    click.echo(f"mu = {p.mu:g}, l_f = {p.l_f:g}, l_T = {p.l_T:g}, l_S = {p.l_S:g}")
    click.echo(f"{found.instances} instances, seed {spec.seed}: {', '.join(spec.styles)}")
    for part in dict.fromkeys(cell.part for cell in found.profiles):
        _print_part(part, [cell for cell in found.profiles if cell.part == part], worse)
    _print_slices(found)
    ratios = ", ".join(f"{tier} {number(value)}" for tier, value in found.jumps.items())
    click.echo(f"finite jumps of whole boundaries, moved over promised: {ratios}")
    fit = found.fit
    for name, rate in (("rho_T", fit.rho_T), ("rho_S", fit.rho_S)):
        ci = fit.ci[name]
        spread = f", 95 % interval {number(ci[0])} to {number(ci[1])}" if ci else ""
        click.echo(f"fitted {name} = {number(rate)}{spread}")
    tiers = {tier for tier, _ in found.violations} | {t for t, _ in found.slices.violations}
    tiers |= {tier for tier, value in found.jumps.items() if value > 1}
    if worse is not None:
        tiers |= {tier for tier, *_ in exceeded(found, worse)}
        target = worse.worst.found.target
        click.echo(
            f"worst entry found: step {target.free[0]} of agent {target.free[1]} against step "
            f"{target.fixed[0]} of agent {target.fixed[1]}, {number(worse.worst.ratio)} times the "
            f"{worse.worst.tier} bound"
        )
    if tiers:
        click.echo(f"{_MARK} violated: {', '.join(sorted(tiers))}")
    else:
        click.echo("no bound is violated")


def _print_part(part: str, cells: list[Cell], worse: Searched | None) -> None:
    click.echo(f"\n{part} boundary: largest sensitivity to one variable")
    tiers = list(cells[0].bounds)
    more = ["searched"] if worse is not None else []
    lines = table("dt", "ds", "measured", *more, *tiers)
    for cell in cells:
        seen = [number(worse.cells.get((part, cell.dt, cell.ds)))] if worse is not None else []
        bad = cell.violated()
        row = [number(cell.bounds[t]) + (f" {_MARK}" if t in bad else "") for t in tiers]
        lines.add_row(str(cell.dt), str(cell.ds), number(cell.measured_max), *seen, *row)
    show(lines)


def _print_slices(found: Measurement) -> None:
    slices = found.slices
    if not slices.distance:
        return
    click.echo("\nwhole slices: largest sensitivity of a step to another")
    lines = table("dt", "measured", *slices.bounds)
    for j, d in enumerate(slices.distance):
        bad = {tier for tier, distance in slices.violations if distance == d}
        row = [
            number(values[j]) + (f" {_MARK}" if tier in bad else "")
            for tier, values in slices.bounds.items()
        ]
        lines.add_row(str(d), number(slices.measured_max[j]), *row)
    show(lines)
    click.echo("")
