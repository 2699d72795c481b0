"""``prop:exp-decay-networked-SOCO``: the lines of its proof."""

from __future__ import annotations

from fractions import Fraction

import numpy as np

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.search import Search, Trial
from ._rational import solve
from ._sampled import pair_hessian
from .networked_exp_decay import gamma
from .networked_soco import HYPOTHESES, LABEL, random_graph


def _cross(rng: np.random.Generator) -> Trial:
    """A fixed vertex with Delta free neighbours, n entries each: the stacked cross block."""
    degree, n = int(rng.integers(1, 10)), int(rng.integers(1, 4))
    if rng.random() < 0.5:
        half = 0.5 * np.kron([[1, -1], [-1, 1]], np.eye(n))
        blocks = [half] * degree
    else:
        blocks = [pair_hessian(rng, n, 1.0) for _ in range(degree)]
    stacked = np.vstack([H[:n, n:] for H in blocks])
    return float(np.linalg.norm(stacked, 2)), degree**0.5 / 2, {"degree": degree, "n": n}


def _spectrum(rng: np.random.Generator) -> Trial:
    M, _, _, degree, strength = random_graph(rng)
    return float(np.linalg.eigvalsh(M)[-1]), 1 + degree * strength, {"degree": degree}


def between(m: int) -> tuple[Fraction, Fraction]:
    """Return the squares of ``d x_u0/d y_v`` and ``l |(M^-1)_(u0,N(v))|``, m helpers between.

    Costs x^2/2 and differences ``(1/4)(.)^2``, mu = l = 1: ``moved = sum_i (M^-1)_(u0,i)/2`` over
    m equal entries.
    """
    half = Fraction(1, 2)
    M = [[1 + 2 * half, -half], [-m * half, 1 + m * half]]  # a helper, and u0
    moved = solve(M, [half, Fraction(0)])[1]
    entry = 2 * moved / m
    return moved**2, m * entry**2


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "the stacked cross block has norm at most l",
        "|R^(v)_(N(v) \\ S)| <= l.",
        HYPOTHESES,
        (
            Counterexample(
                lambda: (5 * Fraction(1, 2) ** 2, Fraction(1)),
                {"Delta'": 5, "l": 1, "costs": "(1/4)(x_u - y_v)^2 on five edges"},
                "five blocks -1/2 above each other have norm sqrt(5)/2; squares 5/4 > 1. It holds "
                "for Delta' <= 4",
            ),
        ),
        part="b",
        kind="step",
        repaired=f"{LABEL}[c]: sqrt(Delta') l/2.",
    ),
    Claim(
        "equ:thm:SOCO-sensitivity:e1",
        "norms taken on both sides",
        "|d psi_u0/d theta| <= sum_v l |(M^-1)_(u0, N(v))| |eps_v|.",
        HYPOTHESES,
        (
            Counterexample(
                lambda: between(5),
                {"mu": 1, "l": 1, "Delta'": 5, "costs": "x^2/2, (1/4)(difference)^2"},
                "v in S and u0 have the same five neighbours: u0 moves by 5/23, the row of M^-1 "
                "has five entries 2/23, of norm 2 sqrt(5)/23; squares 25/529 > 20/529",
            ),
        ),
        kind="step",
        uses=(f"{LABEL}[b]",),
        repaired=f"with sqrt(Delta') l/2 for l: {LABEL}[c].",
    ),
    Claim(
        LABEL,
        "the stacked cross block has norm at most sqrt(Delta') l/2",
        "|R^(v)| <= sqrt(Delta') l/2; attained by differences (l/4)(x_u - y_v)^2.",
        "edge costs convex and l-smooth",
        (
            Decision(
                ("n", "S", "q", "l"),
                lambda n, S, q, l: (  # noqa: E741
                    [n >= 0, n * l * l >= 4 * S, 4 * q * q <= l * l],
                    4 * (S + q * q),
                    (n + 1) * l * l,
                ),
                "induction on the number n of blocks: a stack's squared norm is at most the sum S "
                "of the blocks' squared norms q^2, q <= l/2",
                false=(
                    lambda n, S, q, l: (  # noqa: E741
                        [n >= 0, n * l * l >= 4 * S, q * q <= l * l],
                        4 * (S + q * q),
                        (n + 1) * l * l,
                    ),
                ),
            ),
            Search(
                _cross,
                "random convex pair Hessians, and differences, at which it is attained",
                nudge=0.99,
            ),
        ),
        part="c",
        kind="step",
        uses=(f"{LABEL}[d]",),
    ),
    Claim(
        LABEL,
        "a convex l-smooth pair has a cross block of norm at most l/2",
        "0 <= [[p, q], [q, r]] <= l implies |q| <= l/2.",
        "numbers p, q, r (for matrices: x'Qy with unit vectors x, y)",
        (
            Decision(
                ("p", "q", "r", "l"),
                lambda p, q, r, l: (  # noqa: E741 - the paper's letter
                    [p >= 0, r >= 0, p * r >= q * q, l >= p, l >= r, (l - p) * (l - r) >= q * q],
                    4 * q * q,
                    l * l,
                ),
                "semidefinite: diagonal and determinant are >= 0; squares are compared",
                false=(
                    lambda p, q, r, l: (  # noqa: E741
                        [p >= 0, r >= 0, p * r >= q * q, l >= p, l >= r],
                        4 * q * q,
                        l * l,
                    ),
                ),
            ),
        ),
        part="d",
        kind="step",
    ),
    Claim(
        LABEL,
        "the rate of the proof is that of the statement",
        "lambda of the proof, 1 - 2/(sqrt(1 + 2 l/mu) + 1), is not below that of the statement, "
        "1 - 2/(sqrt(1 + Delta' l/mu) + 1).",
        "Delta' = 6",
        (
            Counterexample(
                lambda: (gamma(Fraction(24)), gamma(Fraction(8))),
                {"Delta'": 6, "l/mu": 4},
                "sqrt(25) and sqrt(9): 4/6 > 2/4. The proof has the 2 of a path; on a star with "
                "many leaves its rate is too small. (Its M_a is not block tri-diagonal either, "
                "but banded on the graph.)",
            ),
        ),
        part="e",
        kind="step",
        repaired=f"{LABEL}[f]: condition number at most 1 + Delta' l/mu.",
    ),
    Claim(
        LABEL,
        "the spectrum of the Hessian of the couplings",
        "mu I <= M_a <= (mu + Delta' l) I.",
        "edge costs convex and l-smooth",
        (
            Decision(
                ("degree", "Delta", "z", "l", "mu"),
                lambda degree, Delta, z, l, mu: (  # noqa: E741
                    [degree >= 0, degree <= Delta, z >= 0, l >= 0],
                    mu * z + degree * l * z,
                    (mu + Delta * l) * z,
                ),
                "the form of an edge lies between 0 and l (|x_u|^2 + |x_v|^2); summed over edges "
                "every |x_v|^2 = z occurs deg(v) times",
                false=(
                    lambda degree, Delta, z, l, mu: (  # noqa: E741
                        [degree >= 0, z >= 0, l >= 0],
                        mu * z + degree * l * z,
                        (mu + Delta * l) * z,
                    ),
                ),
            ),
            Search(_spectrum, "random graphs of up to 8 vertices", nudge=0.9),
        ),
        part="f",
        kind="step",
    ),
)
