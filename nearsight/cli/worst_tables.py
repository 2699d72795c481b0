"""Worst cases and the sandwich, as JSON and for people."""

from __future__ import annotations

from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .output import size_of
from .tables import number, show, table

if TYPE_CHECKING:
    from ..bounds import Pair
    from ..lowerbounds import Augmented
    from ..lowerbounds.climb import Searched
    from ..lowerbounds.rows import Sandwich
    from ..worsening import Worsened

_CONSTANTS = ("mu", "l_f", "l_T", "l_S")
_KERNEL = "where the optimum costs nothing, LPC pays nothing: no ratio is unbounded"
_PROOF = {
    "dense": "the largest eigenvalue, from the whole spectrum, up to rounding",
    "lanczos": "an eigenvalue within the residual; an iteration says that it is the largest",
    "exact": "LPC pays what the optimum does, whatever the data; see the reason",
}


def document(found: Worsened, saved: Path | None) -> dict[str, Any]:
    """Return the JSON of `worst-case`."""
    worst, promised = found.worst, found.promised
    problem, p = worst.problem, promised.constants
    network = problem.network
    tiers: dict[str, float | None] = {}
    for result in promised.results:
        value = result.values.get("cr_minus_one")
        known = tiers.get(result.tier)
        value = None if value is None else float(value)
        tiers[result.tier] = min((v for v in (known, value) if v is not None), default=None)
    return {
        "graph": {
            "source": network.source,
            "vertices": network.vertices,
            "edges": network.edges,
            "max_degree": network.max_degree,
        },
        "parameters": {n: getattr(p, n).value for n in _CONSTANTS},
        "k": worst.k,
        "r": worst.r,
        "horizon": problem.H,
        "dimension": problem.n,
        "cr_minus_one": worst.cr_minus_one,
        "residual": worst.residual,
        "method": worst.method,
        "evidence": _PROOF[worst.method],
        **({"reason": worst.reason} if worst.reason else {}),
        "kernel": _KERNEL,
        "promised_cr_minus_one": promised.cr_minus_one,
        **({"promised_reason": promised.reason} if promised.reason else {}),
        "certificates": {tier: tiers.get(tier) for tier in ("stated", "repaired", "sharp")},
        **({"search": _search(found.searched)} if found.searched else {}),
        **(_instance(found, saved) if saved is not None else {}),
        "seconds": found.seconds,
    }


def _instance(found: Worsened, saved: Path) -> dict[str, Any]:
    return {"instance_file": str(saved), "instance_cr_minus_one": found.cr_minus_one}


def _search(found: Searched) -> dict[str, Any]:
    return {
        "cr_minus_one": found.cr_minus_one,
        "residual": found.worst.residual,
        "parameters": {n: getattr(found.constants, n).value for n in _CONSTANTS},
        "climbs": [{"start": c.start, "cr_minus_one": list(c.values)} for c in found.history],
    }


def print_worst(found: Worsened, saved: Path | None) -> None:
    """Print the network, the worst ratio beside the promise, and the search."""
    worst, promised = found.worst, found.promised
    problem = worst.problem
    network = problem.network
    click.echo(
        f"{network.source}: {size_of(problem.N, network.edges)}; "
        f"{problem.H} steps, actions of {problem.n} number{'s' * (problem.n > 1)}"
    )
    shown = (f"{name} = {getattr(promised.constants, name).value:g}" for name in _CONSTANTS)
    click.echo(f"{', '.join(shown)}; every set all of R^n")
    click.echo(f"\nLPC with k = {worst.k}, r = {worst.r}, over all targets and starting points")
    click.echo(f"worst ratio - 1   {number(worst.cr_minus_one)} ({worst.method})")
    if worst.reason:
        click.echo(f"                  {worst.reason}")
    else:
        click.echo(f"residual          {number(worst.residual)}: {_PROOF[worst.method]}")
    if found.searched is not None:
        climbs = len(found.searched.history)
        value = number(found.searched.cr_minus_one)
        click.echo(f"other couplings   {value}, the worst of {climbs} climbs")
    if promised.cr_minus_one is None:
        click.echo(f"promised          no guarantee: {promised.reason}")
    else:
        click.echo(
            f"promised          at most {number(promised.cr_minus_one)} on any such instance"
        )
    if saved is not None:
        click.echo(f"instance          {saved}")


def rows(
    found: Sandwich, needed: tuple[Augmented, ...] | None, given: dict[str, Any], seconds: float
) -> dict[str, Any]:
    """Return the JSON of `worst-case --table`."""
    return {
        "graph": {"source": given["graph"]},
        "parameters": {name: given[name] for name in _CONSTANTS},
        "horizon": given["horizon"],
        "style": given["style"],
        "rows": [asdict(row) for row in found.rows],
        "violations": [asdict(v) for v in found.violations],
        **({} if needed is None else {"augmentation": _augmentation(needed)}),
        "seconds": seconds,
    }


def _augmentation(needed: tuple[Augmented, ...]) -> dict[str, Any]:
    from ..lowerbounds import spatial_supremum, temporal_supremum

    return {
        "pairs": [
            {
                "k_star": star.k_star,
                "r_star": star.r_star,
                "lower": star.lower,
                "measured": [[p.k, p.r] for p in star.measured],
                "factors": star.factors,
                "certified": [[p.k, p.r] for p in star.certified],
                "certified_factors": star.certified_factors,
            }
            for star in needed
        ],
        "printed_rates": {"k": asdict(temporal_supremum()), "r": asdict(spatial_supremum())},
    }


def print_rows(found: Sandwich, needed: tuple[Augmented, ...] | None) -> None:
    """Print the sandwich, one row a pair, what is violated, and what LPC needs."""
    lines = table("k", "r", "lower bound", "worst case", "searched", "stated", "repaired", "sharp")
    for row in found.rows:
        values = (row.lower, row.worst, row.searched, row.stated, row.repaired, row.sharp)
        lines.add_row(str(row.k), str(row.r), *map(number, values))
    click.echo("CR - 1: lower bound over all costs; worst case of LPC on uniform couplings;")
    click.echo("certificates over all costs, of which the stated one is no guarantee")
    show(lines)
    for v in found.violations:
        click.echo(
            f"! violated at k = {v.k}, r = {v.r}: {v.tier} certificate {number(v.certificate)} "
            f"is below {v.below} = {number(v.value)}"
        )
    missing = [
        why
        for why, columns in (
            ("not searched", [row.searched for row in found.rows]),
            (
                "no certificate",
                [c for row in found.rows for c in (row.stated, row.repaired, row.sharp)],
            ),
        )
        if None in columns
    ]
    if missing:
        click.echo(f"-: {' or '.join(missing)} here")
    if not found.violations:
        click.echo("no certificate is violated")
    if needed is not None:
        _print_needed(needed)


def _print_needed(needed: tuple[Augmented, ...]) -> None:
    from ..lowerbounds import spatial_supremum, temporal_supremum

    lines = table("k*", "r*", "measured k, r", "k/k*", "r/r*", "certified k, r", "k/k*", "r/r*")
    for star in needed:
        cells = [str(star.k_star), str(star.r_star)]
        for pairs, factors in (
            (star.measured, star.factors),
            (star.certified, star.certified_factors),
        ):
            cells += [_least(pairs), *(map(number, factors) if factors else ("-", "-"))]
        lines.add_row(*cells)
    click.echo(
        "\nLPC does as well as any algorithm with k*, r* from k, r on: measured as the worst"
    )
    click.echo("case within this table, certified over all costs")
    show(lines)
    k, r = temporal_supremum(), spatial_supremum()
    click.echo(
        f"asymptotically the printed rates ask for k/k* up to {number(k.value)} (as l_T vanishes), "
        f"r/r* up to\n{number(r.value)} (at Delta l_S/mu = {number(r.coupling)}); "
        "the paper says 4 and 32"
    )


def _least(pairs: tuple[Pair, ...]) -> str:
    """Return the pair of least ``k + r``, to which the factors belong."""
    least = min(pairs, key=lambda p: (p.k + p.r, p.k), default=None)
    return "-" if least is None else f"{least.k}, {least.r}"
