"""``thm:networked-exp-decay:e2``: the problem as a graph of columns."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..claim import Claim
from ..engines.exact import Counterexample
from ..engines.search import Search
from ._rational import exact, rational
from ._sampled import entries
from .networked_exp_decay import CLASS, LABEL, WEAK_SPACE, WINDOW, gamma, smallest

SOCO = "prop:exp-decay-networked-SOCO"
BESIDE = {"mu": Fraction(1), "l_T": Fraction(0), "l_S": Fraction(32, 49)}
SMALL = {"mu": Fraction(1), "l_T": Fraction(0), "l_S": Fraction(9, 32)}


def printed_rate(x: Fraction) -> Fraction:
    """Return ``rho_S^0 = 1 - 2/sqrt(1+2x)`` as the proof prints it, ``x = Delta l_S/mu``."""
    import sympy

    return exact(1 - 2 / sympy.sqrt(1 + 2 * rational(x)))


def _e2() -> tuple[Fraction, Fraction]:
    x = SMALL["l_S"]
    return smallest(SMALL, "lateral"), 2 * x * printed_rate(x)


def _e2_read() -> tuple[Fraction, Fraction]:
    x = BESIDE["l_S"]
    return smallest(BESIDE, "lateral"), 2 * x * gamma(x)


def _column(specimen: Any, part: str, dt: Any, ds: Any) -> Any:
    from ...bounds.decay import demko, gamma_S

    degree = max(specimen.shape.network.max_degree, 1)
    a_S, x = specimen.parameters.a_S, specimen.x
    return demko(1 + x) * degree**0.5 * a_S / 2 * gamma_S(x) ** (ds - 1)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        f"{LABEL}:e2",
        "columns, as printed",
        "|x_(t0,v0) - x'_(t0,v0)| <= (2 Delta l_S/mu) (rho_S^0)^d(u,v0) |z - z'|, rho_S^0 = "
        "1 - 2 (sqrt(1 + 2 Delta l_S/mu))^(-1).",
        CLASS,
        (
            Counterexample(
                _e2,
                SMALL | {"k": 2, "r": 1, "moved": "(t, u)"},
                f"{WINDOW}, l_T = 0. (t, v) moves by (9/64)/(73/64) = 9/73; promised is 9/16 times "
                "rho_S^0 = 1 - 2/(5/4) = -3/5, a negative number",
            ),
        ),
        kind="step",
        uses=(SOCO,),
        repaired=f"{LABEL}:e2[r].",
    ),
    Claim(
        f"{LABEL}:e2",
        "the printed rho_S^0 is a rate",
        "rho_S^0 = 1 - 2 (sqrt(1 + 2 Delta l_S/mu))^(-1) >= 0, so that its root can be taken.",
        "Delta l_S/mu >= 0",
        (
            Counterexample(
                lambda: (Fraction(0), printed_rate(Fraction(0))),
                {"Delta l_S/mu": Fraction(0)},
                "without spatial couplings rho_S^0 = 1 - 2 = -1; negative below Delta l_S/mu = "
                "3/2. A '+ 1' is missing",
            ),
        ),
        part="a",
        kind="step",
        repaired=f"{LABEL}[b]: rho_S^2 = g(Delta l_S/mu).",
    ),
    Claim(
        f"{LABEL}:e2",
        "columns, rate gamma_S, a bottom variable",
        "e2 with rho_S^0 read as gamma_S = g(Delta l_S/mu), for the action below or above v0.",
        CLASS,
        (
            Counterexample(
                lambda: (smallest(WEAK_SPACE, "bottom"), 2 * WEAK_SPACE["l_S"]),
                WEAK_SPACE | {"k": 2, "r": 1, "moved": "(t-1, v)"},
                f"{WINDOW}. The bottom action moves (t, v) by 64/273; promised is 2 l_S/mu = 1/36",
            ),
        ),
        part="b",
        kind="step",
        uses=(SOCO,),
        repaired=f"{LABEL}[r].",
    ),
    Claim(
        f"{LABEL}:e2",
        "columns, rate gamma_S, a lateral variable",
        "e2 with rho_S^0 read as gamma_S, for the lateral part of the boundary.",
        CLASS,
        (
            Counterexample(
                _e2_read,
                BESIDE | {"k": 2, "r": 1, "moved": "(t, u)"},
                f"{WINDOW}, l_T = 0. (t, v) moves by (16/49)/(65/49) = 16/65; promised is "
                "64/49 * 1/8 = 8/49: the exponent should be d - 1",
            ),
        ),
        part="c",
        kind="step",
        uses=(SOCO,),
        repaired=f"{LABEL}:e2[r].",
    ),
    Claim(
        f"{LABEL}:e2",
        "columns, mended",
        "For a lateral variable |x - x'| <= c(1+x) (sqrt(Delta) a_S/2) gamma_S^(d-1) |z - z'|.",
        CLASS,
        (
            Search(
                entries(_column, "lateral"),
                "random local problems",
                quick=25,
                full=3000,
                nudge=0.3,
            ),
        ),
        part="r",
        kind="step",
        uses=("thm:graph-induced-band-mat-inverse[a]", "prop:exp-decay-networked-SOCO[c]"),
    ),
)
