"""Asymmetric couplings: each end of a pair feels it differently."""

from __future__ import annotations

import numpy as np

from ..costs import Cost, Quadratic
from ._draw import Draw

NAME = "tilted"
ABOUT = "(l/2)(cos(phi) y - sin(phi) z)^2, a random angle for every pair and entry"


def build(draw: Draw) -> tuple[Cost, Cost, Cost]:
    """Return node, temporal and spatial costs; diagonal node matrices."""
    temporal, spatial = draw.pairs()
    return draw.node(), _pair(draw, *temporal), _pair(draw, *spatial)


def _pair(draw: Draw, members: int, l: float) -> Quadratic:  # noqa: E741 - the paper's letter
    """Return ``sum_j (s/2) (cos(phi_j) y_j - sin(phi_j) z_j)^2``, angles uniform on the circle.

    Entry by entry the Hessian is ``s p p'`` with a unit vector p: eigenvalues 0 and s.
    """
    phi = draw.rng.uniform(0.0, 2.0 * np.pi, (draw.T, members, draw.n))
    # column j of p, shape (..., 2 n, n), holds cos(phi_j) in row j and -sin(phi_j) in row n + j
    eye = np.eye(draw.n)
    p = np.concatenate([np.cos(phi)[..., None] * eye, -np.sin(phi)[..., None] * eye], axis=-2)
    strengths = draw.strengths(members, l)[..., None, None]
    return Quadratic(strengths * (p @ p.swapaxes(-1, -2)))
