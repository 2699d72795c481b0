"""Costs ``sum_j c_j (sqrt(1 + (a_j . w - b_j)^2) - 1)``, also called pseudo-Huber."""

from __future__ import annotations

from dataclasses import dataclass

from ..arrays import Floats
from . import stable
from .ridge import Ridge


@dataclass(frozen=True, eq=False, init=False)
class Hyperbola(Ridge):
    """``base |w - centre|^2 / 2 + sum_j weights_j (sqrt(1 + z_j^2) - 1)``.

    Here ``z_j = directions_j . w - shifts_j``. The second derivative ``(1 + z^2)^(-3/2)`` of the
    profile is at most 1. Parameters as in `Ridge`.
    """

    kind = "hyperbola"
    bend = 1.0

    @staticmethod
    def profile(z: Floats) -> tuple[Floats, Floats, Floats]:
        """Return ``sqrt(1 + z^2) - 1`` and two derivatives."""
        return z * (z / (1 + stable.hyperbola(z))), stable.tilt(z), stable.bump(z)
