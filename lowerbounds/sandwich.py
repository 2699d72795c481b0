"""The sandwich: lower bound, worst cases of LPC and certificates, over a range of k and r."""

from __future__ import annotations

import csv
from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass, fields
from os import PathLike
from pathlib import Path

from ..bounds import Parameters, Setting, bounds_for
from ..graphs import InputError, Network, network_growth
from ..lpc.arrays import integer
from ..lpc.instances import instance
from .climb import search_couplings
from .floor import floor
from .styles import quadratic_style
from .worst_case import worst_case

Progress = Callable[[str], None]
TIERS = ("stated", "repaired", "sharp")
ROUNDING = 1e-9  # relative: what the numbers compared may be off


@dataclass(frozen=True)
class Row:
    """All that is known of ``CR - 1`` at one k and r; None where there is no number.

    Parameters
    ----------
    k, r : int
        Prediction horizon and communication radius.
    lower : float
        No decentralised online algorithm is below, over all costs with the constants on this
        network.
    worst : float
        The exact worst case of LPC over all data, with uniform couplings and H steps.
    searched : float or None
        The worst case at the worst couplings that a search found.
    stated, repaired, sharp : float or None
        The certificate of each tier, over all costs and all H; `stated` is the printed formula,
        which is no guarantee.
    """

    k: int
    r: int
    lower: float
    worst: float
    searched: float | None
    stated: float | None
    repaired: float | None
    sharp: float | None

    @property
    def least(self) -> float | None:
        """The least certificate that is a guarantee."""
        return min((c for c in (self.repaired, self.sharp) if c is not None), default=None)


@dataclass(frozen=True)
class Violation:
    """A certificate below something that it promises to be above: a finding.

    Parameters
    ----------
    k, r : int
        Where.
    tier : str
        Whose certificate.
    below : str
        ``"lower"``, ``"worst"`` or ``"searched"``.
    certificate, value : float
        The two numbers; the second is larger.
    """

    k: int
    r: int
    tier: str
    below: str
    certificate: float
    value: float


@dataclass(frozen=True)
class Sandwich:
    """Rows by k, then r, of one network and its constants.

    *Theorems* are ``lower <= certificate``, ``worst <= certificate`` and ``searched <=
    certificate``. The lower bound is one over all costs: a single network with uniform couplings
    may well be below it.
    """

    rows: tuple[Row, ...]

    @property
    def violations(self) -> tuple[Violation, ...]:
        """All certificates that are exceeded; those of the tier ``stated`` may be."""
        return tuple(v for row in self.rows for v in _violations(row))


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
    progress : callable, optional
        Called with a short text now and then.
    """
    ks, rs = sorted(set(ks)), sorted(set(rs))
    for name, values, least in (("k", ks, 2), ("r", rs, 1)):
        if not values or values[0] < least:
            raise InputError(f"{name} = {values}: integers >= {least} are needed", name)
    integer(starts, "starts", 0)
    problem = instance(network, H, parameters, style=quadratic_style(style), seed=seed)
    setting = Setting(parameters, network_growth(network), unconstrained=True)
    rows = []
    for k in ks:
        for r in rs:
            if progress is not None:
                progress(f"k = {k}, r = {r}")
            searched = None
            if starts:
                found = search_couplings(network, H, parameters, k, r, starts=starts, seed=seed)
                searched = found.cr_minus_one
            worst = worst_case(problem, k, r, workers=workers).cr_minus_one
            lower = floor(setting, network, k, r).cr_minus_one
            rows.append(Row(k, r, lower, worst, searched, *certificates(setting, k, r)))
    return Sandwich(tuple(rows))


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


def write_csv(found: Sandwich, path: str | PathLike[str]) -> None:
    """Write the rows to a file: one line each, columns as in `Row`, empty where there is None.

    Raises
    ------
    InputError
        If the file cannot be written.
    """
    names = [field.name for field in fields(Row)]
    try:
        with Path(path).open("w", newline="", encoding="utf-8") as stream:
            writer = csv.writer(stream)
            writer.writerow(names)
            writer.writerows([getattr(row, name) for name in names] for row in found.rows)
    except OSError as error:
        raise InputError(f"{path}: cannot be written: {error.strerror}") from error


def _violations(row: Row) -> Iterator[Violation]:
    for tier in TIERS:
        certificate = getattr(row, tier)
        for name in ("lower", "worst", "searched"):
            value = getattr(row, name)
            if None not in (certificate, value) and value > certificate * (1 + ROUNDING):
                yield Violation(row.k, row.r, tier, name, certificate, value)
