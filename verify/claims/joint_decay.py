"""``nearsight:joint-decay`` (J): entry by entry, without a square root of the rates."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.search import Search, Trial
from ..engines.symbolic import Identity
from ._sampled import local, seed_of

LABEL = "nearsight:joint-decay"


def _entries(rng: np.random.Generator) -> Trial:
    """All entries of one inverse Hessian at random tilts, or at the best ones."""
    from ...bounds.joint import best_tilt, entry_bound, slack
    from ...perturbation.lemmas._specimen import drawn

    seed = seed_of(rng)
    specimen = drawn(seed, k=5)
    h, p = specimen.hierarchy, specimen.parameters
    norms = h.norms(np.asarray(np.linalg.inv(h.M), dtype=np.float64)) * p.mu
    steps = np.arange(h.S)
    dt = np.abs(np.subtract.outer(steps, steps))[:, None, :, None] + 0 * norms
    ds = h.inner_distance[None, :, None, :] + 0 * norms
    near = np.isfinite(ds)
    dt, ds, norms = dt[near], ds[near].astype(int), norms[near]
    P, Q = best_tilt(p.a_T, specimen.x, dt, ds)
    if rng.random() < 0.3:  # any tilt with s > 0
        P, Q = (np.full(len(dt), z) for z in rng.uniform(0.05, 1, 2))
        if slack(p.a_T, specimen.x, P[0], Q[0]) <= 0:
            P, Q = np.ones_like(P), np.ones_like(Q)
    limit = np.asarray(entry_bound(p.a_T, specimen.x, dt, ds, P, Q))
    i = int(np.argmax(norms / np.maximum(limit, 1e-300)))
    about = {"seed": seed, "dt": int(dt[i]), "ds": int(ds[i]), "instance": specimen.text}
    return float(norms[i]), float(limit[i]), about


def _time() -> tuple[Any, Any]:
    import sympy

    s = sympy.symbols("s", positive=True)
    rate, a = (s - 1) / (s + 1), (s**2 - 1) / 2
    return ((rate + 1 / rate) / 2 - 1) * a, sympy.Integer(1)


def _space() -> tuple[Any, Any]:
    import sympy

    s = sympy.symbols("s", positive=True)
    rate, x = (s - 1) / (s + 1), s**2 - 1
    return ((rate + 1 / rate) / 2 - 1) * x / 2, sympy.Integer(1)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "joint decay of the inverse Hessian",
        "|(M^-1)_((t0,v0),(t1,u))| <= exp(-alpha |t0-t1| - beta d(v0,u))/(mu s) where s = 1 - "
        "(cosh(alpha)-1) a - (cosh(beta)-1) x/2 > 0.",
        "Assumption 2.1, M any Hessian of a local problem, alpha, beta >= 0, s > 0",
        (
            Decision(
                ("m", "v", "b"),
                lambda m, v, b: ([m > 0, v >= 0, b >= 0, m * v * v <= v * b], m * v, b),
                "the conjugated Hessian is at least m = mu s by [a] and [b], so W M W^-1 v = b "
                "gives m |v|^2 <= |v| |b| and |v| <= |b|/m; conjugating back gives the exponential",
                false=(
                    lambda m, v, b: ([m > 0, v >= 0, b >= 0, m * v * v <= 2 * v * b], m * v, b),
                ),
            ),
            Search(
                _entries,
                "all entries of random Hessians at the best tilt, or at random ones",
                quick=40,
                full=3000,
                nudge=0.6,
            ),
        ),
        uses=(f"{LABEL}[a]", f"{LABEL}[b]"),
    ),
    Claim(
        LABEL,
        "one conjugated edge",
        "The symmetric part [[P, cQ], [cQ', R]], c >= 1, of a conjugated edge is at least "
        "-(c-1)(l/2) I: P x^2 + R y^2 - 2 c |Q| x y >= -(c-1)(l/2)(x^2 + y^2).",
        "x, y >= 0, |Q| <= l/2, P x^2 + R y^2 >= 2 |Q| x y",
        (
            Decision(
                ("x", "y", "q", "l", "c", "w"),
                lambda x, y, q, l, c, w: (  # noqa: E741 - the paper's letter
                    [x >= 0, y >= 0, q >= 0, l >= 2 * q, c >= 1, w >= 2 * q * x * y],
                    4 * c * q * x * y,
                    2 * w + (c - 1) * l * (x * x + y * y),
                ),
                "w = x'Px + y'Ry, q = |Q|, times 2",
                false=(
                    lambda x, y, q, l, c, w: (  # noqa: E741
                        [x >= 0, y >= 0, q >= 0, l >= q, c >= 1, w >= 2 * q * x * y],
                        4 * c * q * x * y,
                        2 * w + (c - 1) * l * (x * x + y * y),
                    ),
                ),
            ),
        ),
        part="a",
        kind="step",
        uses=("prop:exp-decay-networked-SOCO[d]",),
    ),
    Claim(
        LABEL,
        "two temporal and Delta spatial edges",
        "The sum of the losses at one vertex is at most (cosh(alpha)-1) a + (cosh(beta)-1) x/2 "
        "of mu: n_T (l_T/2) <= l_T for n_T <= 2, n_S (l_S/2) <= Delta l_S/2.",
        "n_T <= 2, n_S <= Delta, p = cosh(alpha)-1 and q = cosh(beta)-1 >= 0",
        (
            Decision(
                ("p", "q", "a", "b", "n_T", "n_S", "D"),
                lambda p, q, a, b, n, m, D: (
                    [p >= 0, q >= 0, a >= 0, b >= 0, n >= 0, n <= 2, m >= 0, m <= D],
                    n * p * a + m * q * b,
                    2 * p * a + D * q * b,
                ),
                "times 2/mu, b = l_S/mu",
                false=(
                    lambda p, q, a, b, n, m, D: (
                        [p >= 0, q >= 0, a >= 0, b >= 0, n >= 0, n <= 3, m >= 0, m <= D],
                        n * p * a + m * q * b,
                        2 * p * a + D * q * b,
                    ),
                ),
            ),
        ),
        part="b",
        kind="step",
    ),
    Claim(
        LABEL,
        "the rate in time",
        "At beta = 0 the slack s vanishes at exp(-alpha) = gamma_T: (cosh(alpha) - 1) a = 1.",
        "a > 0",
        (Identity(_time, "s = sqrt(1+2a)"),),
        part="c",
        kind="remark",
    ),
    Claim(
        LABEL,
        "the rate in space",
        "At alpha = 0 the slack vanishes at exp(-beta) = gamma_S: (cosh(beta) - 1) x/2 = 1.",
        "x > 0",
        (Identity(_space, "s = sqrt(1+x)"),),
        part="d",
        kind="remark",
    ),
    Claim(
        LABEL,
        "one boundary variable",
        "Top or bottom: a/2 times the entry one step nearer, or s_dt; lateral: sqrt(Delta) a_S/2 "
        "times the entry one hop nearer; the entry by (J) at the best tilt or on an axis.",
        "Assumption 2.1, any product of convex sets",
        (
            Search(
                local("sharp", "top", "bottom", "lateral"),
                "random local problems on 14 kinds of graphs, all styles of costs",
                quick=25,
                full=4000,
                nudge=0.5,
            ),
        ),
        part="e",
        uses=(
            LABEL,
            "nearsight:slice-decay",
            "prop:exp-decay-networked-SOCO[c]",
            "thm:graph-induced-band-mat-inverse[a]",
        ),
    ),
)
