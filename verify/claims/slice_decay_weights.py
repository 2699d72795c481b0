"""``nearsight:slice-decay``: when there are weights."""

from __future__ import annotations

from typing import Any

from ..claim import Claim
from ..engines.decision import Decision
from ..engines.symbolic import Identity
from .slice_decay import LABEL


def _quotient() -> tuple[Any, Any]:
    import sympy

    s = sympy.symbols("s", positive=True)
    gamma, a = (s - 1) / (s + 1), (s**2 - 1) / 2
    return gamma + 1 / gamma, 2 * (1 + 1 / a)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "at the source",
        "nu - 1 >= a (nu - lam)^2/(4 lam) has a solution nu > 0 if lam >= a/(1+a): "
        "nu = lam (1 + 2/a).",
        "a, lam > 0, lam >= a/(1+a)",
        (
            Decision(
                ("a", "lam"),
                lambda a, lam: (
                    [a > 0, lam > 0, lam * (1 + a) >= a],
                    lam,
                    lam * (a + 2) - a,
                ),
                "nu = lam (a+2)/a, so that a (nu - lam)^2/(4 lam) = lam/a; both sides times a",
                false=(
                    lambda a, lam: (
                        [a > 0, lam > 0, 2 * lam * (1 + a) >= a],
                        lam,
                        lam * (a + 2) - a,
                    ),
                ),
            ),
        ),
        part="b",
        kind="step",
    ),
    Claim(
        LABEL,
        "at the source, conversely",
        "If nu - 1 >= a (nu - lam)^2/(4 lam) for some nu > 0 then lam >= a/(1+a).",
        "a, lam, nu > 0",
        (
            Decision(
                ("a", "lam", "nu"),
                lambda a, lam, nu: (
                    [a > 0, lam > 0, nu > 0, 4 * lam * (nu - 1) >= a * (nu - lam) * (nu - lam)],
                    a,
                    lam * (1 + a),
                ),
                "times 4 lam",
                false=(
                    lambda a, lam, nu: (
                        [a > 0, lam > 0, nu > 0, 4 * lam * (nu - 1) >= a * (nu - lam) * (nu - lam)],
                        2 * a,
                        lam * (1 + a),
                    ),
                ),
            ),
        ),
        part="c",
        kind="step",
    ),
    Claim(
        LABEL,
        "between edges lam and q lam",
        "nu >= (a/4)((nu - lam)^2/lam + (nu - q lam)^2/(q lam)) has a solution if and only if "
        "sqrt(q) + 1/sqrt(q) <= 2 (1 + 1/a); this is the half 'only if'.",
        "lam = 1 (homogeneous), q = z^2, a, z > 0",
        (
            Decision(
                ("a", "z", "nu"),
                lambda a, z, nu: (
                    [
                        a > 0,
                        z > 0,
                        4 * nu * z * z
                        >= a * (z * z * (nu - 1) * (nu - 1) + (nu - z * z) * (nu - z * z)),
                    ],
                    a * (z * z + 1),
                    2 * z * (a + 1),
                ),
                "lam = 1, q = z^2, times 4 q",
                false=(
                    lambda a, z, nu: (
                        [
                            a > 0,
                            z > 0,
                            4 * nu * z * z
                            >= a * (z * z * (nu - 1) * (nu - 1) + (nu - z * z) * (nu - z * z)),
                        ],
                        a * (z * z + 1),
                        2 * z * a,
                    ),
                ),
            ),
        ),
        part="d",
        kind="step",
    ),
    Claim(
        LABEL,
        "between edges, a solution",
        "The other half: nu = 2 (1 + 1/a) q/(1+q) lam is a solution if sqrt(q) + 1/sqrt(q) <= "
        "2 (1 + 1/a).",
        "lam = 1, q = z^2, a, z > 0",
        (
            Decision(
                ("a", "z"),
                lambda a, z: (
                    [a > 0, z > 0, a * (z * z + 1) <= 2 * z * (a + 1)],
                    a * a * (1 + z * z) * (1 + z * z),
                    4 * (a + 1) * (a + 1) * z * z,
                ),
                "put in, the condition reads (1+q)^2/q <= 4 (1 + 1/a)^2: the discriminant",
                false=(
                    lambda a, z: (
                        [a > 0, z > 0, a * (z * z + 1) <= 2 * z * (a + 2)],
                        a * a * (1 + z * z) * (1 + z * z),
                        4 * (a + 1) * (a + 1) * z * z,
                    ),
                ),
            ),
        ),
        part="g",
        kind="step",
    ),
    Claim(
        LABEL,
        "the best quotient is gamma_T^2",
        "gamma_T + 1/gamma_T = 2 (1 + 1/a): equality in [d] at q = gamma_T^2.",
        "a > 0",
        (Identity(_quotient, "s = sqrt(1+2a), gamma_T = (s-1)/(s+1)"),),
        part="h",
        kind="step",
    ),
)
