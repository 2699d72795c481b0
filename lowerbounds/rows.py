"""What a sandwich holds: rows by k and r, what they violate, and a file of them."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from dataclasses import dataclass, fields
from os import PathLike
from pathlib import Path

from ..graphs import InputError

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
