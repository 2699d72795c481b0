"""The command line: a thin skin over the Python interface, one file a command."""

from __future__ import annotations

import sys

from .group import cli


def main() -> None:
    """Run the command line; bad input ends with one line on stderr and status 2."""
    import click

    try:
        sys.exit(cli.main(standalone_mode=False) or 0)
    except click.ClickException as error:
        print(f"nearsight: {' '.join(error.format_message().split())}", file=sys.stderr)
        sys.exit(2)
    except (click.Abort, KeyboardInterrupt):
        print("nearsight: interrupted", file=sys.stderr)
        sys.exit(130)
    except BrokenPipeError:  # the reader, `head` perhaps, has seen enough
        sys.stderr.close()
        sys.exit(0)


__all__ = ["cli", "main"]
