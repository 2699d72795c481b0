r"""``le:final-step``: boundary errors decay in time and space, for weak couplings."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from ...bounds import Parameters
from ...bounds.tight import choice, optimise, paper_choice
from ...graphs import InputError
from ...lpc.arrays import Floats
from ..comparison import Comparison, worst
from ..sensitivity import solve_refined
from ._hierarchy import block_norms
from ._specimen import Shape, Specimen
from .walks import most

LABEL = "le:final-step"
TITLE = "boundary errors decay in time and space, for weak couplings"
LONGEST = 8  # the largest power of J in the intermediate inequality


def compare(
    specimen: Specimen, b_1: float, b_2: float, *, seed: int | None = None
) -> tuple[Comparison, ...]:
    r"""Compare ``(M^{-1})_{tau',tau} K`` and ``(M^{-1})_{tau',i} R`` with their bounds.

    With ``rho_T = 4 a~ l_T/mu``, ``rho_S = (1+b_1+b_2) gamma_S`` and ``C_1 = C_2`` as in
    `local_tight`, for all y and e

    .. math:: \|(M^{-1}_{\tau',\tau} K y)_{v_0}\| &\le C_1 \rho_T^{|\tau'-\tau|}
        \sum_u \rho_S^{d(v_0,u)-1} \|y_u\|, \\
        \|(M^{-1}_{\tau',i} R e)_{v_0}\| &\le C_2 \rho_T^{|\tau'-i|+1}
        \sum_u \rho_S^{d(v_0,u)} \|e_u\| .

    The right-hand sides are weighted sums of norms: the inequalities hold for all y and e
    if and only if they hold for those with one nonzero entry, so block by block.

    * *K, stated*, *R, stated*: these.
    * *K, as used*: the exponent ``d(v_0,u)`` that the proof arrives at, and that
      ``thm:networked-exp-decay-tight`` needs; the printed one is weaker by ``1/rho_S``.
    * *product*: the inequality of the proof on which both rest,
      ``|(D^{-1} J^l)_{u,q}| <= a^2 (2/mu) binom (2 a~ l_T/mu)^l rho_S^{d(u,q)}``.

    Parameters
    ----------
    specimen : Specimen
    b_1, b_2 : float
        Positive.
    seed
        As in `Comparison`.

    Raises
    ------
    InputError
        If b_1 or b_2 is not positive.

    References
    ----------
    Paper, ``le:final-step``, ``thm:networked-exp-decay-tight``.
    """
    if not (b_1 > 0 and b_2 > 0):
        raise InputError(f"b_1 = {b_1:g}, b_2 = {b_2:g}: positive numbers are needed")
    p, h = specimen.parameters, specimen.hierarchy
    found = choice(specimen.shape.growth, float(p.a_T), float(p.a_S), b_1, b_2)
    # at the edge of the hypotheses a margin is 0 up to rounding
    obeyed = min(float(m) for m in found.margins) >= -1e-12
    text = f"{specimen.text}, b_1 = {b_1:.6g}, b_2 = {b_2:.6g}"
    about: dict[str, Any] = {"instance": text, "seed": seed, "hypotheses": obeyed}
    if float(found.local.one_minus_rho_T) <= 0:
        return ()  # C_1 is not a number: there is nothing to compare with
    measured, gaps, far, lateral = _columns(specimen)
    C, rho_T, rho_S = (float(z) for z in found.local[:1] + found.local[2:4])
    side, ends = measured[:, lateral], measured[:, ~lateral]
    comparisons: tuple[Comparison, ...] = ()
    steps, hops = gaps[:, lateral], far[:, lateral]
    for part, exponent in (("K, stated", hops - 1), ("K, as used", hops)):
        limit = C * rho_T**steps * rho_S**exponent
        comparisons += worst(LABEL, part, side, limit, **about)
    # |tau' - i| + 1 is the number of steps to the fixed action beside step i
    stated = C * rho_T ** gaps[:, ~lateral] * rho_S ** far[:, ~lateral]
    comparisons += worst(LABEL, "R, stated", ends, stated, **about)
    a, a_tilde = (float(z) for z in found.sums)
    product, limits = [], []
    power = np.eye(len(h.M))
    gap = np.abs(np.subtract.outer(np.arange(h.S), np.arange(h.S)))
    for l in range(LONGEST + 1):  # noqa: E741 - the paper's letter
        paths = np.array([[most(l, int(q)) for q in row] for row in gap], dtype=np.float64)
        decay = paths[:, None, :, None] * rho_S ** h.inner_distance[None, :, None, :]
        product.append(h.norms(h.inverse_D @ power))
        limits.append(2 * a**2 / p.mu * (2 * a_tilde * p.a_T) ** l * decay)
        power = power @ h.J
    return comparisons + worst(LABEL, "product", np.array(product), np.array(limits), **about)


def measure(seed: int) -> tuple[Comparison, ...]:
    """Compare on a random local problem, mostly within the hypotheses, often at their edge.

    ``b_1, b_2`` are random, those that the paper recommends, or the optimised ones.
    """
    rng = np.random.default_rng([seed, 3])
    shape = Shape.drawn(seed)
    growth, degree = shape.growth, max(shape.network.max_degree, 1)
    mu = float(10 ** rng.uniform(-1, 1))
    how = int(rng.integers(3))
    b_1, b_2 = paper_choice(degree) if how == 0 else 10 ** rng.uniform(-1.5, 2, 2)
    shares = np.where(rng.random(2) < 0.4, 1.0, rng.random(2) ** 2)
    l_T = float(shares[0]) * mu / (8 * growth.transform(1 / (1 + b_1)))
    l_S = float(shares[1]) * 4 * mu / (degree * (b_1 + b_2))
    l_S = min(l_S, 1e3 * mu)
    if how == 1:
        b_1, b_2 = optimise(growth, l_T / mu, l_S / mu)
    parameters = Parameters(mu, mu * float(rng.choice([1.0, 3.0])), l_T, l_S)
    return compare(Specimen(shape, parameters), float(b_1), float(b_2), seed=seed)


def _columns(specimen: Specimen) -> tuple[Floats, Floats, Floats, NDArray[np.bool_]]:
    """Return block norms of ``M^{-1} (R, K)``, their distances, and which columns are K's.

    Shapes (S m, G) three times, and (G,) of bool.
    """
    h = specimen.hierarchy
    terms = h.local.terms
    moved = block_norms(solve_refined(h.local.terms.hessian(h.x, h.fixed)[0], h.cross), h.n)
    t, u = terms.fixed[:, 1], terms.fixed[:, 2]
    gaps = np.abs(np.subtract.outer(terms.free[:, 1], t)).astype(np.float64)
    far = h.distance[np.searchsorted(h.agents, terms.free[:, 2])][:, u]
    lateral = (t >= terms.free[:, 1].min()) & (t <= terms.free[:, 1].max())
    return moved, gaps, far, lateral
