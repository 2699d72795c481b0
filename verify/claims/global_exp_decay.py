"""``thm:global-exp-decay``: how a perturbed time slice decays."""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any

import numpy as np

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.search import Search, Trial
from ..engines.symbolic import Identity
from ._rational import Pair, difference, exact, rational, response, tilted
from ._sampled import pair_hessian

LABEL = "thm:global-exp-decay"
WEAK, NEAR = Fraction(16, 49), Fraction(259, 450)
CLASS = "Assumption 2.1"


def promised(a: Fraction, d: int) -> Fraction:
    """Return the printed ``2 a gamma_T^d``, exactly."""
    from ...bounds.decay import gamma_T

    return 2 * a * exact(gamma_T(rational(a))) ** d


def chain(pairs: list[Pair], d: int) -> Fraction:
    """Return ``dx_d/dx_0`` of a chain of free steps 1..d, node costs x^2/2."""
    return response(list(range(1, d + 1)), pairs, 0)[d]


def _until_end() -> tuple[Fraction, Fraction]:
    return chain([difference(1, 0, WEAK)], 1), promised(WEAK, 1)


def _two_point() -> tuple[Fraction, Fraction]:
    pairs = [difference(later, earlier, WEAK) for earlier, later in pairwise(range(5))]
    return chain(pairs, 3), promised(WEAK, 3)


def _near() -> tuple[Fraction, Fraction]:
    # tangent 4/5 of the best angle; (x, y) weights (p, q) within the unit circle
    pair = tilted(1, 0, NEAR, Fraction(624, 1000), Fraction(781, 1000))
    return chain([pair], 1), promised(NEAR, 1)


def slices(rng: np.random.Generator) -> tuple[float, float, int]:
    """Return ``|dx_d/dx_0|``, a and d of random slices of n numbers; a chain now and then."""
    d, n, a = int(rng.integers(1, 6)), int(rng.integers(1, 4)), float(10 ** rng.uniform(-2, 2))
    if rng.random() < 0.25:
        from ...perturbation.chains import best_tangents, chain_sensitivity

        return float(chain_sensitivity(a, best_tangents(a, d))), a, d
    W = np.eye((d + 2) * n)
    for i in range(d + 1):
        W[i * n : (i + 2) * n, i * n : (i + 2) * n] += pair_hessian(rng, n, a)
    for i in range(d + 2):  # whatever couples the entries of one slice
        B = rng.standard_normal((n, n)) * rng.choice([0.0, 1.0, 5.0])
        W[i * n : (i + 1) * n, i * n : (i + 1) * n] += B @ B.T
    free = slice(n, (d + 1) * n)  # x_0 fixed; slice d + 1 fixed too
    moved = np.linalg.solve(W[free, free], W[free, :n])[(d - 1) * n :]
    return float(np.linalg.norm(moved, 2)), a, d


def _trial(rng: np.random.Generator) -> Trial:
    from ...bounds.global_bound import global_repaired

    measured, a, d = slices(rng)
    bound = global_repaired(a)
    return measured, float(bound.C_G * bound.rho_G**d), {"a": a, "d": d}


def _rate() -> tuple[Any, Any]:
    import sympy

    from ...bounds.decay import gamma_T

    u = sympy.symbols("u", nonnegative=True)
    return sympy.simplify(gamma_T(((1 + u) ** 2 - 1) / 2)), 1 - 2 / (2 + u)


def repaired_constant() -> Decision:
    """Return ``s_d <= C_G gamma_T^d`` for the repaired C_G."""
    return Decision(
        ("a",),
        lambda a, w: ([a >= 0], 1 + 0 * a, w),
        "1/sqrt(1+a) <= 1 <= c(1+2a), w = sqrt(1+a)",
        roots={"w": lambda a: 1 + a},
        false=(lambda a, w: ([a >= 0], 1 + a, w),),
    )


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "the global bound until the end, as printed",
        "|psi_t(y)_t0 - psi_t(y')_t0| <= C_G rho_G^(t0-t+1) |y - y'|, C_G = 2 l_T/mu.",
        CLASS,
        (
            Counterexample(
                _until_end,
                {"mu": 1, "l_T": WEAK, "l_S": 0, "t": 1, "T": 1, "t0": 1},
                "one agent, one step, costs x^2/2 + (l_T/4)(x - y)^2: x moves by "
                "(8/49)/(57/49) = 8/57; promised is 2 * 16/49 * 1/8 = 4/49",
            ),
        ),
        uses=("apx:adding-constraints",),
        repaired=f"{LABEL}[r], sharper nearsight:slice-decay; [d] says where the "
        "printed one holds.",
    ),
    Claim(
        LABEL,
        "the global bound between two fixed slices, as printed",
        "|psi_t^p(y,z)_t0 - psi_t^p(y',z')_t0| <= C_G (rho_G^(t0-t+1) |y-y'| + "
        "rho_G^(t+p-1-t0) |z-z'|).",
        CLASS,
        (
            Counterexample(
                _two_point,
                {"mu": 1, "l_T": WEAK, "l_S": 0, "t": 1, "p": 4, "t0": 3},
                "one agent, free steps 1, 2, 3 between two fixed ones, costs x^2/2 and (l_T/4)"
                "(difference)^2: three linear equations",
            ),
        ),
        part="a",
        uses=("apx:adding-constraints",),
        repaired=f"{LABEL}[r].",
    ),
    Claim(
        LABEL,
        "the printed bound up to its threshold",
        "The same at l_T/mu = 259/450 = 0.5756.",
        CLASS,
        (
            Counterexample(
                _near,
                {"mu": 1, "l_T": NEAR, "p": Fraction(78, 125), "q": Fraction(781, 1000)},
                "one agent, one step, costs x^2/2 + (l_T/2)(p x - q y)^2 with p^2 + q^2 < 1, which "
                "is convex and l_T-smooth; sqrt(1 + 2 l_T) = 22/15",
            ),
        ),
        part="b",
        repaired=f"{LABEL}[r].",
    ),
    Claim(
        LABEL,
        "the last slice of equ:global-opt-problem",
        "The bound for every slice that the problem minimises over, x_t, .., x_(t+p-1) (the table "
        "of notation has x_t, .., x_(t+p-2)).",
        "l_T/mu = 1/4, t0 = t+p-1",
        (
            Counterexample(
                lambda: (Fraction(1), 2 * Fraction(1, 4)),
                {"l_T/mu": Fraction(1, 4), "t0": "t+p-1"},
                "the last slice is z itself and moves by |z - z'|; promised is C_G = 1/2 of it",
            ),
        ),
        part="c",
        kind="definition",
        repaired=f"{LABEL}[r]: t <= t0 <= t+p-2, as in the table.",
    ),
    Claim(
        LABEL,
        "where the printed constant is enough",
        "2 a >= a/(2 gamma_T sqrt(1+a)), the least true constant, for a >= 0.611.",
        "a >= 611/1000",
        (
            Decision(
                ("a",),
                lambda a, s, w: ([1000 * a >= 611], s + 1, 4 * (s - 1) * w),
                "s = sqrt(1+2a), w = sqrt(1+a), gamma_T = (s-1)/(s+1)",
                roots={"s": lambda a: 1 + 2 * a, "w": lambda a, s: 1 + a},
                false=(lambda a, s, w: ([1000 * a >= 610], s + 1, 4 * (s - 1) * w),),
            ),
        ),
        part="d",
        kind="remark",
        uses=("nearsight:slice-decay",),
    ),
    Claim(
        LABEL,
        "the printed constant fails below the threshold",
        "2 a < a/(2 gamma_T sqrt(1+a)) for 0 < a <= 0.6109: at every distance d some chain "
        "(nearsight:slice-decay[e]) violates the printed bound.",
        "0 < a <= 6109/10000",
        (
            Decision(
                ("a",),
                lambda a, s, w: ([a > 0, 10000 * a <= 6109], 4 * (s - 1) * w, s + 1),
                "s = sqrt(1+2a), w = sqrt(1+a)",
                roots={"s": lambda a: 1 + 2 * a, "w": lambda a, s: 1 + a},
                false=(lambda a, s, w: ([a > 0, 10000 * a <= 6110], 4 * (s - 1) * w, s + 1),),
                strict=True,
            ),
        ),
        part="e",
        kind="remark",
        uses=("nearsight:slice-decay[e]",),
    ),
    Claim(
        LABEL,
        "the repaired constant is implied by the sharp one",
        "a/(2 gamma_T sqrt(1+a)) <= c(1+2a) a/(2 gamma_T), as c >= 1.",
        "a >= 0",
        (repaired_constant(),),
        part="f",
        kind="step",
    ),
    Claim(
        LABEL,
        "rho_G is gamma_T",
        "1 - 2/(sqrt(1 + 2 l_T/mu) + 1) = g(2 l_T/mu).",
        "l_T/mu >= 0",
        (Identity(_rate, "2 l_T/mu = (1+u)^2 - 1"),),
        part="g",
        kind="remark",
    ),
    Claim(
        LABEL,
        "the global bound, mended",
        "Both bounds with C_G = c(1+2a) a/(2 gamma_T): exponents d - 1 and cross blocks l_T/2.",
        f"{CLASS}, any convex product constraints",
        (
            repaired_constant(),
            Search(_trial, "random slices of 1 to 3 numbers and the best chains", nudge=0.5),
        ),
        part="r",
        uses=(f"{LABEL}[f]", "nearsight:slice-decay"),
    ),
)
