"""Rates of decay fitted to measured profiles, with confidence intervals."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..lpc.arrays import Floats

SAMPLES = 400  # bootstrap samples
LEVEL = 0.95  # of the confidence intervals
FLOOR = 1e-250  # below it a double loses digits


@dataclass(frozen=True)
class Fit:
    """``measured_max ~ C_part rho_T^dt rho_S^ds``, C different for each boundary part.

    The logarithms of the largest values of every cell are fitted by least squares, all cells
    alike. The intervals are percentile bootstrap intervals over *instances*: whole instances are
    drawn with replacement, the largest values taken anew, and the fit repeated; the cells of one
    instance are far from independent, and drawing instances keeps them together. An interval says
    how much the rates would change with other instances of the same kind; it says nothing of
    instances of another kind.

    Sensitivities are computed with small relative error however small they are, so nothing is cut
    off but what a double cannot hold, and zeros.

    Parameters
    ----------
    rho_T, rho_S : float or None
        None where the cells do not determine the rate (one distance only).
    ci : dict
        ``"rho_T"`` and ``"rho_S"``: pairs of numbers, or None.
    cells : int
        How many cells were fitted.
    reason : str or None
        Why a rate is missing.

    References
    ----------
    Efron and Tibshirani (1993), An Introduction to the Bootstrap, Sections 9.5 and 13.3.
    """

    rho_T: float | None
    rho_S: float | None
    ci: dict[str, tuple[float, float] | None]
    cells: int
    reason: str | None = None


def fit(cells: Floats, seed: int = 0) -> Fit:
    """Fit the rates.

    Parameters
    ----------
    cells : ndarray, shape (instances, 3, k + 1, reach + 1)
        Largest sensitivities of every instance; NaN where there is none.
    seed : int
        Of the bootstrap.
    """
    rng = np.random.default_rng(seed)
    filled = np.where(np.isnan(cells), -np.inf, cells).reshape(len(cells), -1)
    shape = cells.shape[1:]
    rates, count, known = _rates(filled.max(axis=0), shape)
    drawn = np.array(
        [
            _rates(filled[rng.integers(len(cells), size=len(cells))].max(axis=0), shape)[0]
            for _ in range(SAMPLES if len(cells) > 1 else 0)
        ]
    ).reshape(-1, 2)
    ends = [50 * (1 - LEVEL), 50 * (1 + LEVEL)]
    names, ci = ("rho_T", "rho_S"), {}
    for j, name in enumerate(names):
        values = drawn[~np.isnan(drawn[:, j]), j]
        low, high = np.percentile(values, ends) if len(values) else (np.nan, np.nan)
        ci[name] = (float(low), float(high)) if known[j] and len(values) else None
    found = [float(rates[j]) if known[j] else None for j in range(2)]
    missing = [name for name, rate in zip(names, found, strict=True) if rate is None]
    reason = f"too few distances to fit {' and '.join(missing)}" if missing else None
    return Fit(found[0], found[1], ci, count, reason)


def _rates(largest: Floats, shape: tuple[int, ...]) -> tuple[Floats, int, list[bool]]:
    """Return the two rates, how many cells they come from, and which are determined."""
    usable = np.flatnonzero(largest > FLOOR)
    part, dt, ds = np.unravel_index(usable, shape)
    columns = [(part == p).astype(float) for p in range(shape[0]) if (part == p).any()]
    design = np.stack([dt, ds, *columns], axis=1).astype(float)
    if not len(usable):
        return np.full(2, np.nan), 0, [False, False]
    solution = np.linalg.lstsq(design, np.log(largest[usable]), rcond=None)[0]
    rank = np.linalg.matrix_rank(design)
    known = [bool(np.linalg.matrix_rank(np.delete(design, j, axis=1)) < rank) for j in range(2)]
    rates = np.where(known, np.exp(np.minimum(solution[:2], 700.0)), np.nan)
    return rates, len(usable), known
