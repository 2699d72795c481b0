"""``le:foc``, ``le: H-inverse``, ``eq:19``: derivatives of solutions, and the power series."""

from __future__ import annotations

from fractions import Fraction

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.exact import Counterexample
from ..engines.search import Search
from ._rational import difference
from ._sampled import lemma

FOC, SERIES = "le:foc", "le: H-inverse"
OUTLINE = "sec:outline-network-perturbation-bound#special-case"


def _two_names() -> tuple[Fraction, Fraction]:
    first = -difference("now", "before", Fraction(1)).xy
    last = -difference("now", "after", Fraction(0)).xy
    return first - last, Fraction(0)


def share() -> Decision:
    """Return the inequality of one temporal cost and half of its ends' node costs."""
    return Decision(
        ("x", "y", "q", "l", "w"),
        lambda x, y, q, l, w: (  # noqa: E741 - the paper's letter
            [x >= 0, y >= 0, q >= 0, l >= 2 * q, w >= 2 * q * x * y],
            (1 + l) * 4 * q * x * y,
            l * (2 * w + x * x + y * y),
        ),
        "w = x'Px + y'Ry, times 2 (1 + l); an action is in at most two temporal costs, so the sum "
        "over them is |u'Au| <= (a/(1+a)) u'Du, and A D^-1 has the eigenvalues of the symmetric "
        "D^-1/2 A D^-1/2",
        false=(
            lambda x, y, q, l, w: (  # noqa: E741
                [x >= 0, y >= 0, q >= 0, l >= q, w >= 2 * q * x * y],
                (1 + l) * 4 * q * x * y,
                l * (2 * w + x * x + y * y),
            ),
        ),
    )


def below_one(factor: int) -> Decision:
    """Return ``a/(1+a) <= factor a``."""
    return Decision(
        ("a",),
        lambda a: ([a >= 0], a, factor * a * (1 + a)),
        f"the radius a/(1+a) of [b] is at most {factor} a; times 1 + a",
        false=(lambda a: ([a >= 0], 4 * a, factor * a * (1 + a)),),
    )


CLAIMS: tuple[Claim, ...] = (
    Claim(
        FOC,
        "the derivative of a solution in its boundary",
        "d psi(zeta + theta e)/d theta = M^-1 (R^(1) e_0 + R^(k-1) e_k + sum_tau K^(tau) e_tau).",
        "Assumption 2.1, no constraints",
        (
            Search(
                lemma(FOC, "derivative"),
                "small random local problems of all styles; central differences of minimisers "
                "with 40 digits against the Hessians in floats, compared to a relative 1e-9",
                quick=15,
                full=500,
                nudge=1e-8,
            ),
        ),
        kind="lemma",
    ),
    Claim(
        FOC,
        "one name, one matrix",
        "R^(i), i in {1, k-1}, is well defined by its superscript.",
        "k = 2",
        (
            Counterexample(
                _two_names,
                {"k": 2, "l_T": 1, "c_t": "(x_t - x_(t-1))^2/4", "c_(t+1)": 0},
                "for k = 2 both matrices are called R^(1); the one of step t-1 is 1/2, that of "
                "step t+1 is 0",
            ),
        ),
        part="a",
        kind="definition",
        repaired=f"{FOC}: two matrices, named after their boundary steps 0 and k.",
    ),
    Claim(
        SERIES,
        "the power series of P^-1 converges",
        "P^-1 = sum_l (I - P)^l, P = I + A D^-1, if mu > 2 l_T.",
        "Assumption 2.1, mu > 2 l_T",
        (
            below_one(2),
            Search(
                lemma(SERIES, "remainder, stated"),
                "random local problems: the remainder after L = 1..13 terms is at most "
                "(2a)^L/(1-2a)",
                quick=40,
                full=3000,
                nudge=0.3,
            ),
        ),
        kind="lemma",
        uses=(f"{SERIES}[a]",),
    ),
    Claim(
        SERIES,
        "the block discs",
        "All eigenvalues of P lie in the disc of radius 2 l_T/mu around 1.",
        "Assumption 2.1",
        (
            below_one(2),
            Search(
                lemma(SERIES, "radius, stated"),
                "random local problems with mu > 2 l_T",
                quick=40,
                full=3000,
                nudge=0.2,
            ),
        ),
        part="a",
        kind="step",
        uses=(f"{SERIES}[b]",),
    ),
    Claim(
        SERIES,
        "the condition is not needed",
        "The spectral radius of A D^-1 is at most a/(1+a) < 1 for all couplings.",
        "Assumption 2.1",
        (
            share(),
            Search(
                lemma(SERIES, "radius, sharp", "remainder, sharp"),
                "random local problems with weak and strong couplings; approached by uniform "
                "differences of a long chain",
                quick=40,
                full=3000,
                nudge=0.8,
            ),
        ),
        part="b",
        kind="lemma",
        uses=(f"{SERIES}[c]", "prop:exp-decay-networked-SOCO[d]"),
    ),
    Claim(
        SERIES,
        "the share of one temporal cost",
        "2 q x y <= (l/(1+l)) (P x^2 + R y^2 + (x^2 + y^2)/2): with shares of half the node costs, "
        "|u'Au| <= (a/(1+a)) u'Du.",
        "mu = 1, x, y >= 0, q = |Q| <= l/2, P x^2 + R y^2 >= 2 q x y (semidefinite)",
        (share(),),
        part="c",
        kind="step",
    ),
    Claim(
        "eq:19",
        "the inverse Hessian by the series",
        "M^-1 = D^-1 sum_l (-J)^l, J = A D^-1.",
        "mu > 2 l_T (not even needed: le: H-inverse[b])",
        (
            Search(
                lemma(SERIES, "remainder, sharp"),
                "random local problems: |M^-1 - D^-1 sum_(l<L) (-J)^l| <= (a/(1+a))^L/mu",
                quick=40,
                full=3000,
                nudge=0.6,
            ),
        ),
        kind="step",
        uses=(SERIES,),
    ),
    Claim(
        OUTLINE,
        "the special case of the outline",
        "Each block A_(i,j) = l_T I can occur: then (J^l)_(i,j) = l_T^l Q^-l b(l, i, j).",
        "Assumption 2.1, l_T = 1",
        (
            Counterexample(
                lambda: (Fraction(2), Fraction(0)),
                {"l_T": 1, "cross block": 1},
                "with Hessian [[p, 1], [1, r]] between 0 and 1, the vector (1, -1) asks for "
                "p + r >= 2, (1, 1) for p + r + 2 <= 2, that is p + r <= 0: 2 > 0. (Also the "
                "sign: a positive cross block repels.)",
            ),
        ),
        kind="remark",
        repaired="prop:exp-decay-networked-SOCO[d]: blocks of norm at most l_T/2, so A_(i,j) = "
        "-(l_T/2) I for uniform differences.",
    ),
)
