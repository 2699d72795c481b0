"""``nearsight:slice-decay`` (E1): the sharp sensitivity of a time slice."""

from __future__ import annotations

from typing import Any

import numpy as np

from ..claim import Claim
from ..engines.search import Search, Trial
from ..engines.symbolic import Identity
from .global_exp_decay import slices

LABEL = "nearsight:slice-decay"


def _trial(rng: np.random.Generator) -> Trial:
    from ...bounds.decay import slice_decay

    measured, a, d = slices(rng)
    return measured, float(slice_decay(a, d)), {"a": a, "d": d}


def _square() -> tuple[Any, Any]:
    """Cost of one end of an inner edge, numbers: a perfect square."""
    import sympy

    lam, l, nu, f, delta = sympy.symbols("lam l nu f delta", positive=True)  # noqa: E741
    left = lam * f**2 / l + (nu - lam) * f * delta + l * (nu - lam) ** 2 / (4 * lam) * delta**2
    return left, (f * lam / l + (nu - lam) * delta / 2) ** 2 * l / lam


def _total() -> tuple[Any, Any]:
    """(a lam/4) at the boundary edge, lam = a/(1+a) gamma^(2(d-1)), is s_d^2."""
    import sympy

    a, w = sympy.symbols("a w", positive=True)  # w = gamma^(d-1)
    return a / 4 * (a / (1 + a)) * w**2, (a**2 / (4 * (1 + a))) * w**2


def _weights() -> tuple[Any, Any]:
    """What (E) asks for at the source, at a slice between two edges, and the boundary's bill.

    ``nu`` depends on the slice only; edges nearer to the boundary have gamma^2 times the weight.
    """
    import sympy

    g, w, u, v = sympy.symbols("g w u v", positive=True)  # gamma_T; w = g^(d-1)
    a, q = 2 * g / (1 - g) ** 2, g**2

    def pays(nu: Any, lam: Any) -> Any:
        return a * (nu - lam) ** 2 / (4 * lam)

    lam = a / (1 + a)
    source, inner = lam * (1 + 2 / a), 2 * (1 + 1 / a) * q / (1 + q)
    left = source - 1 + u * inner + v * a / 4 * lam * w**2
    return left, pays(source, lam) + u * (pays(inner, 1) + pays(inner, q)) + v * (
        a**2 / (4 * (1 + a)) * w**2
    )


def weights() -> Identity:
    """Return the certificate of (E1): weights with which (E) gives s_d at every distance."""
    return Identity(
        _weights,
        "nearsight:weighted-energy with weights of the slice only, a = 2 gamma/(1-gamma)^2: lam = "
        "a/(1+a) next to the source and gamma^2 times the last edge's from slice to slice; nu at "
        "the source and at a slice in between as in [b] and [g]; all other edges (within slices, "
        "past the source, to a boundary that stays) take lam = nu and cost nothing. What (E) asks "
        "for holds with equality, and the boundary edge pays (a/4) lam_1 = s_d^2; unlike factors "
        "u, v keep the three apart",
    )


def _attained() -> tuple[Any, Any]:
    """Two ends and a fixed point: all d >= 2 at once.

    u = (1+2a)^(1/4); t_d = u/sqrt(1+a), t_i = 1, t_1 = 1/u. The four defects below vanish.
    """
    import sympy

    u, x = sympy.symbols("u x", positive=True)
    a = (u**4 - 1) / 2
    gamma = (u**2 - 1) / (u**2 + 1)
    last2 = u**2 / (1 + a)  # t_d^2
    below = 1 + last2 + a * last2
    kappa = 1 + a / below  # stiffness of step d - 1
    bulk = 2 * kappa + a
    first = kappa * (1 + 1 / u**2) + a / u**2
    defects = (
        1 + a * kappa / bulk - kappa,  # a uniform coupling keeps the stiffness
        a / bulk - gamma,  # and multiplies by gamma
        # t_d a/below times t_1 a/first is a/(2 sqrt(1+a)) gamma; t_d = u/sqrt(1+a)
        (u * a / below) * (a / u / first) - a / 2 * gamma,
    )
    total = sum((sympy.cancel(z) * x**i for i, z in enumerate(defects)), sympy.Integer(0))
    return total, sympy.Integer(0)


def _attained_once() -> tuple[Any, Any]:
    import sympy

    w = sympy.symbols("w", positive=True)  # sqrt(1+a)
    a, t = w**2 - 1, 1 / w
    return a * t / (1 + t**2 + a * t**2), a / (2 * w)


CLAIMS: tuple[Claim, ...] = (
    Claim(
        LABEL,
        "the sharp sensitivity of a slice",
        "|dx_d/dx_0| <= s_d = a/(2 sqrt(1+a)) gamma_T^(d-1), d >= 1, between two fixed slices and "
        "until the end.",
        "Assumption 2.1, any product of convex sets",
        (
            weights(),
            Search(
                _trial,
                "random slices of 1 to 3 numbers with arbitrary couplings inside a slice, and the "
                "best chains, at which it is attained",
                nudge=0.99,
            ),
        ),
        uses=("nearsight:weighted-energy", *(f"{LABEL}[{part}]" for part in "abgi")),
    ),
    Claim(
        LABEL,
        "an inner edge",
        "With <xi, f> >= |f|^2/l, nu_i <f_i, delta_i> + nu_j <f_j, delta_j> >= - sum over both "
        "ends of l (nu - lam)^2/(4 lam) |delta|^2.",
        "lam, l, nu > 0",
        (
            Identity(
                _square,
                "lam <f, xi> >= lam |f|^2/l is shared out to the ends; what is left of an end is "
                "(l/lam) |lam f/l + (nu - lam) delta/2|^2",
            ),
        ),
        part="a",
        kind="step",
    ),
    Claim(
        LABEL,
        "what the boundary edge pays",
        "(a/4) lam_1 = s_d^2 with lam_1 = (a/(1+a)) gamma_T^(2(d-1)).",
        "a > 0, d >= 1",
        (Identity(_total, "w = gamma_T^(d-1)"),),
        part="i",
        kind="step",
    ),
    Claim(
        LABEL,
        "it is attained at every d >= 2",
        "The chain with t_1^2 = 1/sqrt(1+2a), t_d^2 = sqrt(1+2a)/(1+a), t_i = 1 between has "
        "dx_d/dx_0 = s_d.",
        "a > 0, d >= 2",
        (
            Identity(
                _attained,
                "u = (1+2a)^(1/4): the stiffness above step d is a fixed point of uniform "
                "couplings, each multiplies by gamma_T, and the two ends give a gamma_T/(2 "
                "sqrt(1+a)); three defects, as coefficients of a polynomial in x",
            ),
        ),
        part="e",
    ),
    Claim(
        LABEL,
        "it is attained at d = 1",
        "t_1^2 = 1/(1+a) gives dx_1/dx_0 = a/(2 sqrt(1+a)).",
        "a > 0",
        (Identity(_attained_once, "w = sqrt(1+a)"),),
        part="f",
    ),
)
