"""Random positive semidefinite couplings without any structure."""

from __future__ import annotations

from ..costs import Cost, Quadratic
from ._draw import Draw

NAME = "blocks"
ABOUT = "random positive semidefinite 2n x 2n couplings of norm l, random node matrices"


def build(draw: Draw) -> tuple[Cost, Cost, Cost]:
    """Return node, temporal and spatial costs, every matrix in random axes."""
    temporal, spatial = draw.pairs()
    return draw.node(rotated=True), _pair(draw, *temporal), _pair(draw, *spatial)


def _pair(draw: Draw, members: int, l: float) -> Quadratic:  # noqa: E741 - the paper's letter
    """Return ``w' Q diag(e) Q' w / 2``, e uniform in [0, s] with the largest equal to s."""
    Q = draw.orthogonal(members, 2 * draw.n)
    shares = draw.rng.random(Q.shape[:-1])
    shares[..., -1] = 1.0
    values = shares * draw.strengths(members, l)[..., None]
    return Quadratic((Q * values[..., None, :]) @ Q.swapaxes(-1, -2))
