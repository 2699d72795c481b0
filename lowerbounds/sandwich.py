"""The sandwich: lower bound, worst cases of LPC and certificates, over a range of k and r."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import fields
from os import PathLike

import numpy as np

from ..bounds import Parameters, Setting, bounds_for
from ..graphs import InputError, Network, network_growth
from ..lpc.arrays import Floats, integer
from ..lpc.instances import instance
from ..lpc.store import Store
from .climb import search_couplings
from .floor import floor
from .resumed import identity
from .rows import TIERS, Row, Sandwich
from .styles import quadratic_style
from .worst_case import worst_case

Progress = Callable[[str], None]


def sandwich(
    network: Network,
    H: int,
    parameters: Parameters,
    ks: Iterable[int],
    rs: Iterable[int],
    *,
    style: str = "attraction",
    starts: int = 0,
    seed: int = 0,
    workers: int = 1,
    checkpoint: str | PathLike[str] | None = None,
    progress: Progress | None = None,
) -> Sandwich:
    """Return lower bounds, worst cases and certificates side by side.

    Parameters
    ----------
    network : Network
    H : int
        Steps of the worst cases.
    parameters : Parameters
        mu, l_f, l_T, l_S: one float each.
    ks, rs : iterable of int
        The horizons, at least 2, and the radii, at least 1.
    style : str
        Of the couplings of `Row.worst`, see `nearsight.lpc.instance`.
    starts : int
        Climbs of the search over couplings at every (k, r); 0 for no search.
    seed : int
        Of the search, and of styles that are random.
    workers : int
        Threads for the policies.
    checkpoint : path, optional
        A file that keeps finished rows: an interrupted run goes on after them, and a larger
        range of k and r begins with them.
    progress : callable, optional
        Called with a short text now and then.

    Raises
    ------
    InputError
        If an argument is out of range, or the checkpoint is of another table.
    """
    ks, rs = sorted(set(ks)), sorted(set(rs))
    for name, values, least in (("k", ks, 2), ("r", rs, 1)):
        if not values or values[0] < least:
            raise InputError(f"{name} = {values}: integers >= {least} are needed", name)
    integer(starts, "starts", 0)
    problem = instance(network, H, parameters, style=quadratic_style(style), seed=seed)
    setting = Setting(parameters, network_growth(network), unconstrained=True)
    pairs = [(k, r) for k in ks for r in rs]
    rows, unit = [], np.empty(len(fields(Row)) - 2)
    header = identity(problem, parameters, climbs=starts, seed=seed if starts else None)
    with Store(checkpoint, "table", header, unit.size) as store:
        for i, (k, r) in enumerate(pairs):
            if not store.load(k, unit, r):
                tell = _at(progress, f"row {i + 1}/{len(pairs)}, k = {k}, r = {r}: ")
                searched = None
                if starts:
                    searched = search_couplings(
                        network, H, parameters, k, r, starts=starts, seed=seed, progress=tell
                    ).cr_minus_one
                worst = worst_case(problem, k, r, workers=workers, progress=tell).cr_minus_one
                lower = floor(setting, network, k, r).cr_minus_one
                found = (lower, worst, searched, *certificates(setting, k, r))
                unit[:] = [np.nan if value is None else value for value in found]
                store.save(k, unit, r)
            rows.append(_row(k, r, unit))
    return Sandwich(tuple(rows))


def _at(progress: Progress | None, place: str) -> Progress | None:
    """Return a callable that says where we are before what is being done."""
    return None if progress is None else lambda text: progress(place + text)


def _row(k: int, r: int, values: Floats) -> Row:
    """Return the row of some numbers, NaN where there is none."""
    return Row(k, r, *(None if np.isnan(value) else float(value) for value in values))  # type: ignore[arg-type]


def certificates(setting: Setting, k: int, r: int) -> tuple[float | None, ...]:
    """Return the least certificate of ``CR - 1`` of each tier, None where none closes."""
    here = Setting(setting.parameters, setting.growth, k, r, setting.unconstrained)
    found: dict[str, list[float]] = {tier: [] for tier in TIERS}
    for label in ("coro:CR-LPC", "nearsight:sharp-cr"):
        for bound in bounds_for(label):
            value = bound.evaluate(here).values.get("cr_minus_one")
            if value is not None:
                found[bound.tier].append(float(value))
    return tuple(min(found[tier], default=None) for tier in TIERS)
