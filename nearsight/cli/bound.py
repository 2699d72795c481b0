"""``nearsight bound``: every constant of every theorem that speaks to the parameters."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from .options import COSTS, JSON, NETWORK, input_errors, options
from .output import Progress, costs, headline, network, print_json

if TYPE_CHECKING:
    from ..bounds import Result, Setting

_SHOWN = 16  # distances of an infinite growth to list


@click.command("bound", short_help="Constants and bounds of every theorem.")
@options(NETWORK, COSTS)
@click.option("-k", type=int, help="Prediction horizon, >= 2.")
@click.option("-r", type=int, help="Communication radius, >= 1.")
@click.option("--b", metavar="B1,B2", help="b_1, b_2 of thm:networked-exp-decay-tight.")
@click.option("--label", help="Only the theorem of this label.")
@click.option("--explain", is_flag=True, help="List the hypotheses with their margins.")
@JSON
def COMMAND(b: str | None, label: str | None, explain: bool, as_json: bool, **given: Any) -> None:
    """Evaluate every theorem at the given couplings and network.

    Each in the tiers it has: stated (as printed in the paper), repaired (its argument
    mended), sharp (this project's). A number is called a guarantee only where every
    hypothesis holds. With -k and -r also the bounds at that horizon and radius.
    """
    progress = Progress()
    with input_errors():
        from ..api import setting
        from ..bounds import catalogue

        s = setting(b=_pair(b), measuring=progress.count, **given)
        bounds = [t for t in catalogue() if label in (None, t.label)]
        if not bounds:
            there = ", ".join(dict.fromkeys(t.label for t in catalogue()))
            raise click.UsageError(f"--label: no theorem {label!r}; there are: {there}")
        results = []
        for theorem in bounds:
            progress(theorem.label)
            results.append(theorem.evaluate(s))
        progress.close()
    if as_json:
        print_json(document(s, results))
        return
    from .tables import print_results

    click.echo(headline(s))
    print_results(results, explain)


def _pair(text: str | None) -> tuple[float, float] | None:
    if text is None:
        return None
    try:
        b_1, b_2 = (float(part) for part in text.split(","))
    except ValueError as error:
        raise click.UsageError(f"--b: {text!r}: two numbers, such as 1,1, are needed") from error
    return b_1, b_2


def document(s: Setting, results: list[Result]) -> dict[str, Any]:
    """Return the JSON of `bound`."""
    g = s.growth
    growth = g.values() if g.radius is not None else [g.h(q) for q in range(_SHOWN)]
    graph = network(s) | {"growth": growth}
    if g.radius is None:
        graph["growth_reason"] = f"infinite: the first {_SHOWN} values"
    return {
        "parameters": costs(s),
        "graph": graph,
        "k": s.k,
        "r": s.r,
        "results": [_result(result) for result in results],
    }


def _result(r: Result) -> dict[str, Any]:
    hypotheses = [{"text": h.text, "holds": h.holds, "margin": h.margin} for h in r.hypotheses]
    return {
        "label": r.label,
        "tier": r.tier,
        "variant": r.variant,
        "kind": r.kind,
        "guarantee": r.guarantee,
        "hypotheses": hypotheses,
        "values": dict(r.values),
        "reasons": dict(r.reasons),
    }
