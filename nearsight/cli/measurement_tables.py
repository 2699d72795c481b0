"""A measurement, for people."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import click
import numpy as np

from ..perturbation import Promised
from ..perturbation.profile import PARTS, ROUNDING
from .tables import number, show, table

if TYPE_CHECKING:
    from ..perturbation import Measurement, Searched

_MARK = "!"


@dataclass(frozen=True)
class Row:
    """One boundary part and distance: what was measured, what was searched, what is promised.

    ``measured``, ``instance`` and ``searched`` are None where there was no such pair.
    """

    part: str
    dt: int
    ds: int
    measured: float | None
    instance: int | None
    searched: float | None
    bounds: dict[str, float]

    def exceeded(self, value: float | None) -> tuple[str, ...]:
        """Return the tiers whose bound a value exceeds by more than rounding explains."""
        if value is None:
            return ()
        limit = value / (1 + ROUNDING)
        return tuple(tier for tier, bound in self.bounds.items() if limit > bound)


def rows_of(found: Measurement, worse: Searched | None = None) -> list[Row]:
    """Return every part and distance that was measured or searched, in order."""
    cells = {} if worse is None else dict(worse.cells)
    rows = [
        Row(c.part, c.dt, c.ds, c.measured_max, c.instance, cells.pop(key, None), c.bounds)
        for c in found.profiles
        for key in [(c.part, c.dt, c.ds)]
    ]
    promised = Promised(found.spec.parameters, found.spec.growth)
    for (part, dt, ds), value in cells.items():  # searched, but in no instance measured
        bounds = promised.bounds(part, np.array([dt]), np.array([ds]))
        each = {tier: float(values[0]) for tier, values in bounds.items()}
        rows.append(Row(part, dt, ds, None, None, value, each))
    return sorted(rows, key=lambda row: (PARTS.index(row.part), row.dt, row.ds))


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
    rows = rows_of(found, worse)
    for part in dict.fromkeys(row.part for row in rows):
        _print_part(part, [row for row in rows if row.part == part], worse is not None)
    _print_slices(found)
    ratios = ", ".join(f"{tier} {number(value)}" for tier, value in found.jumps.items())
    click.echo(f"finite jumps of whole boundaries, moved over promised: {ratios}")
    fit = found.fit
    for name, rate in (("rho_T", fit.rho_T), ("rho_S", fit.rho_S)):
        ci = fit.ci[name]
        spread = f", 95 % interval {number(ci[0])} to {number(ci[1])}" if ci else ""
        if rate is not None:
            click.echo(f"fitted {name} = {number(rate)}{spread}")
    if fit.reason:
        click.echo(fit.reason)
    tiers = {tier for row in rows for tier in _exceeded(row)}
    tiers |= {tier for tier, _ in found.slices.violations}
    tiers |= {tier for tier, value in found.jumps.items() if value > 1}
    if worse is not None:
        _print_search(worse)
    if tiers:
        click.echo(f"{_MARK} violated: {', '.join(sorted(tiers))}")
    else:
        click.echo("no bound is violated")


def _exceeded(row: Row) -> set[str]:
    return {*row.exceeded(row.measured), *row.exceeded(row.searched)}


def _print_part(part: str, rows: list[Row], searched: bool) -> None:
    click.echo(f"\n{part} boundary: largest sensitivity to one variable")
    tiers = list(rows[0].bounds)
    lines = table("dt", "ds", "measured", *(["searched"] if searched else []), *tiers)
    for row in rows:
        bad = _exceeded(row)
        seen = [number(row.measured), *([number(row.searched)] if searched else [])]
        limits = [number(row.bounds[t]) + (f" {_MARK}" if t in bad else "") for t in tiers]
        lines.add_row(str(row.dt), str(row.ds), *seen, *limits)
    show(lines)


def _print_search(worse: Searched) -> None:
    best = worse.worst.found
    names = best.problem.network.names
    ends = [f"step {t} of agent {names[v or 0]}" for t, v in (best.target.free, best.target.fixed)]
    click.echo(
        f"worst entry found around agent {names[0]}: {ends[0]} against {ends[1]}, "
        f"{number(worse.worst.ratio)} times the {worse.worst.tier} bound"
    )


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
