"""``thm:networked-exp-decay:e1``: the problem as a path of time slices."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..claim import Claim
from ..engines.exact import Counterexample
from ..engines.search import Search
from ._sampled import entries
from .networked_exp_decay import CLASS, LABEL, WEAK_TIME, WINDOW, gamma, smallest
from .slice_decay import weights

SOCO = "prop:exp-decay-networked-SOCO"
TOP = {"mu": Fraction(1), "l_T": Fraction(16, 49), "l_S": Fraction(0)}


def _e1() -> tuple[Fraction, Fraction]:
    a = TOP["l_T"]
    return smallest(TOP, "top"), 2 * a * gamma(2 * a)


def _e1_lateral() -> tuple[Fraction, Fraction]:
    return smallest(WEAK_TIME, "lateral"), 2 * WEAK_TIME["l_T"]


def _slice(specimen: Any, part: str, dt: Any, ds: Any) -> Any:
    from ...bounds.decay import slice_decay

    return slice_decay(specimen.parameters.a_T, dt)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        f"{LABEL}:e1",
        "time slices, a top variable",
        "|x_(t0,v0) - x'_(t0,v0)| <= (2 l_T/mu) (rho_T^0)^|t0-tau| |z - z'|, z at (tau, u).",
        CLASS,
        (
            Counterexample(
                _e1,
                TOP | {"k": 2, "r": 1, "moved": "(t+1, v)"},
                f"{WINDOW}, l_S = 0. Moving the top action by 1 moves (t, v) by (l_T/2)/(mu + "
                "l_T) = 8/65; promised is 2 * 16/49 * 1/8 = 4/49. The proposition it applies "
                "has the exponent |t0-tau| - 1",
            ),
        ),
        kind="step",
        uses=(SOCO,),
        repaired=f"{LABEL}:e1[r]: s_d in place of 2 a gamma_T^d.",
    ),
    Claim(
        f"{LABEL}:e1",
        "time slices, a lateral variable",
        "The same for z at a lateral position, |t0 - tau| = 0.",
        CLASS,
        (
            Counterexample(
                _e1_lateral,
                WEAK_TIME | {"k": 2, "r": 1, "moved": "(t, u)"},
                f"{WINDOW}. Moving (t, u) moves (t, v) by 128/273; promised is 2 l_T/mu = 1/72. "
                "A lateral variable lies in a slice that holds free actions too: the slices of "
                "the regrouped problem are neither free nor fixed",
            ),
        ),
        part="a",
        kind="step",
        uses=(SOCO,),
        repaired=f"{LABEL}[r]: the geometric mean of bounds on an entry of the inverse Hessian.",
    ),
    Claim(
        f"{LABEL}:e1",
        "how many slices there are",
        "tau in {t-1, t, ..., t+k} makes the k + 1 large variables of Section 3.2.",
        "k >= 1",
        (
            Counterexample(
                lambda: (Fraction(len(range(-1, 2 + 1))), Fraction(3)),
                {"t": 0, "k": 2},
                "for t = 0, k = 2: {-1, 0, 1, 2} has 4 elements; actions are there for tau = "
                "-1, 0, 1 only, tau < t + k as in the next sentence of the proof",
            ),
        ),
        part="b",
        kind="step",
        repaired=f"tau in {{t-1, ..., t+k-1}}: {LABEL}:e1[r].",
    ),
    Claim(
        f"{LABEL}:e1",
        "time slices, mended",
        "|x_(t0,v0) - x'_(t0,v0)| <= s_|t0-tau| |z - z'| for a top or bottom variable, s_d = "
        "a/(2 sqrt(1+a)) gamma_T^(d-1).",
        CLASS,
        (
            weights(),
            Search(
                entries(_slice, "top", "bottom"),
                "random local problems; equality for a single agent with one free step",
                quick=25,
                full=3000,
                nudge=0.5,
            ),
        ),
        part="r",
        kind="step",
        uses=("nearsight:slice-decay",),
    ),
)
