"""``nearsight worst-case``: the exact worst ratio of LPC over all data of a network."""

from __future__ import annotations

import time
from pathlib import Path
from typing import Any

import click

from .options import FINITE, JSON, input_errors, option_of, options, strengths
from .output import Progress, print_json
from .paths import writable

_FILE = click.Path(dir_okay=False, path_type=Path)

_INSTANCE = [
    click.option("--horizon", type=int, help="Number of steps H."),
    click.option(
        "--style",
        default="attraction",
        show_default=True,
        help="Quadratic couplings: attraction blocks repulsion tilted.",
    ),
    click.option(
        "--dimension", "n", type=int, default=1, show_default=True, help="Entries of one action."
    ),
    click.option(
        "--varying", is_flag=True, help="Couplings differ from step to step and edge to edge."
    ),
    click.option("--problem", type=_FILE, help="A problem file, in place of all above."),
]

_RUN = [
    click.option("-k", type=int, help="Prediction horizon, >= 1."),
    click.option("-r", type=int, help="Communication radius, >= 0."),
    click.option("--search", metavar="N", type=int, default=0, help="Climb over couplings, too."),
    click.option("--save", type=_FILE, help="Write the worst instance to a problem file."),
    click.option(
        "--table",
        metavar="KMAX,RMAX",
        help="In place of -k and -r: lower bound, worst case and certificates of all k and r.",
    ),
    click.option(
        "--augmentation",
        is_flag=True,
        help="With --table: the k and r with which LPC does as well as anybody could.",
    ),
    click.option("--csv", type=_FILE, help="With --table: write the rows to a file."),
    click.option(
        "--checkpoint",
        type=_FILE,
        help="With --table or --search: keep finished rows or climbs in a file, and go on "
        "after those it holds.",
    ),
    click.option(
        "--method",
        default="auto",
        show_default=True,
        help="auto dense (the whole spectrum) lanczos (an iteration).",
    ),
    click.option(
        "--tolerance", type=float, default=1e-8, show_default=True, help="Of the iteration."
    ),
    click.option(
        "--workers", type=int, default=1, show_default=True, help="Threads; 0 for one a core."
    ),
]


@click.command("worst-case", short_help="The exact worst ratio over all data of a network.")
@options(FINITE, strengths(required=False), _INSTANCE, _RUN, JSON)
def COMMAND(
    table: str | None,
    csv: Path | None,
    augmentation: bool,
    k: int | None,
    r: int | None,
    as_json: bool,
    **given: Any,
) -> None:
    """Find the data that are worst for LPC, among all targets and starting points.

    Costs are quadratic with the constants given; the couplings are uniform unless --style
    or --varying says otherwise. The ratio is exact and attained: --save writes the
    instance, which simulate --problem replays. With --search N the couplings are varied
    as well, by N climbs: how bad LPC can be over all costs, from below.
    """
    if given["checkpoint"] is not None and table is None and not given["search"]:
        raise click.UsageError("--checkpoint needs --table or --search")
    for option, path in (("--save", given["save"]), ("--csv", csv)):
        writable(option, path)  # rather than find out after hours
    progress = Progress()
    with input_errors():
        if table is not None:
            given |= {"csv": csv, "augmentation": augmentation}
            _table(_bounds(table), {"-k": k, "-r": r}, as_json, given, progress)
            return
        for option, used in (("--csv", csv is not None), ("--augmentation", augmentation)):
            if used:
                raise click.UsageError(f"{option} needs --table")
        if k is None or r is None:
            raise click.UsageError("-k and -r needed, or --table")
        from ..worsening import worst_case

        file, drawn = _instance(given)
        found = worst_case(file, k=k, r=r, progress=progress, **drawn)
        progress.close()
    from .worst_tables import document, print_worst

    if as_json:
        print_json(document(found, given["save"]))
    else:
        print_worst(found, given["save"])


def _instance(given: dict[str, Any]) -> tuple[Path | None, dict[str, Any]]:
    """Return the file, or None, and the arguments that go with it."""
    drawn = ("graph", "clean", "mu", "l_f", "l_T", "l_S", "horizon", "style", "n", "varying")
    run = {name: value for name, value in given.items() if name not in (*drawn, "problem")}
    if given["problem"] is None:
        _needed(given)
        return None, run | {name: given[name] for name in drawn}
    typed = [option_of(name) for name in drawn if _typed(name)]
    if typed:
        raise click.UsageError(
            f"--problem {given['problem']}: the file says what {', '.join(typed)} would; "
            "leave it out"
        )
    return given["problem"], run


def _needed(given: dict[str, Any]) -> None:
    names = ("graph", "mu", "l_f", "l_T", "l_S", "horizon")
    missing = [option_of(name) for name in names if given[name] is None]
    if missing:
        raise click.UsageError(f"{', '.join(missing)} needed (or --problem FILE)")


def _typed(name: str) -> bool:
    source = click.get_current_context().get_parameter_source(name)
    return source is click.core.ParameterSource.COMMANDLINE


def _bounds(text: str) -> tuple[int, int]:
    try:
        k, r = (int(part) for part in text.split(","))
    except ValueError as error:
        raise click.UsageError(f"--table: {text!r}: two integers, such as 4,3") from error
    if k < 2 or r < 1:
        raise click.UsageError(f"--table: {text!r}: the first >= 2, the second >= 1")
    return k, r


def _table(
    most: tuple[int, int],
    sight: dict[str, int | None],
    as_json: bool,
    given: dict[str, Any],
    progress: Progress,
) -> None:
    """Print the sandwich for all k and r up to the largest."""
    from ..sandwiching import augmentation, sandwich
    from .worst_tables import print_rows, rows

    unused = [name for name, value in sight.items() if value is not None]
    others = ("problem", "save", "n", "varying", "method", "tolerance")
    unused += [option_of(name) for name in others if _typed(name)]
    if unused:
        raise click.UsageError(f"--table: {', '.join(unused)} would have no effect; leave it out")
    _needed(given)
    start = time.perf_counter()
    class_of = ("graph", "mu", "l_f", "l_T", "l_S", "clean", "seed")
    found = sandwich(
        ks=range(2, most[0] + 1),
        rs=range(1, most[1] + 1),
        save=given["csv"],
        starts=given["search"],
        progress=progress,
        **{name: given[name] for name in (*class_of, "horizon", "style", "workers", "checkpoint")},
    )
    needed = None
    if given["augmentation"]:
        needed = augmentation(found, **{name: given[name] for name in class_of})
    progress.close()
    if as_json:
        print_json(rows(found, needed, given, time.perf_counter() - start))
    else:
        print_rows(found, needed)
