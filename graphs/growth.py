"""How many agents lie at distance q: all that the theory wants to know of a graph."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any, overload

import numpy as np

from .evaluate import Floats, Integers, evaluate, true


class Growth(ABC):
    """The growth of a graph: the largest spheres, balls and boundary counts by distance.

    For ``q >= 0``, maxima over all vertices::

        h(q)    = max_v #{u : d(u, v) = q}
        ball(q) = max_v #{u : d(u, v) <= q}
        eta(q)  = max_u sum_{v : d(u, v) = q} #{w adjacent to u : d(v, w) = q - 1}

    so ``h(0) = ball(0) = 1`` and ``eta(0) = 0``. `ball` is at most the running sum of `h`, and less
    where different vertices attain the maxima. `eta(q)` counts how often a vertex is seen through
    an edge into the inside, summed over the balls of radius ``q`` on whose boundary it lies.

    A subclass gives the three as exact integers (`_h`, `_ball`, `_eta`) and `_transform`; objects
    are immutable. The properties below suit an infinite graph that is known exactly.
    """

    @property
    def exact(self) -> bool:
        """Whether `h`, `ball` and `eta` are the true maxima, not upper bounds only."""
        return True

    @property
    def infinite(self) -> bool:
        """Whether the graph has infinitely many vertices."""
        return True

    @property
    @abstractmethod
    def max_degree(self) -> int:
        """The largest degree, Delta."""

    @property
    @abstractmethod
    def source(self) -> str:
        """Where the graph comes from, e.g. ``"ring:13"``."""

    @property
    def vertices(self) -> int | None:
        """Number of vertices; None if infinite or unknown."""
        return None

    @property
    def edges(self) -> int | None:
        """Number of edges; None if infinite or unknown."""
        return None

    @property
    def radius(self) -> int | None:
        """The largest q with ``h(q) > 0``; None if the graph is infinite."""
        return None

    @overload
    def h(self, q: int) -> int: ...
    @overload
    def h(self, q: Integers) -> Floats: ...
    def h(self, q: int | Integers) -> int | Floats:
        """Largest number of vertices at distance exactly `q` from one vertex.

        Parameters
        ----------
        q : int or ndarray of int
            Distance, at least 0.

        Returns
        -------
        int or ndarray of float64
            Exact for an int; for an array correctly rounded, ``inf`` on overflow.

        Raises
        ------
        ValueError
            If a distance is negative.
        TypeError
            If a distance is not an integer.
        """
        return evaluate(self._h, q, self._overflow)

    @overload
    def ball(self, q: int) -> int: ...
    @overload
    def ball(self, q: Integers) -> Floats: ...
    def ball(self, q: int | Integers) -> int | Floats:
        """Largest number of vertices at distance at most `q`; arguments and errors as `h`."""
        return evaluate(self._ball, q, self._overflow)

    @overload
    def eta(self, q: int) -> int: ...
    @overload
    def eta(self, q: Integers) -> Floats: ...
    def eta(self, q: int | Integers) -> int | Floats:
        """Largest weighted boundary count at distance `q`; arguments and errors as `h`."""
        return evaluate(self._eta, q, self._overflow)

    def values(self) -> list[int]:
        """Return ``[h(0), ..., h(radius)]``.

        Raises
        ------
        ValueError
            If the graph is infinite.
        """
        if self.radius is None:
            raise ValueError(f"{self.source} is infinite: h(q) never ends")
        return [self._h(q) for q in range(self.radius + 1)]

    def transform(self, z: Any) -> Any:
        """``sum_{q >= 0} h(q) z^q``, the generating function of `h`, for ``z >= 0``.

        Parameters
        ----------
        z : float, ndarray of float, or any number with ``+ - * / **`` and comparisons
            Floats and arrays are evaluated as such; numbers of mpmath, mpmath's intervals, SymPy
            and python-flint in their own arithmetic (a free symbol is taken to be small enough).

        Returns
        -------
        Same kind as `z`
            Infinity where the series diverges, or where an interval does not exclude it.

        Raises
        ------
        ValueError
            If `z` is negative.
        """
        if isinstance(z, int | float | np.ndarray | np.generic):
            return self._transform_floats(np.asarray(z, dtype=np.float64))
        if true(z < 0, symbolic=False):
            raise ValueError(f"transform needs z >= 0, not {z}")
        if not self._converges(z):
            return z + float("inf")
        return self._transform(z)

    def _transform_floats(self, z: Floats) -> float | Floats:
        """Evaluate `transform` in binary64, element by element."""
        if (z < 0).any():
            raise ValueError(f"transform needs z >= 0, not {z.min()}")
        result = np.full(z.shape, np.inf)
        with np.errstate(over="ignore", divide="ignore", invalid="ignore"):
            inside = np.asarray(self._converges(z) | np.isnan(z))
            result[inside] = self._transform(z[inside])
        return result if z.ndim else float(result)

    def _converges(self, z: Any) -> Any:
        """Tell where the series converges: for arrays a mask, else a bool."""
        return z < 1 if isinstance(z, np.ndarray) else true(z < 1, symbolic=True)

    @property
    def _overflow(self) -> int | None:
        """A distance beyond which `h`, `ball` and `eta` exceed every float; None if there is none.

        It spares an array the construction of integers that would not fit a float anyway.
        """
        return None

    @abstractmethod
    def _h(self, q: int) -> int:
        """Return `h` at one distance ``q >= 0``."""

    @abstractmethod
    def _ball(self, q: int) -> int:
        """Return `ball` at one distance ``q >= 0``."""

    @abstractmethod
    def _eta(self, q: int) -> int:
        """Return `eta` at one distance ``q >= 0``."""

    @abstractmethod
    def _transform(self, z: Any) -> Any:
        """Return the sum where it converges, in the arithmetic of `z`."""
