"""Tables for people; plain text where the output is not a terminal."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import click
import numpy as np
from rich import box
from rich.console import Console
from rich.measure import Measurement
from rich.table import Table

from ..bounds import Prices

if TYPE_CHECKING:
    from ..bounds import Plan, Result, TierPlan

_STYLE = {"stated": "yellow", "repaired": "cyan", "sharp": "green"}


def _console() -> Console:
    console = Console(highlight=False)
    console.width = max(console.width, 100)  # a terminal may fold a line, but no number is lost
    return console


def number(value: Any) -> str:
    """Format a number: integers as such, others to six significant digits."""
    if value is None:
        return "-"
    if isinstance(value, int) or (isinstance(value, float) and value.is_integer()):
        return f"{value:.0f}" if abs(value) < 1e6 else f"{value:.6g}"
    return np.array2string(np.asarray(value), precision=6) if np.ndim(value) else f"{value:.6g}"


def _show(console: Console, lines: Table) -> None:
    """Print a table without the blanks that pad its lines."""
    with console.capture() as capture:
        console.print(lines)
    for line in capture.get().rstrip().splitlines():
        click.echo(line.rstrip())


def show(lines: Table) -> None:
    """Print a table at the width of the terminal, or wider rather than break what is not to wrap.

    Where the output is not a terminal nothing wraps.
    """
    console = _console()
    measured = Measurement.get(console, console.options.update(max_width=10_000), lines)
    needed = measured.minimum if console.is_terminal else measured.maximum
    console.width = max(console.width, needed)
    _show(console, lines)


def table(*columns: str) -> Table:
    """Return an empty table; numbers are aligned to the right."""
    found = Table(box=box.SIMPLE_HEAD, pad_edge=False)
    words = ("tier", "guarantee", "bottleneck", "by")
    for name in columns:
        found.add_column(name, justify="left" if name in words else "right", no_wrap=True)
    return found


def print_plan(plan: Plan, frontier: bool) -> None:
    """Print one row a tier, then why a row is empty or no guarantee, then the frontier."""
    console = _console()
    console.print(f"target: competitive ratio <= {plan.target:.12g}")
    lines = table("tier", "k", "r", "CR - 1", "work", "guarantee", "bottleneck", "with one more")
    rows = [_plan_row(plan, t) for t in plan.tiers]
    for t, row in zip(plan.tiers, rows, strict=True):
        lines.add_row(*row, style=_STYLE[t.tier])
    _show(console, lines)
    if any("*" in row[2] for row in rows):
        console.print(
            "* every agent decides for all it is connected to; the formula asks for this r all the "
            "same",
            soft_wrap=True,
        )
    for t in plan.tiers:
        if t.reason:
            console.print(f"{t.tier}: {t.reason}", soft_wrap=True)
        if t.cheapest and plan.prices != Prices():
            price = number(plan.prices.of(t.cheapest))
            cheapest = f"k = {t.cheapest.k}, r = {t.cheapest.r}"
            console.print(f"{t.tier}: cheapest at these prices {cheapest}, for {price}")
    for t in plan.tiers if frontier else ():
        _print_frontier(console, t)


def _plan_row(plan: Plan, t: TierPlan) -> tuple[str, ...]:
    if t.pair is None or t.bottleneck is None:
        return (t.tier, "-", "-", "-", "-", "unreachable", "-", "-")
    work = t.work[t.frontier.index(t.pair)]
    b = t.bottleneck
    growth = plan.setting.growth
    everyone = growth.vertices is not None and growth.h(t.pair.r) == 0
    r = f"{t.pair.r}*" if everyone else str(t.pair.r)
    size = (str(t.pair.k), r, number(t.pair.excess), str(work))
    after = number(min(b.excess_k, b.excess_r))
    return (t.tier, *size, "yes" if t.guarantee else "no", b.name, after)


def _print_frontier(console: Console, t: TierPlan) -> None:
    if not t.frontier:
        return
    console.print(f"\n{t.tier}: all pairs that waste nothing")
    lines = table("k", "r", "CR - 1", "work", "by")
    for p, work in zip(t.frontier, t.work, strict=True):
        lines.add_row(str(p.k), str(p.r), number(p.excess), str(work), p.variant)
    _show(console, lines)


def print_results(results: list[Result], explain: bool) -> None:
    """Print one block a theorem: values, and on request the hypotheses."""
    console = _console()
    for label in dict.fromkeys(result.label for result in results):
        same = [result for result in results if result.label == label]
        console.print(f"\n[bold]{label}[/bold] ({same[0].kind})")
        for result in same:
            _print_result(console, result)
            _print_hypotheses(console, result, explain)


def _print_result(console: Console, r: Result) -> None:
    given = any(v is not None for v in r.values.values())
    sure = ("guarantee" if r.guarantee else "no guarantee") if given else "nothing yet"
    name = f"{r.tier} ({r.variant})" if r.variant else r.tier
    shown = [f"{key} = {number(v)}" for key, v in r.values.items() if v is not None]
    console.print(f"  [{_STYLE[r.tier]}]{name}[/], {sure}: ", end="")
    console.print(", ".join(shown) or "no value here", soft_wrap=True)
    for reason in dict.fromkeys(r.reasons.values()):
        names = ", ".join(key for key, why in r.reasons.items() if why == reason)
        console.print(f"      no {names}: {reason}", soft_wrap=True)


def _print_hypotheses(console: Console, r: Result, explain: bool) -> None:
    """Print all hypotheses, or those that fail and are not said already, as reasons."""
    reasons = " ".join(r.reasons.values())
    for h in r.hypotheses:
        state = "assumed" if h.holds is None else "fails" if h.fails else "holds"
        if explain or (h.fails and h.text not in reasons):
            console.print(f"      {state}: {h.text}{_margin(h.margin)}", soft_wrap=True)


def _margin(margin: Any) -> str:
    return "" if margin is None else f" (margin {number(margin)})"
