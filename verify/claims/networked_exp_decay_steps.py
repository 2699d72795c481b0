"""``thm:networked-exp-decay``: the lines of its proof, and the text on its rates."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.search import Search
from ..engines.symbolic import Identity, Nonnegative
from ._rational import exact, rational
from ._sampled import entries
from .networked_exp_decay import CLASS, LABEL, WEAK_SPACE, WEAK_TIME, WINDOW, smallest

SOCO = "prop:exp-decay-networked-SOCO"
TOP = {"mu": Fraction(1), "l_T": Fraction(16, 49), "l_S": Fraction(0)}
BESIDE = {"mu": Fraction(1), "l_T": Fraction(0), "l_S": Fraction(32, 49)}
SMALL = {"mu": Fraction(1), "l_T": Fraction(0), "l_S": Fraction(9, 32)}


def _gamma(y: Fraction) -> Fraction:
    from ...bounds.decay import g

    return exact(g(rational(y)))


def printed_rate(x: Fraction) -> Fraction:
    """Return ``rho_S^0 = 1 - 2/sqrt(1+2x)`` as the proof prints it, ``x = Delta l_S/mu``."""
    import sympy

    return exact(1 - 2 / sympy.sqrt(1 + 2 * rational(x)))


def _e1() -> tuple[Fraction, Fraction]:
    a = TOP["l_T"]
    return smallest(TOP, "top"), 2 * a * _gamma(2 * a)


def _e1_lateral() -> tuple[Fraction, Fraction]:
    return smallest(WEAK_TIME, "lateral"), 2 * WEAK_TIME["l_T"]


def _e2() -> tuple[Fraction, Fraction]:
    x = SMALL["l_S"]
    return smallest(SMALL, "lateral"), 2 * x * printed_rate(x)


def _e2_read() -> tuple[Fraction, Fraction]:
    x = BESIDE["l_S"]
    return smallest(BESIDE, "lateral"), 2 * x * _gamma(x)


def _column(specimen: Any, part: str, dt: Any, ds: Any) -> Any:
    from ...bounds.decay import demko, gamma_S

    degree = max(specimen.shape.network.max_degree, 1)
    a_S, x = specimen.parameters.a_S, specimen.x
    return demko(1 + x) * degree**0.5 * a_S / 2 * gamma_S(x) ** (ds - 1)


def _slice(specimen: Any, part: str, dt: Any, ds: Any) -> Any:
    from ...bounds.decay import slice_decay

    return slice_decay(specimen.parameters.a_T, dt)


def _constant() -> tuple[Any, Any]:
    import sympy

    p, q, mu = sympy.symbols("p q mu", positive=True)
    return (2 * p**2 / mu) * (2 * q**2 / mu), (2 * p * q / mu) ** 2


def _below() -> tuple[Any, Any]:
    import sympy

    u = sympy.symbols("u", nonnegative=True)
    return u / (u + 2), ((1 + u) ** 2 - 1) / 4


def _above() -> tuple[Any, Any]:
    import sympy

    u = sympy.symbols("u", nonnegative=True)
    y = (1 + u) ** 2 - 1
    return (y / 4) / (1 + y / 2), u / (u + 2)


def _joint() -> tuple[Any, Any]:
    import sympy

    u, w = sympy.symbols("u w", nonnegative=True)
    return u / (u + 2), (u + w) / (u + w + 2)


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
        repaired="tau in {t-1, ..., t+k-1}.",
    ),
    Claim(
        f"{LABEL}:e1",
        "time slices, mended",
        "|x_(t0,v0) - x'_(t0,v0)| <= s_|t0-tau| |z - z'| for a top or bottom variable, s_d = "
        "a/(2 sqrt(1+a)) gamma_T^(d-1).",
        CLASS,
        (
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
                nudge=0.4,
            ),
        ),
        part="r",
        kind="step",
        uses=("thm:graph-induced-band-mat-inverse[a]", "prop:exp-decay-networked-SOCO[c]"),
    ),
    Claim(
        f"{LABEL}:e3",
        "a minimum is below the geometric mean",
        "min{p, q} <= sqrt(p q) for p, q >= 0.",
        "p, q >= 0",
        (
            Decision(
                ("p", "q", "m"),
                lambda p, q, m: ([p >= 0, q >= 0, m >= 0, m <= p, m <= q], m * m, p * q),
                "m = min{p, q} satisfies m <= p and m <= q; squares are compared",
                false=(lambda p, q, m: ([p >= 0, q >= 0, m >= 0, m <= p], m * m, p * q),),
            ),
        ),
        part="a",
        kind="step",
    ),
    Claim(
        f"{LABEL}:e3",
        "the product of the two constants",
        "sqrt(C_1^0 C_1^1) = C_1 with C_1^0 = 2 l_T/mu, C_1^1 = 2 Delta l_S/mu.",
        "l_T, l_S >= 0",
        (Identity(_constant, "l_T = p^2, Delta l_S = q^2, both sides squared"),),
        part="b",
        kind="step",
    ),
    Claim(
        f"{LABEL}:e3",
        "the third inequality",
        "(rho_S^0)^(d/2) <= rho_S^d with the rho_S of the theorem.",
        "Delta l_S/mu >= 3/2, where rho_S^0 >= 0",
        (
            Counterexample(
                lambda: (printed_rate(Fraction(24)), _gamma(Fraction(24))),
                {"Delta l_S/mu": Fraction(24), "d": 1},
                "squares at d = 1: rho_S^0 = 1 - 2/7 = 5/7, rho_S^2 = 1 - 2/6 = 2/3. The proof "
                "has 2 Delta l_S, and no + 1; the theorem has Delta l_S; they differ for "
                "all couplings but one",
            ),
        ),
        part="c",
        kind="step",
        repaired=f"{LABEL}[r]: gamma_S = rho_S^2 throughout.",
    ),
    Claim(
        f"{LABEL}:e3",
        "one top or lateral variable",
        "|x - x'| <= C_1 rho_T^|t0-tau| rho_S^d(v0,u) |z - z'|.",
        CLASS,
        (
            Counterexample(
                lambda: (smallest(WEAK_SPACE, "top"), Fraction(1, 9)),
                WEAK_SPACE | {"k": 2, "r": 1, "moved": "(t+1, v)"},
                f"{WINDOW}. The top action moves (t, v) by 64/273; promised is C_1 rho_T = "
                "2/9 * 1/2",
            ),
        ),
        kind="step",
        uses=tuple(f"{LABEL}:{k}" for k in ("e1", "e1[a]", "e2", "e2[b]", "e3[a]", "e3[b]", "e3[c]")),
        repaired=f"{LABEL}[r].",
    ),
    Claim(
        f"{LABEL}:e4",
        "one bottom variable",
        "|x - x'| <= C_2 rho_T^(t0-(t-1)) rho_S^d(v0,u) |y - y'|.",
        CLASS,
        (
            Counterexample(
                lambda: (smallest(WEAK_SPACE, "bottom"), Fraction(1, 9)),
                WEAK_SPACE | {"k": 2, "r": 1, "moved": "(t-1, v)"},
                f"{WINDOW}. 64/273 against C_2 rho_T = 2/9 * 1/2",
            ),
        ),
        kind="step",
        uses=(f"{LABEL}:e1", f"{LABEL}:e2[b]"),
        repaired=f"{LABEL}[r].",
    ),
    Claim(
        "sec:main:perturb#averaging",
        "the average of two bounds",
        "The (arithmetic) average of the two bounds is at most the product bound: "
        "(p + q)/2 <= sqrt(p q).",
        "p, q >= 0: the values of the two bounds",
        (
            Counterexample(
                lambda: (Fraction(1, 2) ** 2, Fraction(0)),
                {"p": 1, "q": 0},
                "p = 1, q = 0, squares: (1/2)^2 > 0",
            ),
        ),
        kind="remark",
        repaired=f"{LABEL}:e3[a]: the geometric average.",
    ),
    Claim(
        "sec:main:perturb#rates",
        "rho = Theta(sqrt(coupling)), from above",
        "g(y) <= y/4: rho_T <= sqrt(l_T/(2 mu)), rho_S <= sqrt(Delta l_S/mu)/2.",
        "y >= 0",
        (Nonnegative(_below, "y = (1+u)^2 - 1, u >= 0"),),
        part="a",
        kind="remark",
    ),
    Claim(
        "sec:main:perturb#rates",
        "rho = Theta(sqrt(coupling)), from below",
        "g(y) >= (y/4)/(1 + y/2): both rates go to 0 as the root of the coupling does.",
        "y >= 0",
        (Nonnegative(_above, "y = (1+u)^2 - 1, u >= 0"),),
        part="b",
        kind="remark",
    ),
    Claim(
        "sec:main:perturb#rates",
        "one rate for time and space is worse",
        "The rate g(2a + x) of the direct approach is at least g(2a) and g(x).",
        "a, x >= 0",
        (Nonnegative(_joint, "g is u/(u+2) with u = sqrt(1+y) - 1, which increases with y"),),
        part="c",
        kind="remark",
    ),
)
