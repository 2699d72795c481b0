"""Neighbours in space are pushed to opposite actions, neighbours in time are drawn together."""

from __future__ import annotations

from ..costs import Cost
from ._draw import Draw

NAME = "repulsion"
ABOUT = "(l_S/4)|x_u + x_v|^2 on edges, (l_T/4)|x_t - x_(t-1)|^2 in time"


def build(draw: Draw) -> tuple[Cost, Cost, Cost]:
    """Return node, temporal and spatial costs; diagonal node matrices."""
    temporal, spatial = draw.pairs()
    return draw.node(), draw.difference(*temporal), draw.difference(*spatial, sign=1.0)
