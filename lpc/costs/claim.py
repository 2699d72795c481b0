"""What the author of a cost says of its curvature."""

from __future__ import annotations

import numpy as np

from ...graphs import InputError
from ..arrays import Floats
from .cost import Curvature


def claim(lower: Floats | None, upper: Floats, what: str) -> Curvature:
    """Return claimed bounds, shape (T, I); 0 below if omitted.

    Raises
    ------
    InputError
        Unless ``0 <= lower <= upper`` for every step and member.
    """
    least = np.zeros((1, 1)) if lower is None else lower
    try:
        shape = np.broadcast_shapes(least.shape, upper.shape)
    except ValueError as error:
        raise InputError(f"{what}: lower of {least.shape} and upper of {upper.shape}") from error
    low, high = np.broadcast_to(least, shape), np.broadcast_to(upper, shape)
    bad = np.argwhere((low < 0) | (high < low))
    if len(bad):
        t, i = bad[0]
        raise InputError(
            f"{what}: claimed curvature from {low[t, i]:g} to {high[t, i]:g} at step {t + 1}, "
            f"agent or edge {i}; 0 <= lower <= upper is needed"
        )
    return Curvature(low, high, np.zeros(()), "claimed")


def compare(found: Curvature, lower: Floats | None, upper: Floats | None, what: str) -> None:
    """Raise `InputError` if what is claimed contradicts what was computed."""
    for name, said, true in (("lower", lower, found.lower), ("upper", upper, found.upper)):
        if said is None:
            continue
        try:
            gap = said - true if name == "lower" else true - said
        except ValueError as error:
            raise InputError(f"{what}: {name} of {said.shape} for {true.shape}") from error
        bad = np.argwhere(gap > found.error + 1e-12 * found.upper)  # claims are typed in
        if len(bad):
            t, i = bad[0]
            raise InputError(
                f"{what}: {name} curvature claimed as "
                f"{np.broadcast_to(said, gap.shape)[t, i]:g} at step {t + 1}, agent or edge {i}; "
                f"it is {np.broadcast_to(true, gap.shape)[t, i]:g}"
            )
