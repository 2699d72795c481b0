"""The arguments of a specification such as ``grid:3x4``, from text to checked numbers."""

from __future__ import annotations

import math
from typing import Any

from .errors import InputError
from .growth import Growth

MAX_EDGES = 50_000_000
"""Families with more edges than this are refused rather than left to exhaust the memory."""


def convert(arguments: tuple[str, ...], kinds: tuple[type, ...], syntax: str) -> tuple[Any, ...]:
    """Convert the arguments of one specification.

    Parameters
    ----------
    arguments : tuple of str
        The pieces behind the colon.
    kinds : tuple of type
        `int`, `float` or `Fraction` for every argument.
    syntax : str
        What would be accepted, for the message.

    Returns
    -------
    tuple of int, float or Fraction
        In the order of `kinds`.

    Raises
    ------
    InputError
        If there are too few or too many, or one is not a finite number of its kind.
    """
    if len(arguments) != len(kinds):
        found = f"{len(arguments)} argument(s): {', '.join(arguments)}" if arguments else "none"
        raise InputError(f"{syntax} takes {len(kinds)} argument(s), not {found}")
    return tuple(_number(text, kind, syntax) for text, kind in zip(arguments, kinds, strict=True))


def _number(text: str, kind: type, syntax: str) -> Any:
    """Return one number, or say what was wanted."""
    wanted = "an integer" if kind is int else "a finite number"
    try:
        # Fraction reads decimals exactly, but also ratios, which no other argument allows
        number = kind(text.replace("/", "?"))
        finite = math.isfinite(number)
    except (ValueError, OverflowError, ZeroDivisionError) as error:
        raise InputError(f"{syntax} needs {wanted}, not {text!r}") from error
    if not finite:
        raise InputError(f"{syntax} needs {wanted}, not {text!r}")
    return number


def require(condition: bool, syntax: str, needs: str, given: object) -> None:
    """Raise `InputError` saying what a family needs, unless the condition holds."""
    if not condition:
        raise InputError(f"{syntax} needs {needs}, not {given}")


def require_size(size: float, syntax: str) -> None:
    """Raise `InputError` if a family would have more than `MAX_EDGES` edges or vertices."""
    if size > MAX_EDGES:
        raise InputError(f"{syntax} takes up to {MAX_EDGES:,} vertices and edges, this has more")


def need_degree(name: str, max_degree: int | None) -> int:
    """Return the degree that a family cannot know by itself.

    Raises
    ------
    InputError
        If none was given.
    """
    if max_degree is None:
        raise InputError(f"--growth {name} needs --max-degree D, the largest number of neighbours")
    return max_degree


def check_degree(growth: Growth, max_degree: int | None) -> None:
    """Raise `InputError` if a degree was given beside a family that has another."""
    if max_degree is not None and max_degree != growth.max_degree:
        raise InputError(
            f"--max-degree {max_degree} contradicts --growth {growth.source}, "
            f"whose degree is {growth.max_degree}; leave it out"
        )
