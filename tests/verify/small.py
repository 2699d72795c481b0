"""Small claims, true and false, one an engine."""

from fractions import Fraction as Q

from nearsight.verify import Claim
from nearsight.verify.engines.decision import Decision
from nearsight.verify.engines.exact import Counterexample
from nearsight.verify.engines.interval import Boxes
from nearsight.verify.engines.search import Search
from nearsight.verify.engines.symbolic import Nonnegative


def squares(a, s):
    return [a >= 0], (1 + s) ** 2, 2 * (1 + s * s)


def too_small(a, s):
    return [a >= 0], (1 + s) ** 2, 1 + s * s + a


def curve(y, z):
    return 1 + (y - z) ** 2 + (1 - y * z) / 2


def draws(rng):
    x = 1 - rng.random() ** 2
    return x, 1.0, {"x": x}


def binomial():
    from sympy import symbols

    a, b = symbols("a b", nonnegative=True)
    return 2 * a * b, (a + b) ** 2


DECISION = Decision(
    ("a",), squares, "s = sqrt(1+2a)", {"s": lambda a: 1 + 2 * a}, false=(too_small,)
)
BOXES = Boxes(curve, {"y": (0, 1), "z": (0, 1)}, "a = y/(1-y)", nudge=Q(3, 2))
SEARCH = Search(draws, "numbers below 1", quick=50, full=100)
ALGEBRA = Nonnegative(binomial, "as it stands")
FALSE = Counterexample(lambda: (Q(1, 2), Q(1, 3)), {"l_T": Q(1, 7), "x": [Q(1), Q(2, 3)]}, "halves")


def claims():
    """Return a chain: `top` uses `middle` uses `false`; two more stand alone."""
    return (
        Claim("lemma:base", "base", "$(1+s)^2 \\le 2(1+s^2)$", "$a \\ge 0$", (DECISION,)),
        Claim(
            "lemma:false", "a slip", "1/2 <= 1/3", "", (FALSE,), repaired="1/2 <= 1, `lemma:base`"
        ),
        Claim("lemma:middle", "step", "f > 0 & g < 1", "", (BOXES,), uses=("lemma:false",)),
        Claim("thm:top", "first part", "x <= 1", "", (SEARCH,), "a", uses=("lemma:middle",)),
        Claim("thm:top", "second part", "x_{t-1}^2 <= rho_T", "", (ALGEBRA,), "b"),
    )
