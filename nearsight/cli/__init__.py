"""The command line: a thin skin over the Python interface, one file a command."""

from __future__ import annotations

import signal
import sys
from typing import TYPE_CHECKING

from .group import cli

if TYPE_CHECKING:
    import click


def main() -> None:
    """Run the command line; bad input ends with one line on stderr and status 2."""
    import click

    if hasattr(signal, "SIGPIPE"):  # end quietly when the reader, `head` perhaps, has seen enough
        signal.signal(signal.SIGPIPE, signal.SIG_DFL)
    try:
        sys.exit(cli.main(standalone_mode=False) or 0)
    except click.exceptions.NoArgsIsHelpError as error:
        click.echo(error.format_message(), err=True)
        sys.exit(2)
    except click.MissingParameter as error:
        print(f"nearsight: {_missing(error)}", file=sys.stderr)
        sys.exit(2)
    except click.ClickException as error:
        print(f"nearsight: {' '.join(error.format_message().split())}", file=sys.stderr)
        sys.exit(2)
    except (click.Abort, KeyboardInterrupt):
        print("nearsight: interrupted", file=sys.stderr)
        sys.exit(130)
    except OSError as error:  # inputs raise errors of their own: this is the output
        print(f"nearsight: cannot write the output: {error.strerror}", file=sys.stderr)
        sys.exit(2)


def _missing(error: click.MissingParameter) -> str:
    """Return a line that names all options that are needed and not there."""
    context = error.ctx
    if context is None:
        return " ".join(error.format_message().split())
    typed = {word.partition("=")[0] for word in sys.argv}
    names = [
        option.opts[0]
        for option in context.command.params
        if option.required and not typed & set(option.opts)
    ]
    several = len(names) > 1
    said = "are needed; `{} --help` says what they are" if several else "is needed; see `{} --help`"
    return f"{', '.join(names)} {said.format(context.command_path)}"


__all__ = ["cli", "main"]
