"""The sight that a target needs, over the coupling strength, in every tier."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ...bounds import Parameters, plan
from ...bounds.lower import final_excess
from ...lowerbounds import Spatial, asymmetric_excess
from ..looks import FAINT, LOOKS, LOWER, TIERS
from ..parts import legend_below, network_name, number
from ..picture import Picture, Progress
from ..size import Size
from ..subject import LEAST, Subject
from ..table import Table
from ._couplings import count_axis, grid, logarithmic, mark_here, say
from ._text import heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LARGEST = 2_000  # agents up to which the spatial lower bound of the network is computed
_AXES = {"k": "prediction horizon $k$", "r": "radius $r$ (hops)"}


def _target(subject: Subject) -> float:
    """Return the second target, or the only one."""
    return subject.target[min(1, len(subject.target) - 1)]


def compute(subject: Subject, progress: Progress) -> Table:
    """Return one row for each strength: the least ``k + r`` of every tier, and lower bounds.

    ``scale`` is what both couplings given are multiplied by. ``k_lower`` and ``r_lower`` are the
    least sight for which no lower bound of this network excludes the target, over all costs with
    these constants or smaller ones.
    """
    p, target = subject.parameters, _target(subject)
    largest = max(p.a_T, p.a_S)
    found: list[dict[str, Any]] = []
    for coupling in grid(1e-2, 1e2, 3, largest) if largest > 0 else []:
        scale = float(coupling) / largest
        at = replace(
            subject.setting,
            parameters=Parameters(p.mu, p.l_f, scale * p.l_T, scale * p.l_S),
        )
        planned = plan(at, target)
        row: dict[str, Any] = {"scale": scale, "l_T": at.parameters.l_T, "l_S": at.parameters.l_S}
        for tier in TIERS:
            one = planned[tier]
            sight = {} if one.pair is None else {"k": one.pair.k, "r": one.pair.r}
            row |= {f"{name}_{tier}": sight.get(name) for name in "kr"}
            row[f"guarantee_{tier}"] = one.guarantee
        excess = target - 1
        row["k_lower"] = _least_horizon(at.a_T, excess)
        if subject.network.vertices <= _LARGEST:
            row["r_lower"] = _least_radius(subject, at.a_S, excess)
        for name in ("k_lower", "r_lower"):  # a class holds those of weaker couplings
            if found and name in row:
                row[name] = max(row[name], found[-1][name])
        found.append(row)
        progress(f"coupling {coupling:.3g}")
    return Table.of(found)


def _least_horizon(a_T: float, excess: float) -> int:
    """Return the least k that the temporal lower bounds allow; they fall in k."""

    def excluded(k: int) -> bool:
        return max(float(final_excess(a_T, k)), float(asymmetric_excess(a_T, k))) > excess

    low, high = 0, 1
    while excluded(high):
        low, high = high, 2 * high
    while high - low > 1:
        middle = (low + high) // 2
        low, high = (middle, high) if excluded(middle) else (low, middle)
    return high


def _least_radius(subject: Subject, a_S: float, excess: float) -> int:
    """Return the least r that the spatial lower bound of the network allows."""
    radius = 0
    while Spatial(subject.network, a_S, radius).cr_minus_one > excess:
        radius += 1  # ends: at the diameter everybody knows everything
    return radius


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw k on the left, r on the right."""
    figure = size.figure("page", 0.42)
    panels = figure.subplots(1, 2)
    for panel, (name, label) in zip(panels, _AXES.items(), strict=True):
        panel.set_ylabel(label)
        if not table.rows:
            say(panel, f"nothing is coupled: {name} = {LEAST[name]} does")
            panel.set(xticks=[], yticks=[])
            continue
        _lines(panel, table, subject, name)
    if table.rows:
        legend_below(figure, list(panels))
    what = f"least $k + r$ for CR $\\leq$ {_target(subject):.15g}"
    heading(figure, [f"{network_name(subject)}: {what}"])
    return figure


def _lines(panel: Axes, table: Table, subject: Subject, name: str) -> None:
    """Draw what each tier asks for; lighter where it is no guarantee."""
    temporal = subject.l_T > 0
    x = table.numbers("l_T" if temporal else "l_S") / subject.mu
    seen = [np.array([1.0, 4.0])]
    for tier in TIERS:
        values = table.numbers(f"{name}_{tier}")
        proven = table.numbers(f"guarantee_{tier}") > 0
        some = not np.isnan(values).all()
        word = "" if some else " (out of reach)"
        panel.plot(x, np.where(proven, values, np.nan), **LOOKS[tier].plot(label=f"{tier}{word}"))
        doubtful = np.where(proven, np.nan, values)
        if not np.isnan(doubtful).all():
            look = LOOKS[tier].plot(label=f"{tier} (no guarantee)", linestyle="", alpha=0.55)
            panel.plot(x, doubtful, **look | {"marker": "+"})
        if some:
            seen.append(values)
    if f"{name}_lower" in table.columns:
        lower = table.numbers(f"{name}_lower")
        look = LOWER.plot(label="no algorithm with less")
        panel.plot(x, np.maximum(lower, 1), **look)
        panel.fill_between(x, 0.5, np.maximum(lower, 1), color=FAINT, alpha=0.15, linewidth=0)
        seen.append(np.maximum(lower, 1))
    logarithmic(panel, x)
    count_axis(panel, np.concatenate(seen))
    panel.grid(axis="y")
    mark_here(panel, (subject.l_T if temporal else subject.l_S) / subject.mu)
    if temporal:
        beside = f"$\\ell_S = {number(subject.l_S / subject.l_T, '.4g')}\\,\\ell_T$"
        panel.set_xlabel(f"coupling $\\ell_T/\\mu$, with {beside}")
    else:
        panel.set_xlabel(r"coupling $\ell_S/\mu$, with $\ell_T = 0$")


PICTURE = Picture(
    name="required-sight",
    title="The k and r that a target needs over the coupling strength, in every tier.",
    caption="The pair of least k + r whose bound is at most the target, while both couplings grow "
    "in proportion; crosses where the stated bound is no guarantee. In the shaded range no "
    "algorithm reaches the target on all costs with these constants. Dotted: the couplings given.",
    compute=compute,
    draw=draw,
    subject=Subject("torus:40x40", l_T=1, l_S=0.5, target=(1.01,)),
    takes=("graph", "mu", "l_f", "l_T", "l_S", "target"),
)
