"""Costs ``sum_j c_j log(1 + exp(a_j . w - b_j))``: nothing on one side, linear on the other."""

from __future__ import annotations

from dataclasses import dataclass

from ..arrays import Floats
from . import stable
from .ridge import Ridge


@dataclass(frozen=True, eq=False, init=False)
class Softplus(Ridge):
    """``base |w - centre|^2 / 2 + sum_j weights_j log(1 + exp(directions_j . w - shifts_j))``.

    The second derivative of the profile is at most 1/4. Parameters as in `Ridge`.
    """

    kind = "softplus"
    bend = 0.25

    @staticmethod
    def profile(z: Floats) -> tuple[Floats, Floats, Floats]:
        """Return ``log(1 + exp)``, the logistic function and its derivative."""
        return stable.softplus(z), stable.logistic(z), 0.25 * stable.bell(0.5 * z)
