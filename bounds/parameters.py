"""The strengths of the costs: ``mu, l_f, l_T, l_S`` of Assumption 2.1."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from ..graphs.errors import InputError
from .arithmetic import Number, kind_of
from .wide import Wide

_MEANING = {
    "mu": "strong convexity of the node costs",
    "l_f": "smoothness of the node costs",
    "l_T": "smoothness of the temporal interaction costs",
    "l_S": "smoothness of the spatial interaction costs",
}


@dataclass(frozen=True)
class Parameters:
    """Constants of the cost functions.

    Smoothness is the largest eigenvalue of a Hessian: the coupling ``b |y - z|^2`` is
    ``4 b``-smooth, ``(m/2) |y - theta|^2`` is m-strongly convex and m-smooth.

    Parameters
    ----------
    mu : float or array
        Strong convexity of every node cost, ``> 0``.
    l_f : float or array
        Smoothness of every node cost, ``>= mu``.
    l_T, l_S : float or array
        Smoothness of every temporal and of every spatial interaction cost, ``>= 0``.
        Arrays broadcast against one another. SymPy, mpmath and interval values are
        taken as they are, unchecked.

    Raises
    ------
    InputError
        If a value is not finite or outside its range.

    References
    ----------
    Paper, Assumption 2.1 (``assump:costs-and-feasible-sets``).
    """

    mu: Number
    l_f: Number
    l_T: Number
    l_S: Number

    def __post_init__(self) -> None:
        values = {name: getattr(self, name) for name in _MEANING}
        if kind_of(*values.values()) != "float":
            return
        for name, value in values.items():
            try:
                if isinstance(value, str | bytes):
                    raise TypeError
                array = np.asarray(value, dtype=np.float64)
            except (TypeError, ValueError) as error:
                raise InputError(f"{name} = {value!r} is not a number", name) from error
            positive = name in ("mu", "l_f")
            good = np.isfinite(array) & ((array > 0) if positive else (array >= 0))
            if not good.all():
                bad = array[~good].flat[0]
                accepted = "> 0" if positive else ">= 0"
                raise InputError(
                    f"{name} = {bad:g} ({_MEANING[name]}): a finite number {accepted} is needed",
                    name,
                )
            object.__setattr__(self, name, float(array) if array.ndim == 0 else array)
        try:
            np.broadcast_shapes(*(np.shape(v) for v in values.values()))
        except ValueError as error:
            shapes = ", ".join(f"{n}: {np.shape(v)}" for n, v in values.items())
            raise InputError(f"mu, l_f, l_T, l_S do not broadcast ({shapes})") from error
        l_f, mu = np.broadcast_arrays(self.l_f, self.mu)
        if np.any(l_f < mu):
            at = np.flatnonzero(l_f.ravel() < mu.ravel())[0]
            raise InputError(
                f"l_f = {l_f.flat[at]:g} < mu = {mu.flat[at]:g}: a mu-strongly convex cost is "
                "at least mu-smooth, so l_f >= mu is needed",
                "l_f",
            )

    @property
    def a_T(self) -> Number:
        """``l_T / mu``, the strength of the temporal coupling."""
        return self.l_T / self.mu

    @property
    def a_S(self) -> Number:
        """``l_S / mu``, the strength of one spatial coupling."""
        return self.l_S / self.mu

    @property
    def condition(self) -> Number:
        """``l_f / mu``, the condition number of the node costs."""
        return self.l_f / self.mu

    def converted(self, arithmetic: str) -> Parameters:
        """Return the same constants in another arithmetic.

        Parameters
        ----------
        arithmetic : {"float", "wide", "mpmath", "interval", "sympy", "arb"}
            A float is taken exactly (as the dyadic rational it is).

        Raises
        ------
        InputError
            If the arithmetic is unknown, or its library is not installed.
        """
        if arithmetic == "float":
            return self
        lift = _lifter(arithmetic)
        return Parameters(*(lift(getattr(self, name)) for name in _MEANING))


def _lifter(arithmetic: str) -> Any:
    """Return the function that takes a float exactly into an arithmetic."""
    if arithmetic == "wide":
        return Wide
    if arithmetic == "mpmath":
        from mpmath import mp

        return mp.mpf
    if arithmetic == "interval":
        from mpmath import iv

        return iv.mpf
    if arithmetic == "sympy":
        import sympy

        return sympy.Rational
    if arithmetic == "arb":
        try:
            import flint
        except ImportError as error:
            raise InputError(
                "arithmetic 'arb' needs python-flint: pip install python-flint (the extra certify)"
            ) from error
        return flint.arb
    raise InputError(
        f"arithmetic = {arithmetic!r}: one of float, wide, mpmath, interval, sympy, arb"
    )
