"""Convex functions of one variable and two derivatives, without overflow or cancellation."""

from __future__ import annotations

import numpy as np
from scipy.special import expit

from ..arrays import Floats


def logcosh(z: Floats) -> Floats:
    """``log cosh z``, accurate to a few ulp: ``z^2/2`` near 0, ``|z| - log 2`` far away."""
    size = np.abs(z)
    near: Floats = np.log1p(2 * np.sinh(0.5 * np.minimum(size, 1.0)) ** 2)
    far: Floats = (size - np.log(2.0)) + np.log1p(np.exp(-2 * size))
    found: Floats = np.where(size < 1, near, far)
    return found


def rise(z: Floats) -> Floats:
    """``tanh z``, the derivative of `logcosh`."""
    return np.tanh(z)


def bell(z: Floats) -> Floats:
    """``1/cosh(z)^2``, the second derivative of `logcosh`."""
    fall = np.exp(-2 * np.abs(z))
    found: Floats = 4 * fall / (1 + fall) ** 2
    return found


def softplus(z: Floats) -> Floats:
    """``log(1 + exp z)``."""
    found: Floats = np.maximum(z, 0.0) + np.log1p(np.exp(-np.abs(z)))
    return found


def logistic(z: Floats) -> Floats:
    """``1/(1 + exp(-z))``, the derivative of `softplus`."""
    found: Floats = expit(z)
    return found


def hyperbola(z: Floats) -> Floats:
    """``sqrt(1 + z^2)``."""
    return np.hypot(1.0, z)


def tilt(z: Floats) -> Floats:
    """``z/sqrt(1 + z^2)``, the derivative of `hyperbola`."""
    found: Floats = z / np.hypot(1.0, z)
    return found


def bump(z: Floats) -> Floats:
    """``(1 + z^2)^(-3/2)``, the second derivative of `hyperbola`."""
    found: Floats = (1.0 / np.hypot(1.0, z)) ** 3
    return found


NAMES = ("logcosh", "rise", "bell", "softplus", "logistic", "hyperbola", "tilt", "bump")
"""The functions of this file, under the names that compiled formulas call them by."""
