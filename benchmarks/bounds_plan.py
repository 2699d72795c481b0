"""Speed of `bounds` against what a user would otherwise do, as ratios in one run.

    OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 uv run python benchmarks/bounds_plan.py

1. ``gamma_T(a)**k`` to the last bit: our formula against an mpmath loop at 50 digits, and the
   error of plain numpy, which is faster and wrong in the last places.
2. The Pareto frontier of a target: the search against the certificate on the whole grid of
   horizons and radii that encloses it, in numpy as well. Both must find the same pairs.
"""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from typing import Any

for name in ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS"):
    os.environ.setdefault(name, "1")

import mpmath
import numpy as np

from nearsight.bounds import Parameters, Setting
from nearsight.bounds.decay import slice_decay
from nearsight.bounds.frontier import frontier
from nearsight.bounds.sharp_promise import SharpPromise
from nearsight.graphs import parse_growth


def timed(function: Callable[[], Any], repeat: int = 3) -> tuple[float, Any]:
    """Return the least time of some runs, and the result."""
    best, result = float("inf"), None
    for _ in range(repeat):
        start = time.perf_counter()
        result = function()
        best = min(best, time.perf_counter() - start)
    return best, result


def formulas(size: int = 5000, d: int = 60) -> None:
    """Compare one closed form, evaluated on an array."""
    a = 10.0 ** np.random.default_rng(1).uniform(-3, 3, size)

    def by_mpmath() -> Any:
        with mpmath.workdps(50):
            one = [mpmath.mpf(v) for v in a]
            roots = [mpmath.sqrt(1 + 2 * v) for v in one]
            return [
                v / (2 * mpmath.sqrt(1 + v)) * ((s - 1) / (s + 1)) ** (d - 1)
                for v, s in zip(one, roots, strict=True)
            ]

    def by_numpy() -> Any:
        s = np.sqrt(1 + 2 * a)
        return a / (2 * np.sqrt(1 + a)) * ((s - 1) / (s + 1)) ** (d - 1)

    slow, exact = timed(by_mpmath, 1)
    ours, value = timed(lambda: slice_decay(a, d))
    plain, rough = timed(by_numpy)
    reference = np.array([float(v) for v in exact])
    good = reference > 1e-290
    ulps = [
        np.max(np.abs(v - reference)[good] / np.spacing(reference[good])) for v in (value, rough)
    ]
    print(
        f"s_{d}, {size} couplings: mpmath / ours {slow / ours:.1f}, numpy / ours {plain / ours:.3f}"
    )
    print(f"  largest error in ulp: ours {ulps[0]:.2f}, numpy {ulps[1]:.3g}")


def plans(a: float) -> None:
    """Compare the frontier search with a full grid."""
    s = Setting(Parameters(1.0, 1.0, a, a / 2), parse_growth("line"))
    promise = SharpPromise(s, "vi")
    ours, found = timed(lambda: frontier(promise, 0.01))
    pairs = [(p.k, p.r) for p in found.pairs]
    last_k, last_r = 4 * pairs[-1][0], pairs[0][1] + 1  # a user would have to guess these

    def by_grid() -> list[tuple[int, int]]:
        radii = np.arange(1, last_r)
        best, kept = last_r, []
        for k in range(2, last_k):
            hits = np.flatnonzero(promise.excess(k, radii) <= 0.01)
            if hits.size and radii[hits[0]] < best:
                best = int(radii[hits[0]])
                kept.append((k, best))
        return kept

    grid, kept = timed(by_grid, 1)
    same = "same pairs" if kept == pairs else "PAIRS DIFFER"
    print(
        f"frontier at a = x = {a:g}: grid of {last_k} x {last_r} / ours {grid / ours:.1f}, {same}"
    )


if __name__ == "__main__":
    formulas()
    for coupling in (1.0, 20.0, 200.0):
        plans(coupling)
