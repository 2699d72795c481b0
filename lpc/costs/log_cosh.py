"""Costs ``sum_j c_j log cosh(a_j . w - b_j)``: quadratic near the bend, linear far away."""

from __future__ import annotations

from dataclasses import dataclass

from ..arrays import Floats
from . import stable
from .ridge import Ridge


@dataclass(frozen=True, eq=False, init=False)
class LogCosh(Ridge):
    """``base |w - centre|^2 / 2 + sum_j weights_j log cosh(directions_j . w - shifts_j)``.

    The second derivative ``1/cosh^2`` of the profile is at most 1. Parameters as in `Ridge`.
    """

    kind = "log_cosh"
    bend = 1.0

    @staticmethod
    def profile(z: Floats) -> tuple[Floats, Floats, Floats]:
        """Return ``log cosh``, ``tanh`` and ``1/cosh^2``."""
        return stable.logcosh(z), stable.rise(z), stable.bell(z)
