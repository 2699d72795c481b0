"""``lemma:smooth-difference``: a smooth nonnegative function at two points."""

from __future__ import annotations

from ..claim import Claim
from ..engines.decision import Decision

CLAIMS: tuple[Claim, ...] = (
    Claim(
        "lemma:smooth-difference",
        "a smooth nonnegative function at two points",
        "h(x) <= (1 + eta) h(y) + (l/2)(1 + 1/eta) |x - y|^2 for eta > 0",
        "h >= 0 on all of R^m, l-smooth",
        (
            Decision(
                ("l", "eta", "h", "g", "d"),
                lambda l, eta, h, g, d: (  # noqa: E741 - the paper's letter
                    [l > 0, eta > 0, d >= 0, g >= 0, 2 * l * h - g * g >= 0],
                    eta * (2 * h + 2 * g * d + l * d * d),
                    2 * eta * (1 + eta) * h + l * (1 + eta) * d * d,
                ),
                "h(x) <= h(y) + g d + l d^2/2 with g = |grad h(y)|, d = |x - y|, and g^2 <= "
                "2 l h(y) "
                "because h(y - grad h(y)/l) >= 0; multiplied by 2 eta",
                false=(
                    lambda l, eta, h, g, d: (  # noqa: E741
                        [l > 0, eta > 0, d >= 0, g >= 0, h >= 0],
                        eta * (2 * h + 2 * g * d + l * d * d),
                        2 * eta * (1 + eta) * h + l * (1 + eta) * d * d,
                    ),
                ),
            ),
        ),
        kind="lemma",
    ),
)
