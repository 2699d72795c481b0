"""One-sided couplings: exceeding a neighbour costs, staying below it does not."""

from __future__ import annotations

import numpy as np

from ..costs import Cost, Softplus
from ._draw import Draw

NAME = "softplus"
ABOUT = "4 l log(1 + exp((y_j - z_j)/sqrt(2) - b_j)) summed over entries, random shifts b_j"


def build(draw: Draw) -> tuple[Cost, Cost, Cost]:
    """Return node, temporal and spatial costs; mu and l_f as in `Draw.bent`."""
    temporal, spatial = draw.pairs()
    return draw.bent(), _pair(draw, *temporal), _pair(draw, *spatial)


def _pair(draw: Draw, members: int, l: float) -> Cost:  # noqa: E741 - the paper's letter
    """Return ``sum_j 4 s log(1 + exp(p_j . w - b_j))``, b uniform in [-1, 1].

    The p_j are orthonormal and the second derivative of the profile is at most 1/4: s-smooth,
    attained where ``p_j . w = b_j``.
    """
    strengths = draw.strengths(members, l)[..., None]
    shifts = draw.rng.uniform(-1.0, 1.0, (draw.T, members, draw.n))
    weights = np.repeat(4.0 * strengths, draw.n, axis=-1)
    return Softplus(draw.halves(), shifts, np.broadcast_to(weights, shifts.shape))
