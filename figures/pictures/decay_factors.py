"""Decay factors of every tier and of the lower bounds, and what lies between them."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from ...bounds import Parameters, bounds_for
from ...lpc.arrays import Floats
from ..looks import INK, LOWER, REPAIRED, SHARP, STATED
from ..parts import legend_below, network_name, thin
from ..picture import Picture, Progress
from ..size import Size
from ..subject import Subject
from ..table import Table
from ._couplings import count_axis, grid, logarithmic, mark_here, rate_axis, say
from ._text import heading

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LETTERS = {"time": "T", "space": "S"}
_FACTORS = {"time": "k", "space": "r"}
_LINES = {
    "rho": STATED.plot(label=r"$\rho$ (stated, repaired)"),
    "gamma": SHARP.plot(label=r"$\gamma$ (sharp)"),
    "gamma_squared": SHARP.plot(
        label=r"$\gamma^2$ (sharp, CR $-$ 1)", linestyle=(0, (1, 1)), marker=""
    ),
    "lambda_stated": STATED.plot(label=r"$\lambda$ (stated lower)", marker="^", linestyle="-"),
    "lambda_proven": LOWER.plot(label="proven lower"),
}
_TIERS = {
    "stated": STATED.plot(label="factor, stated rates"),
    "repaired": REPAIRED.plot(label="factor, repaired"),
    "sharp": SHARP.plot(label="factor, sharp"),
}


def compute(subject: Subject, progress: Progress) -> Table:
    """Return one row for each direction and strength of its coupling."""
    p = subject.parameters
    found: list[dict[str, Any]] = []
    for direction, given in (("time", p.a_T), ("space", p.a_S)):
        if direction == "space" and not subject.setting.max_degree:
            continue
        couplings = grid(1e-3, 1e3, 10, given)
        strengths = p.mu * couplings
        at = replace(subject.setting, parameters=Parameters(p.mu, p.l_f, strengths, strengths))
        columns = _columns(direction, at, len(couplings))
        for i, coupling in enumerate(couplings):
            row = {name: _number(values[i]) for name, values in columns.items()}
            found.append({"direction": direction, "coupling": float(coupling), **row})
        progress(direction)
    return Table.of(found)


def _columns(direction: str, at: Any, size: int) -> dict[str, Floats]:
    """Return the rates and factors that the theorems give, NaN where they give none."""
    letter, factor = _LETTERS[direction], f"{_FACTORS[direction]}_ratio"

    def of(label: str, tier: str, name: str) -> Floats:
        (bound,) = (b for b in bounds_for(label) if b.tier == tier)
        return np.broadcast_to(np.asarray(bound.in_floats(at).get(name, np.nan)), size)

    gamma = of("thm:networked-exp-decay", "repaired", f"gamma_{letter}")
    augmented = "coro:resource-augmentation"
    return {
        "rho": of("thm:networked-exp-decay", "repaired", f"rho_{letter}"),
        "gamma": gamma,
        "gamma_squared": gamma**2,
        "lambda_stated": of("thm:bottleneck", "stated", f"lambda_{letter}"),
        "lambda_proven": of("thm:bottleneck", "repaired", f"lambda_{letter}"),
        "factor_printed": of(augmented, "stated", factor),
        "factor_stated": of(augmented, "stated", f"{factor}_of_rates"),
        "factor_repaired": of(augmented, "repaired", factor),
        "factor_sharp": of(augmented, "sharp", factor),
    }


def _number(value: float) -> float | None:
    return None if np.isnan(value) else float(value)


def draw(table: Table, subject: Subject, size: Size) -> Figure:
    """Draw rates above, factors beneath; time on the left, space on the right."""
    figure = size.figure("page", 0.62)
    panels = figure.subplots(2, 2, sharex="col", height_ratios=(1.7, 1))
    p, degree = subject.parameters, subject.setting.max_degree
    titles = ("time", f"space, largest degree {degree}")
    names = (r"temporal coupling $\ell_T/\mu$", r"spatial coupling $\ell_S/\mu$")
    rates = np.concatenate([table.numbers(name) for name in ("rho", "lambda_proven")])
    for j, direction in enumerate(_LETTERS):
        above, below = panels[:, j]
        rows = table.where(direction=direction)
        above.set_title(titles[j])
        below.set_xlabel(names[j])
        below.set_ylabel(f"factor in ${_FACTORS[direction]}$")
        if not rows.rows:
            say(above, "no edges: nobody depends on others")
            say(below, "no edges")
            for panel in (above, below):
                panel.set(xticks=[], yticks=[])
            continue
        _rates(above, rows)
        rate_axis(above, np.append(rates, rows.numbers("gamma_squared")))
        _ratios(below, rows, _FACTORS[direction])
        logarithmic(below, rows.numbers("coupling"))
        for panel in (above, below):
            mark_here(panel, (p.a_T, p.a_S)[j])
    panels[0, 0].set_ylabel("rate per step, hop")
    legend_below(figure, [panels[0, 0], panels[0, 1], panels[1, 0], panels[1, 1]])
    heading(figure, [f"{network_name(subject)}: decay factors, upper and lower bounds"])
    return figure


def _rates(panel: Axes, rows: Table) -> None:
    for turn, (name, look) in enumerate(_LINES.items()):
        values = rows.numbers(name)
        if not np.isnan(values).all():
            every = (3 + 2 * turn, 12)
            panel.plot(rows.numbers("coupling"), values, markevery=every, **look)
    panel.grid(axis="y")


def _ratios(panel: Axes, rows: Table, sight: str) -> None:
    """Draw ``log lower/log upper``: how much more LPC needs, per unit of the best algorithm."""
    x = rows.numbers("coupling")
    seen = [np.ones(1)]
    for turn, (tier, look) in enumerate(_TIERS.items()):
        values = rows.numbers(f"factor_{tier}")
        if not np.isnan(values).all():
            panel.plot(x, values, markevery=(3 + 3 * turn, 12), **look)
            seen.append(values)
    printed = float(rows.numbers("factor_printed")[0])
    panel.axhline(printed, color=INK, linewidth=thin())
    panel.annotate(
        f"printed: ${sight} = {printed:g}\\,{sight}^*$",
        (0.985, printed),
        xycoords=("axes fraction", "data"),
        xytext=(0, 2),
        textcoords="offset points",
        ha="right",
        va="bottom",
        color=INK,
    )
    count_axis(panel, np.append(np.concatenate(seen), 1.35 * printed))
    panel.grid(axis="y")


PICTURE = Picture(
    name="decay-factors",
    title="Decay factors of all tiers and of the lower bounds over the coupling strength.",
    caption="Above: factors per step (left) and per hop (right); rho and gamma bound how one "
    "boundary variable moves an action, gamma squared and lambda how CR - 1 falls in k and r. The "
    "printed lambda lies above gamma squared, which LPC attains, where it is no lower bound. "
    "Below: log(lower)/log(upper), what LPC needs in k and r over the best algorithm as both grow. "
    "Dotted: the couplings given.",
    compute=compute,
    draw=draw,
    subject=Subject("regular:3x20", l_T=1, l_S=0.5),
    takes=("graph", "mu", "l_f", "l_T", "l_S"),
)
