"""The command line: a thin skin over the Python interface, one file a command."""

from __future__ import annotations

import signal
import sys

from .group import cli


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
    except click.ClickException as error:
        print(f"nearsight: {' '.join(error.format_message().split())}", file=sys.stderr)
        sys.exit(2)
    except (click.Abort, KeyboardInterrupt):
        print("nearsight: interrupted", file=sys.stderr)
        sys.exit(130)
    except OSError as error:  # inputs raise errors of their own: this is the output
        print(f"nearsight: cannot write the output: {error.strerror}", file=sys.stderr)
        sys.exit(2)


__all__ = ["cli", "main"]
