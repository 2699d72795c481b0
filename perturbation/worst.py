"""Where does a bound fail, or nearly fail? A search over the entries of a window as well."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from ..bounds import Parameters
from ..graphs import Growth, InputError, network_growth
from ..lpc.window import Window
from .found import Found
from .search import Climb, Progress, search
from .target import Target, promises, ratio, separation

FEW = 40  # iterations of the first look at an entry


@dataclass(frozen=True)
class Look:
    """One entry: the largest value seen beside the bounds.

    Parameters
    ----------
    target : Target
    value : float
    bounds : dict
        Of each tier.
    """

    target: Target
    value: float
    bounds: Mapping[str, float]

    def ratio(self, tier: str) -> float:
        """Return ``value / bound``, infinite where only the bound is 0."""
        return ratio(self.value, self.bounds[tier])


@dataclass(frozen=True, eq=False)
class Worst:
    """The entry of a window at which a tier fares worst, as far as the search has seen.

    Parameters
    ----------
    tier : str
    found : Found
        At that entry; ``found.ratios[tier]`` is the ratio.
    looks : tuple of Look
        Every entry, the searched ones with what the search has reached.
    """

    tier: str
    found: Found
    looks: tuple[Look, ...]

    @property
    def ratio(self) -> float:
        """``measured / bound``: above 1 the bound is false."""
        return self.found.ratios[self.tier]

    def largest(self, tier: str) -> Look:
        """Return the entry with the largest ratio for some tier."""
        return max(self.looks, key=lambda look: look.ratio(tier))


def worst(
    window: Window,
    parameters: Parameters,
    *,
    tier: str = "stated",
    refine: int = 4,
    starts: int = 4,
    seed: int = 0,
    growth: Growth | None = None,
    progress: Progress | None = None,
) -> Worst:
    """Search the largest ``sensitivity / bound`` over all entries and all quadratic costs.

    Every entry (free action, fixed action) is climbed for a few iterations, from uniform and from
    tilted couplings; the `refine` entries with the largest ratios are then searched in full.

    Parameters
    ----------
    window : Window
        A `LocalProblem` or a `GlobalProblem`.
    parameters : Parameters
        The constants of the class.
    tier : str
        Whose bound: a key of `promises`.
    refine : int
        At least 1.
    starts, seed, growth
        See `search`.
    progress : callable, optional
        Called as ``progress(done, total)`` after every entry, and every full search.

    Raises
    ------
    InputError
        If nothing is free, or there is no such tier.
    """
    if refine < 1:
        raise InputError(f"refine = {refine}: an integer >= 1 is needed", "refine")
    growth = growth or network_growth(window.problem.network)
    targets = _entries(window)
    total = len(targets) + min(refine, len(targets))
    known: dict[tuple[str, int, int | None], dict[str, float]] = {}
    looks = []
    for j, target in enumerate(targets):
        apart = separation(window, target)
        if apart not in known:
            known[apart] = promises(window, target, parameters, growth)
        looks.append(Look(target, _glance(window, target, parameters), known[apart]))
        if progress is not None:
            progress(j + 1, total)
    tiers = set().union(*(look.bounds for look in looks))
    if tier not in tiers:
        raise InputError(f"tier = {tier!r}: one of {', '.join(sorted(tiers))}", "tier")
    order = sorted(range(len(looks)), key=lambda j: -looks[j].ratio(tier))[:refine]
    searched = []
    for count, j in enumerate(order):
        target = looks[j].target
        seen = search(window, target, parameters, starts=starts, seed=seed, growth=growth)
        looks[j] = Look(target, max(seen.value, looks[j].value), looks[j].bounds)
        searched.append(seen)
        if progress is not None:
            progress(len(targets) + count + 1, total)
    best = max(searched, key=lambda seen: seen.ratios[tier])
    return Worst(tier, best, tuple(looks))


def _glance(window: Window, target: Target, parameters: Parameters) -> float:
    climb = Climb.of(window, target, parameters)
    starts = (climb.couplings.differences(), climb.couplings.differences(climb.response.columns))
    return max(climb.value(climb.climb(start, FEW)) for start in starts)


def _entries(window: Window) -> list[Target]:
    """Return every free action with every fixed action that a path joins to it."""
    free, fixed = (
        [(int(t), int(v)) for t, v in actions[:, 1:]]
        for actions in (window.terms.free, window.terms.fixed)
    )
    found = [Target(a, b) for a in free for b in fixed]
    joined = [t for t in found if separation(window, t)[2] is not None]
    if not joined:
        raise InputError("nothing fixed touches a free action: there is no sensitivity")
    return joined
