"""Profiles of measured, searched and promised sensitivities over time and over space."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from ...bounds import Parameters
from ...graphs import parse_graph
from ...lpc.instances import instance
from ...lpc.local import LocalProblem
from ...perturbation import Spec, Target, measure
from ...perturbation.neighbourhood import Neighbourhood
from ...perturbation.search import Climb
from ..looks import LOOKS, MEASURED, SEARCHED, TIERS
from ..parts import constants, last_part, legend_below, plain
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._couplings import say
from ._grids import whole_ticks
from ._text import heading, log_axis

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_SMALL = 80  # free numbers of a local problem up to which worst cases are searched
_STEPS = 300  # of a search
_WIDEST = 3  # agents a block
_SIDES = {"time": ("top", "bottom"), "space": ("lateral",)}


def compute(subject: Subject, progress: Progress) -> Table:
    """Return one row for each network, direction and distance.

    The networks are the subject's and a ring of blocks with about its largest degree. In time:
    the largest over top and bottom variables so many steps away, in space over lateral variables
    so many hops away; of each tier the largest promise for one of these.
    """
    d = min(max(subject.setting.max_degree // 2, 1), _WIDEST)
    ring = parse_graph(f"ring-of-blocks:{2 * subject.r + 4}x{d}")
    found: list[dict[str, Any]] = []
    for place, network in enumerate((subject.network, ring)):
        spec = Spec(network, subject.parameters, subject.k, subject.r, seed=subject.seed)
        name = last_part(network.source)
        progress(f"{name}: instances")
        cells = measure(spec, subject.instances).profiles
        progress(f"{name}: search")
        searched = _searched(spec)
        for direction, parts in _SIDES.items():
            at = "dt" if direction == "time" else "ds"
            mine = [cell for cell in cells if cell.part in parts]
            for distance in sorted({getattr(cell, at) for cell in mine}):
                level = [cell for cell in mine if getattr(cell, at) == distance]
                row: dict[str, Any] = {"place": place, "network": name}
                row |= {"direction": direction, "distance": distance}
                row["measured"] = max(cell.measured_max for cell in level)
                row["searched"] = searched.get((direction, distance))
                for tier in TIERS:
                    row[tier] = max(cell.bounds[tier] for cell in level)
                found.append(row)
    return Table.of(found)


def _searched(spec: Spec) -> dict[tuple[str, int], float]:
    """Return the largest sensitivities that a short search reaches around one agent."""
    v = int(spec.network.degrees.argmax())
    around = Neighbourhood.of(spec.network, v, spec.r)
    made = instance(around.network, spec.k, spec.parameters)  # its costs play no part
    window = LocalProblem(made, 1, 0, spec.k, spec.r)
    found: dict[tuple[str, int], float] = {}
    if len(window.terms.free) > _SMALL or not (spec.parameters.l_T or spec.parameters.l_S):
        return found
    for key, target in _targets(around, spec.k, spec.r, spec.parameters):
        climb = Climb.of(window, target, spec.parameters)
        start = climb.couplings.differences(climb.response.columns)
        found[key] = climb.value(climb.climb(start, _STEPS))
    return found


def _targets(
    around: Neighbourhood, k: int, r: int, p: Parameters
) -> Iterator[tuple[tuple[str, int], Target]]:
    """Yield one free and one fixed action for each distance: of one agent, and of one step."""
    if p.l_T:
        for t in range(1, k):
            yield ("time", k - t), Target((t, 0), (k, 0))
    hops = around.distance
    rim = np.flatnonzero(hops[0] == r)
    if p.l_S and len(rim):
        u = int(rim[0])
        inside = hops[0] < r
        for distance in range(1, int(hops[u][inside].max()) + 1):
            (free,) = np.nonzero(inside & (hops[u] == distance))
            yield ("space", distance), Target((1, int(free[0])), (1, u))


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw one row of panels a direction, one column a network."""
    figure = size.figure("page", 0.62)
    panels = figure.subplots(2, 2, sharex="row", sharey="row")
    for row, direction in enumerate(_SIDES):
        unit = "steps to a top or bottom" if direction == "time" else "hops to a lateral"
        for place, panel in enumerate(panels[row]):
            _profile(panel, table.where(place=place, direction=direction))
            panel.set_xlabel(f"{unit} variable")
        panels[row, 0].set_ylabel("sensitivity")
        distances = table.where(direction=direction).numbers("distance")
        if len(distances):
            whole_ticks(panels[row, 0], distances)
        if any(panel.lines for panel in panels[row]):
            log_axis(panels[row, 0])
        else:
            panels[row, 0].set(xticks=[], yticks=[])
    for place, panel in enumerate(panels[0]):
        panel.set_title(plain(str(table.where(place=place).values("network")[0]), 40, 12))
    axes = list(panels.ravel())
    if any(panel.get_legend_handles_labels()[1] for panel in axes):
        legend_below(figure, axes)
    given = constants(subject, "mu", "l_f", "l_T", "l_S", "k", "r")
    heading(figure, [given, f"{subject.instances} instances"])
    return figure


def _profile(panel: Axes, rows: Table) -> None:
    """Draw what is positive; a promise of 0 is below every axis."""
    from matplotlib import rcParams

    looks = {**{t: LOOKS[t] for t in TIERS}, "measured": MEASURED, "searched": SEARCHED}
    lines = {name: rows.numbers(name) for name in looks}
    if not rows.rows or not any((values > 0).any() for values in lines.values()):
        say(panel, "no influence" if rows.rows else "all are nearer than $r$ hops:\nno boundary")
        return
    for name, look in looks.items():
        values = np.where(lines[name] > 0, lines[name], np.nan)
        if not np.isnan(values).all():
            alone = {"linestyle": "", "zorder": 4, "markersize": 1.4 * rcParams["lines.markersize"]}
            changes = alone if name == "searched" else {}
            panel.plot(rows.numbers("distance"), values, **look.plot(**changes))
    panel.grid(axis="y")


PICTURE = Picture(
    name="decay-profiles",
    title="Profiles of measured, searched and promised sensitivities over time and space.",
    caption="The largest derivative of a local solution in one boundary variable at each distance: "
    "over random instances, as far as a search over all quadratic costs with these constants "
    "reaches, and as promised; on a network and on a ring of blocks with about its largest degree.",
    compute=compute,
    draw=draw,
    subject=Subject("regular:4x40", l_f=4, l_T=1, l_S=0.05, k=5, r=3, instances=12),
    takes=("graph", "mu", "l_f", "l_T", "l_S", "k", "r", "instances", "seed"),
)
