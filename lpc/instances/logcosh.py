"""Difference couplings that are quadratic nearby and linear far away."""

from __future__ import annotations

import numpy as np

from ..costs import Cost, LogCosh
from ._draw import Draw

NAME = "logcosh"
ABOUT = "l log cosh((y_j - z_j)/sqrt(2)) summed over entries; nodes bent as well if l_f > mu"


def build(draw: Draw) -> tuple[Cost, Cost, Cost]:
    """Return node, temporal and spatial costs; mu and l_f as in `Draw.bent`."""
    temporal, spatial = draw.pairs()
    return draw.bent(), _pair(draw, *temporal), _pair(draw, *spatial)


def _pair(draw: Draw, members: int, l: float) -> Cost:  # noqa: E741 - the paper's letter
    """Return ``sum_j s log cosh(p_j . w)`` with orthonormal p_j: s-smooth, as at ``y = z``."""
    strengths = draw.strengths(members, l)[..., None]
    return LogCosh(draw.halves(), 0.0, np.repeat(strengths, draw.n, axis=-1))
