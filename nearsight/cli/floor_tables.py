"""Lower bounds, as JSON and for people."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click

from .output import costs, headline, network
from .tables import number

if TYPE_CHECKING:
    from ..lowerbounds import Floor
    from ..lowerbounds.floor import Part

_NAMES = {
    "temporal": "in time, one agent",
    "spatial": "in space, one step",
    "joint": "in both, couplings at full strength",
}
_NO_CONSTANT = "printed as Omega(lambda_S^r): the rate, no number"


def document(found: Floor) -> dict[str, Any]:
    """Return the JSON of `lower-bound`."""
    s, printed = found.setting, found.stated
    return {
        "parameters": costs(s),
        "graph": network(s),
        "k": found.k,
        "r": found.r,
        "cr_minus_one": found.cr_minus_one,
        "instance": found.best,
        **{name: _part(getattr(found, name)) for name in _NAMES},
        "stated": {
            "label": "thm:bottleneck",
            "guarantee": printed.guarantee,
            "hypotheses": [
                {"text": h.text, "holds": h.holds, "margin": h.margin} for h in printed.hypotheses
            ],
            "temporal": {
                "cr_minus_one": printed.temporal,
                "lambda_T": printed.lambda_T,
                "guarantee": printed.temporal_guarantee,
            },
            "spatial": {
                "cr_minus_one": None,
                "reason": _NO_CONSTANT,
                "lambda_S": printed.lambda_S,
                "guarantee": printed.spatial_guarantee,
            },
        },
    }


def _part(part: Part) -> dict[str, Any]:
    found = {"cr_minus_one": part.cr_minus_one, "guarantee": part.cr_minus_one is not None}
    return {**found, **part.details, **({"reason": part.reason} if part.reason else {})}


def print_floor(found: Floor) -> None:
    """Print the bounds, then what the paper prints."""
    click.echo(headline(found.setting))
    click.echo(f"\nNo algorithm with k = {found.k}, r = {found.r} has a smaller CR - 1 than")
    for name, text in _NAMES.items():
        part = getattr(found, name)
        value = number(part.cr_minus_one) if not part.reason else f"- ({part.reason})"
        click.echo(f"{'*' if name == found.best else ' '} {text:38} {value}")
    printed = found.stated
    click.echo("\nThe paper's thm:bottleneck, as printed:")
    sure = "implied by the above" if printed.temporal_guarantee else "no guarantee"
    click.echo(
        f"  {'in time':38} {number(printed.temporal)}, {sure} "
        f"(lambda_T = {number(printed.lambda_T)})"
    )
    sure = "a proven rate" if printed.spatial_guarantee else "no guarantee"
    click.echo(f"  {'in space':38} rate lambda_S = {number(printed.lambda_S)}, {sure}")
