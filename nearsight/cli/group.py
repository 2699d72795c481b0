"""The command group: a file in this folder with a ``COMMAND`` is a command."""

from __future__ import annotations

import importlib
import pkgutil
from pathlib import Path
from typing import Any

import click

_SHARED = {
    "floor_tables",
    "group",
    "options",
    "measurement_tables",
    "output",
    "paths",
    "simulation_tables",
    "tables",
    "verdict_tables",
    "worst_tables",
}  # modules of this folder that are no commands


class Commands(click.Group):
    """Find commands by file name and import a command only when it is asked for."""

    def list_commands(self, ctx: click.Context) -> list[str]:
        """Return the names of all commands."""
        folder = str(Path(__file__).parent)
        names = (module.name for module in pkgutil.iter_modules([folder]))
        return sorted(name.replace("_", "-") for name in names if name not in _SHARED)

    def get_command(self, ctx: click.Context, cmd_name: str) -> click.Command | None:
        """Return a command by its name."""
        if cmd_name not in self.list_commands(ctx):
            return None
        module = importlib.import_module(f".{cmd_name.replace('-', '_')}", __package__)
        command: click.Command = module.COMMAND
        return command

    def resolve_command(self, ctx: click.Context, args: list[str]) -> Any:
        """Name the commands there are when an unknown one is asked for."""
        if args and self.get_command(ctx, args[0]) is None:
            there = ", ".join(self.list_commands(ctx))
            raise click.UsageError(f"no command {args[0]!r}; there are: {there}")
        return super().resolve_command(ctx, args)


@click.group(cls=Commands, context_settings={"help_option_names": ["-h", "--help"]})
@click.version_option(package_name="nearsight", prog_name="nearsight")
def cli() -> None:
    """How nearsighted may an agent be, in time (k) and in space (r)?

    Agents on a network that see k steps ahead and r hops around, each solving its own
    small predictive-control problem: what is guaranteed, and how far they must look.
    """
