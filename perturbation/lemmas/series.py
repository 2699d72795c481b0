r"""``le: H-inverse``: the power series of ``P^{-1}``, with and without its condition."""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy import linalg

from ...bounds import Parameters
from ...lpc.arrays import Floats
from ..comparison import Comparison, worst
from ._hierarchy import Hierarchy, block_norms
from ._specimen import drawn

LABEL = "le: H-inverse"
TITLE = "the power series of the inverse Hessian converges"
TERMS = (1, 2, 3, 5, 8, 13)  # L: how many terms are summed


def compare(
    hierarchy: Hierarchy,
    parameters: Parameters,
    *,
    instance: str = "",
    seed: int | None = None,
) -> tuple[Comparison, ...]:
    r"""Compare ``rho(J)``, ``J = A D^{-1} = P - I``, and the remainders of the series.

    *stated*: ``rho(J) <= 2 a`` (a = l_T/mu) and, in the largest row sum of block norms,
    ``|P^{-1} - sum_{l<L} (-J)^l| <= (2a)^L/(1-2a)``, if ``2 a < 1``.

    *sharp*: without any condition

    .. math:: \rho(J) \le \frac{a}{1+a}, \qquad
        \Big\| M^{-1} - D^{-1} \sum_{l<L} (-J)^l \Big\|_2 \le \frac1\mu \Big(\frac{a}{1+a}\Big)^L .

    *Why.* J is similar to the symmetric ``S = D^{-1/2} A D^{-1/2}``. One temporal cost with Hessian
    ``[[P, Q], [Q', R]]`` between 0 and l adds ``2 |x'Qy| <= 2 q |x||y|`` to ``|u'Au|``, where
    ``q <= l/2``, and ``x'Px + y'Ry >= 2 q |x||y|`` to ``u'Du``, beside a share
    ``mu (|x|^2 + |y|^2)/2 >= mu |x||y|`` of the node costs (an action has two temporal costs). The
    quotient is at most ``2q/(mu + 2q) <= l/(mu + l)``. The remainder is
    ``D^{-1/2} (-S)^L (I+S)^{-1} D^{-1/2}``, at most ``|S|^L M^{-1}`` in modulus as a quadratic
    form. Difference couplings of one agent attain ``cos(pi/k) a/(1+a)``.

    So the series converges for all couplings; the condition ``mu > 2 l_T`` is sufficient and not
    necessary.

    Parameters
    ----------
    hierarchy : Hierarchy
    parameters : Parameters
        The constants of the class it belongs to.
    instance, seed
        As in `Comparison`.

    References
    ----------
    Paper, ``le: H-inverse``.
    """
    a, mu = float(parameters.a_T), float(parameters.mu)
    condition = 2 * a < 1
    rate = a / (1 + a)
    about: dict[str, Any] = {"instance": instance, "seed": seed}
    values = linalg.eigh(hierarchy.A, hierarchy.D, eigvals_only=True)
    radius = np.abs(values).max(keepdims=True)
    found = worst(LABEL, "radius, stated", radius, 2 * a, hypotheses=condition, **about)
    found += worst(LABEL, "radius, sharp", radius, rate, **about)
    L = np.array(TERMS)
    rows, norms = _remainders(hierarchy)
    floor = 1e-13 / mu  # rounding: remainders are differences
    sharp = rate**L / mu + floor
    found += worst(LABEL, "remainder, sharp", norms, sharp, **about)
    if condition:
        stated = (2 * a) ** L / (1 - 2 * a) + 1e-13
        found += worst(LABEL, "remainder, stated", rows, stated, **about)
    return found


def measure(seed: int) -> tuple[Comparison, ...]:
    """Compare on a random local problem, weak or strong couplings."""
    specimen = drawn(seed, k=8)
    return compare(specimen.hierarchy, specimen.parameters, instance=specimen.text, seed=seed)


def _remainders(h: Hierarchy) -> tuple[Floats, Floats]:
    """Return the norms of the remainders of ``P^{-1}`` (row sums) and ``M^{-1}`` (spectral)."""
    eye = np.eye(len(h.M))
    inverse = np.linalg.inv(h.M)
    exact, total, power = h.D @ inverse, np.zeros_like(eye), eye
    rows, norms = [], []
    for term in range(max(TERMS)):
        total, power = total + power, -power @ h.J
        if term + 1 in TERMS:
            rows.append(block_norms(exact - total, h.size).sum(axis=1).max())
            norms.append(np.linalg.norm(inverse - h.inverse_D @ total, 2))
    return np.array(rows), np.array(norms)
