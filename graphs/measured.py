"""The growth of a finite network, computed as far as somebody asks."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .evaluate import horner
from .growth import Growth
from .network import Network
from .profile import Profile, Progress, network_profile

FIRST_RADIUS = 16
SMALL = 20_000


@dataclass(frozen=True)
class NetworkGrowth(Growth):
    """Exact growth of a finite network, from its profile.

    Small distances are cheap and usually enough, so the profile is computed up to `first` and
    extended, at least fourfold, when a larger distance is asked for; `radius`, `values` and
    `transform` need all of it. Small graphs are computed at once.

    Parameters
    ----------
    network : Network
        The graph.
    first : int
        The distance up to which the first computation goes, at least 1.
    progress : callable, optional
        Called as ``progress(done, total)`` during every computation.

    Raises
    ------
    ValueError
        If `first` is below 1.
    """

    network: Network
    first: int = FIRST_RADIUS
    progress: Progress | None = field(default=None, compare=False, repr=False)
    # the profile computed last: what is asked for never depends on it, only how long it takes
    _known: list[Profile] = field(default_factory=list, init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        """Check the first distance."""
        if self.first < 1:
            raise ValueError(f"radius is at least 1, not {self.first}")

    @property
    def infinite(self) -> bool:
        """Whether there are infinitely many vertices; here there are not."""
        return False

    @property
    def max_degree(self) -> int:
        """The largest degree of the network."""
        return self.network.max_degree

    @property
    def source(self) -> str:
        """Where the network comes from."""
        return self.network.source

    @property
    def vertices(self) -> int:
        """Number of vertices."""
        return self.network.vertices

    @property
    def edges(self) -> int:
        """Number of edges."""
        return self.network.edges

    @property
    def radius(self) -> int:
        """The largest distance between two vertices of one component."""
        return len(self.profile().h) - 1

    def values(self) -> list[int]:
        """Return ``[h(0), ..., h(radius)]``."""
        return list(self.profile().h)

    def profile(self, distance: int | None = None) -> Profile:
        """Return a profile that is complete, or reaches at least the distance.

        Parameters
        ----------
        distance : int, optional
            The distance needed; all if omitted.
        """
        known = self._known[0] if self._known else None
        if known is not None and (
            known.complete or (distance is not None and distance < len(known.h))
        ):
            return known
        reach: int | None = None
        if distance is not None and self.network.vertices > SMALL:
            reach = max(distance, self.first if known is None else 4 * len(known.h))
        found = network_profile(self.network, reach, self.progress)
        self._known[:] = [found]
        return found

    def _h(self, q: int) -> int:
        return _at(self.profile(q).h, q, 0)

    def _ball(self, q: int) -> int:
        ball = self.profile(q).ball
        return _at(ball, q, ball[-1])

    def _eta(self, q: int) -> int:
        return _at(self.profile(q).eta, q, 0)

    def _converges(self, z: Any) -> Any:
        return np.full(z.shape, True) if isinstance(z, np.ndarray) else True

    def _transform(self, z: Any) -> Any:
        return horner(self.values(), z)


def network_growth(
    network: Network, radius: int | None = None, progress: Progress | None = None
) -> NetworkGrowth:
    """Return the growth of a network; nothing is computed before it is asked for.

    Parameters
    ----------
    network : Network
        The graph.
    radius : int, optional
        A distance up to which `h`, `ball` and `eta` are likely to be needed; they are correct
        beyond it, too.
    progress : callable, optional
        Called as ``progress(done, total)`` during every computation.

    Raises
    ------
    ValueError
        If `radius` is below 1.
    """
    return NetworkGrowth(network, FIRST_RADIUS if radius is None else radius, progress)


def _at(values: tuple[int, ...], q: int, beyond: int) -> int:
    """Return an entry, or what holds beyond the last."""
    return values[q] if q < len(values) else beyond
