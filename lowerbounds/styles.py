"""Styles of instances whose costs are quadratic."""

from __future__ import annotations

from ..graphs import InputError

QUADRATIC = ("attraction", "blocks", "repulsion", "tilted")


def quadratic_style(style: str) -> str:
    """Return the style; raise `InputError` if its costs are not all quadratic."""
    if style not in QUADRATIC:
        accepted = ", ".join(QUADRATIC)
        raise InputError(f"style = {style!r}: quadratic couplings are needed: {accepted}", "style")
    return style
