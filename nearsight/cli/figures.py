"""``nearsight figures``: every picture, with the data behind it."""

from __future__ import annotations

import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

import click

from .options import FINITE, JSON, PROCESSES, input_errors, option_of, options, strengths
from .output import Progress, print_json

if TYPE_CHECKING:
    from ..figures import Drawn

_SUBJECT = [
    click.option("--horizon", type=int, help="Number of steps H."),
    click.option("-k", "k", type=int, help="Prediction horizon, or the largest of a range."),
    click.option("-r", "r", type=int, help="Communication radius, or the largest of a range."),
    click.option("-t", "t", type=int, help="The step that is drawn."),
    click.option("--agent", metavar="NAME", help="The agent that is drawn."),
    click.option("--target", metavar="CR,...", help="Competitive ratios, such as 1.1,1.01."),
    click.option("--instances", type=int, help="Number of random instances."),
]
_HOW = [
    click.option(
        "--out",
        metavar="DIR",
        type=click.Path(path_type=Path),
        default=Path("nearsight-figures"),
        show_default=True,
        help="Where to write NAME.pdf, .png, .svg and the data, NAME.csv.",
    ),
    click.option(
        "--size",
        type=click.Choice(["paper", "slides"]),
        default="paper",
        show_default=True,
        help="Columns and pages of ICML, or 16:9.",
    ),
    click.option(
        "--formats", metavar="LIST", default="pdf,png,svg", show_default=True, help="Which files."
    ),
    click.option(
        "--reuse",
        is_flag=True,
        help="Take the data that lie in DIR, if they are of the same subject: to change size or "
        "format, or to go on after an interruption.",
    ),
    PROCESSES,
]


class _Command(click.Command):
    """A command whose help ends with the figures there are."""

    def format_epilog(self, ctx: click.Context, formatter: click.HelpFormatter) -> None:
        """Write the names and titles, and what each takes."""
        from ..figures import pictures

        with formatter.section("Figures"):
            formatter.write_dl([(p.name, f"{p.title} [{_takes(p.takes)}]") for p in pictures()])


def _takes(names: tuple[str, ...]) -> str:
    return " ".join(map(option_of, names)) or "no options"


@click.command("figures", cls=_Command, short_help="Draw every picture, with its data as CSV.")
@click.argument("names", nargs=-1, metavar="[NAME]...")
@options(FINITE, strengths(required=False), _SUBJECT, _HOW, JSON)
def COMMAND(as_json: bool, **given: Any) -> None:
    """Draw the figures with these NAMEs, or all, as PDF, PNG and SVG.

    Each is of a network and of constants of its own choice; options replace them where a figure
    takes them (the list below says which). Exit status 1 if some could not be drawn.
    """
    progress = Progress()
    with input_errors():
        from ..drawing import draw

        given["target"] = _numbers(given["target"])
        given["formats"] = tuple(given["formats"].split(","))
        context = click.get_current_context()
        if context.get_parameter_source("seed") is click.core.ParameterSource.DEFAULT:
            del given["seed"]
        found = draw(progress=progress.bar, **given)
    progress.close()
    if as_json:
        print_json({"figures": [_document(one) for one in found]})
    else:
        _print(found)
    if any(one.failed for one in found):
        sys.exit(1)


def _print(found: tuple[Drawn, ...]) -> None:
    """Print a line for each figure, and on stderr what is wrong with it."""
    for one in (one for one in found if not one.failed):
        kinds = " ".join(path.suffix for path in one.files)
        beside = "  (from the data kept)" if one.reused else ""
        click.echo(f"{one.files[0].with_suffix('')}  {kinds}{beside}")
    for one in found:
        if one.failed:
            name = f"{option_of(one.argument)}: " if one.argument else ""
            click.echo(f"{one.name} was not drawn: {name}{one.failed}", err=True)
        for flaw in one.flaws:
            click.echo(f"{one.name}: {flaw}", err=True)


def _document(one: Drawn) -> dict[str, Any]:
    return {
        "name": one.name,
        "files": [str(path) for path in one.files],
        "reused": one.reused,
        "flaws": list(one.flaws),
        "seconds": one.seconds,
        "reason": one.failed or None,
    }


def _numbers(text: str | None) -> tuple[float, ...] | None:
    """Return the numbers of ``--target``."""
    if text is None:
        return None
    try:
        return tuple(float(part) for part in text.split(","))
    except ValueError as error:
        raise click.UsageError(f"--target: {text!r}: ratios such as 1.1,1.01 are needed") from error
