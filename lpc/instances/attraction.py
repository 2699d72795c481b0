"""Neighbours in time and space are drawn to each other: difference couplings."""

from __future__ import annotations

from ..costs import Cost
from ._draw import Draw

NAME = "attraction"
ABOUT = "(l_T/4)|x_t - x_(t-1)|^2 and (l_S/4)|x_u - x_v|^2: uniform difference couplings"


def build(draw: Draw) -> tuple[Cost, Cost, Cost]:
    """Return node, temporal and spatial costs; diagonal node matrices."""
    temporal, spatial = draw.pairs()
    return draw.node(), draw.difference(*temporal), draw.difference(*spatial)
