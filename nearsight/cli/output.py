"""What goes to stdout and stderr: JSON for programs, tables for people, progress."""

from __future__ import annotations

import json
import math
import sys
import time
from typing import TYPE_CHECKING, Any

import click

if TYPE_CHECKING:
    from ..bounds import Setting


def print_json(document: dict[str, Any]) -> None:
    """Print one JSON document: numbers as numbers, what is not finite as null."""
    click.echo(json.dumps(_plain(document), allow_nan=False))


def _plain(value: Any) -> Any:
    if isinstance(value, dict):
        return {str(key): _plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [_plain(item) for item in value]
    if hasattr(value, "tolist"):  # numpy
        return _plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def costs(s: Setting) -> dict[str, Any]:
    """Return the strengths of the costs under their JSON names."""
    p = s.parameters
    return {"mu": p.mu, "l_f": p.l_f, "l_T": p.l_T, "l_S": p.l_S}


def network(s: Setting) -> dict[str, Any]:
    """Return what is known of the network without measuring all of it."""
    g = s.growth
    sizes = {"vertices": g.vertices, "edges": g.edges, "max_degree": g.max_degree}
    document: dict[str, Any] = {"source": g.source, **sizes, "exact": g.exact}
    if g.vertices is None:
        document["reason"] = "the number of vertices is infinite or unknown"
    return document


def size_of(vertices: int, edges: int | None) -> str:
    """Return how large a network is, for people."""
    return f"{vertices} agent{'s' * (vertices != 1)}, {edges} edge{'s' * (edges != 1)}"


def headline(s: Setting) -> str:
    """Return one line on the network and one on the costs, for people."""
    g, p = s.growth, s.parameters
    size = f"{size_of(g.vertices, g.edges)}, " if g.vertices is not None else ""
    sets = "every set all of R^n" if s.unconstrained else "any convex product constraints"
    return (
        f"{g.source}: {size}degree at most {g.max_degree}\n"
        f"mu = {p.mu:g}, l_f = {p.l_f:g}, l_T = {p.l_T:g}, l_S = {p.l_S:g}; {sets}"
    )


class Progress:
    """A line on stderr that says what is being done, once it has taken over a second."""

    def __init__(self) -> None:
        self._start = self._last = time.monotonic()
        self._shown = False

    def __call__(self, text: str) -> None:
        """Show a short text, ten times a second at most, and only on a terminal."""
        now = time.monotonic()
        if now - self._start > 1 and now - self._last > 0.1 and sys.stderr.isatty():
            self._last, self._shown = now, True
            click.echo(f"\r\x1b[K{text}", nl=False, err=True)

    def bar(self, done: int, total: int, text: str) -> None:
        """Show a bar of what is done, and what is being done."""
        filled = 20 * done // max(total, 1)
        self(f"[{'#' * filled}{'.' * (20 - filled)}] {done}/{total} {text}"[:78])

    def count(self, done: int, total: int) -> None:
        """Show how much of a network has been measured."""
        self(f"measuring the network: {done}/{total}")

    def instances(self, done: int, total: int) -> None:
        """Show how many instances have been measured."""
        self(f"instance {done}/{total}")

    def entries(self, done: int, total: int) -> None:
        """Show how many entries have been searched."""
        self(f"search {done}/{total}")

    def step(self, what: str, done: int, total: int) -> None:
        """Show how far a simulation or an iteration is."""
        self(f"{what} {done}/{total}" if total else f"{what} {done}")

    def close(self) -> None:
        """Wipe the line."""
        if self._shown:
            click.echo("\r\x1b[K", nl=False, err=True)
