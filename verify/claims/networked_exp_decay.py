"""``thm:networked-exp-decay``: the local perturbation bound with rates rho_T and rho_S."""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from ..claim import Claim
from ..engines.exact import Counterexample
from ..engines.search import Search
from ..engines.symbolic import Identity, Nonnegative
from ._rational import difference, exact, rational, response
from ._sampled import local

LABEL = "thm:networked-exp-decay"
META = f"{LABEL}:meta"
WEAK_SPACE = {"mu": Fraction(1), "l_T": Fraction(8, 9), "l_S": Fraction(1, 72)}
WEAK_TIME = {"mu": Fraction(1), "l_T": Fraction(1, 144), "l_S": Fraction(16, 9)}
CLASS = "Assumption 2.1: f mu-strongly convex, c and s convex, l_T- and l_S-smooth"
WINDOW = (
    "two agents v - u, k = 2, r = 1: the only free action is (t, v); node costs (mu/2) x^2, "
    "couplings (l_T/4)(difference)^2 in time and (l_S/4)(difference)^2 in space"
)


def smallest(constants: dict[str, Fraction], moved: str) -> Fraction:
    """Return the sensitivity of the only free action of `WINDOW` to one fixed action."""
    pairs = (
        difference("now", "bottom", constants["l_T"]),
        difference("now", "top", constants["l_T"]),
        difference("now", "lateral", constants["l_S"]),
    )
    return response(["now"], pairs, moved, constants["mu"])["now"]


def gamma(y: Fraction) -> Fraction:
    """Return ``g(y)`` at a point where it is rational."""
    from ...bounds.decay import g

    return exact(g(rational(y)))


def printed(constants: dict[str, Fraction]) -> Any:
    """Return the printed constants at Delta = 1, exactly."""
    from ...bounds.local_bound import local_stated

    l_T, l_S, mu = (rational(constants[name]) for name in ("l_T", "l_S", "mu"))
    return local_stated(l_T / mu, l_S / mu, 1)


def _bottom() -> tuple[Fraction, Fraction]:
    bound = printed(WEAK_SPACE)
    return smallest(WEAK_SPACE, "bottom"), exact(bound.C_2 * bound.rho_T)


def _lateral() -> tuple[Fraction, Fraction]:
    bound = printed(WEAK_TIME)
    return smallest(WEAK_TIME, "lateral"), exact(bound.C_1 * bound.rho_S)


def _rates() -> tuple[Any, Any]:
    import sympy

    from ...bounds.decay import g

    u = sympy.symbols("u", nonnegative=True)
    return sympy.simplify(g((1 + u) ** 2 - 1)), sympy.Integer(1)


def _scaled() -> tuple[Any, Any]:
    import sympy

    p, q, s, mu = sympy.symbols("p q s mu", positive=True)

    def constant(scale: Any) -> Any:
        return 2 * sympy.sqrt((scale * p**2) * (scale * q**2)) / (scale * mu)

    return constant(s), constant(sympy.Integer(1))


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "the local perturbation bound as printed",
        "The bound of Definition 3.1 holds with C_1 = C_2 = 2 sqrt(Delta l_S l_T)/mu, rho_T = "
        "sqrt(1 - 2/(sqrt(1 + 2 l_T/mu) + 1)), rho_S = sqrt(1 - 2/(sqrt(1 + Delta l_S/mu) + 1)).",
        CLASS,
        (
            Counterexample(
                _bottom,
                WEAK_SPACE | {"graph": "path of 2", "k": 2, "r": 1, "moved": "(t-1, v)"},
                f"{WINDOW}. Moving the bottom action (t-1, v) by 1 moves (t, v) by "
                "(l_T/2)/(mu + l_T + l_S/2) = 64/273; promised is C_2 rho_T = 2/9 * 1/2",
            ),
        ),
        uses=(f"{LABEL}:e3", f"{LABEL}:e4", "apx:adding-constraints"),
        repaired=f"{LABEL}[r]: C_1 and C_2 of the mended argument, the same rates.",
    ),
    Claim(
        LABEL,
        "the printed bound for lateral variables",
        "The same for the lateral part of the boundary alone, with C_1 = 2 sqrt(Delta l_S l_T)/mu.",
        CLASS,
        (
            Counterexample(
                _lateral,
                WEAK_TIME | {"graph": "path of 2", "k": 2, "r": 1, "moved": "(t, u)"},
                f"{WINDOW}. Moving the lateral action (t, u) by 1 moves (t, v) by "
                "(l_S/2)/(mu + l_T + l_S/2) = 128/273; promised is C_1 rho_S = 2/9 * 1/2: as l_T "
                "goes to 0, C_1 vanishes and the sensitivity does not",
            ),
        ),
        part="a",
        uses=(f"{LABEL}:e3",),
        repaired=f"{LABEL}[r].",
    ),
    Claim(
        LABEL,
        "both rates are below 1",
        "0 <= rho_T^2 = g(2 l_T/mu) < 1 and 0 <= rho_S^2 = g(Delta l_S/mu) < 1, "
        "g(y) = 1 - 2/(sqrt(1+y) + 1), for all couplings.",
        "l_T, l_S >= 0, mu > 0",
        (Nonnegative(_rates, "y = (1+u)^2 - 1, u >= 0: g = u/(u+2), and 1 - g = 2/(u+2) > 0"),),
        part="b",
        kind="remark",
    ),
    Claim(
        LABEL,
        "the constants do not depend on the unit of costs",
        "C_1 and the arguments of rho_T, rho_S are the same for (s mu, s l_T, s l_S), s > 0: they "
        "are functions of l_T/mu and Delta l_S/mu, as Definition 3.1 demands.",
        "s > 0",
        (Identity(_scaled, "l_T = p^2, Delta l_S = q^2"),),
        part="c",
        kind="remark",
    ),
    Claim(
        LABEL,
        "the local perturbation bound, mended",
        "The bound holds with the same rates, C_2 = c2 a/(2 rho_T) and C_1 = (c2/2) max(a/rho_T, "
        "sqrt(Delta) a_S/rho_S), c2 = sqrt(c(1+2a) c(1+x)), c(kappa) the constant of Demko, Moss "
        "and Smith.",
        "Assumption 2.1, no Slater point needed",
        (
            Search(
                local("repaired", "top", "bottom", "lateral"),
                "random local problems on 14 kinds of graphs, all styles of costs, couplings "
                "from none to strong",
                quick=30,
                full=4000,
                nudge=0.3,
            ),
        ),
        part="r",
        uses=("thm:graph-induced-band-mat-inverse[a]", "prop:exp-decay-networked-SOCO[c]"),
    ),
    Claim(
        META,
        "what the definition asks for exists",
        "There are C_1, C_2 < infinity that depend on l_T/mu and Delta l_S/mu, and rates below 1, "
        "with |x_(t0,v0) - x'_(t0,v0)| <= C_1 sum_boundary rho_T^|t0-tau| rho_S^d(v0,u) |z - z'| + "
        "C_2 sum_bottom rho_T^(t0-t+1) rho_S^d(v0,u) |y - y'|, for all couplings.",
        CLASS,
        (
            Search(
                local("repaired", "top", "bottom", "lateral"),
                "one boundary variable at a time, with the mended constants (C_1 and C_2 carry "
                "sqrt(Delta) l_S/mu <= Delta l_S/mu); sums by the triangle inequality",
                quick=20,
                full=1000,
                nudge=0.3,
                seed=1,
            ),
        ),
        kind="definition",
        uses=(f"{LABEL}[r]",),
    ),
    Claim(
        META,
        "the free actions, by the definition and by the notation table",
        'psi_(t,v)^(k,r) has as many entries by the table of notation ("decisions in '
        'N_(t,v)^(k,r)") as by its definition (indexed by N_(t,v)^(k-1,r-1)).',
        "k = 2, r = 1, an agent with two neighbours",
        (
            Counterexample(
                lambda: (Fraction(2 * 3), Fraction(1)),
                {"k": 2, "r": 1, "N_v^1": 3, "N_v^0": 1},
                "N^(2,1) has 2 steps of 3 agents, N^(1,0) one action. On the others psi would be "
                "the fixed z itself, at distance 0, which asks for C_1 >= 1",
            ),
        ),
        part="a",
        kind="definition",
        repaired=f"{META}: (t0, v0) runs over N_(t,v)^(k-1,r-1) = N \\ boundary of N.",
    ),
)
