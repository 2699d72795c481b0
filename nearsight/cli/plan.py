"""``nearsight plan``: the horizon and radius that a target ratio needs."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from .options import COSTS, JSON, NETWORK, input_errors, options
from .output import Progress, costs, headline, network, print_json

if TYPE_CHECKING:
    from ..bounds import Plan, TierPlan


@click.command("plan", short_help="The k and r that a target competitive ratio needs.")
@options(NETWORK, COSTS)
@click.option("--target", type=float, required=True, help="Competitive ratio to reach, > 1.")
@click.option("--price-k", type=float, default=1.0, show_default=True, help="Price of a step.")
@click.option("--price-r", type=float, default=1.0, show_default=True, help="Price of a hop.")
@click.option("--max-k", type=int, default=100_000, show_default=True, help="Largest horizon.")
@click.option("--max-r", type=int, default=10_000, show_default=True, help="Largest radius.")
@click.option("--frontier", is_flag=True, help="List all Pareto-minimal pairs.")
@JSON
@click.pass_context
def COMMAND(ctx: click.Context, /, frontier: bool, as_json: bool, **given: Any) -> None:
    """Find the least horizon k and radius r, in every tier, for a target.

    Exit status 1 if no pair is guaranteed to reach it. The pair shown is the one of
    least k + r; work is the number of free variables of the largest local problem,
    (k-1) |N_v^(r-1)|; the bottleneck is the resource whose next unit lowers the bound
    more.
    """
    progress = Progress()
    with input_errors():
        from ..api import plan

        found = plan(progress=progress, measuring=progress.count, **given)
        progress.close()
    if as_json:
        print_json(document(found))
    else:
        from .tables import print_plan

        click.echo(headline(found.setting))
        print_plan(found, frontier)
    if not any(tier.guarantee for tier in found.tiers):
        ctx.exit(1)


def document(plan: Plan) -> dict[str, Any]:
    """Return the JSON of `plan`."""
    return {
        "target": plan.target,
        "parameters": costs(plan.setting),
        "graph": network(plan.setting),
        "prices": {"k": plan.prices.k, "r": plan.prices.r},
        "plans": [_tier(plan, tier) for tier in plan.tiers],
    }


def _tier(plan: Plan, t: TierPlan) -> dict[str, Any]:
    pair, cheapest, next_unit = t.pair, t.cheapest, t.bottleneck
    return {
        "tier": t.tier,
        "guarantee": t.guarantee,
        "k": pair.k if pair else None,
        "r": pair.r if pair else None,
        "cr": pair.cr if pair else None,
        "cr_minus_one": pair.excess if pair else None,
        "variant": pair.variant if pair else None,
        "frontier": [[p.k, p.r] for p in t.frontier],
        "frontier_cr_minus_one": [p.excess for p in t.frontier],
        "work": list(t.work),
        "cheapest": cheapest
        and {"k": cheapest.k, "r": cheapest.r, "price": plan.prices.of(cheapest)},
        "bottleneck": next_unit
        and {
            "name": next_unit.name,
            "cr_minus_one_k": next_unit.excess_k,
            "cr_minus_one_r": next_unit.excess_r,
        },
        "reason": t.reason or None,
    }
