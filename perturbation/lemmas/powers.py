r"""``le:J-bound``: the blocks of ``J^l`` decay in space."""

from __future__ import annotations

import numpy as np

from ...bounds.decay import demko, gamma_S
from ...graphs import InputError
from ..comparison import Comparison, worst
from ._specimen import Specimen, drawn
from .walks import most

LABEL = "le:J-bound"
TITLE = "blocks of a power of J decay in space"
LONGEST = 8  # the largest power


def compare(
    specimen: Specimen, slower: float, *, seed: int | None = None
) -> tuple[Comparison, ...]:
    r"""Compare the blocks of ``J^l``, ``J = A D^{-1}``, with their bound.

    .. math:: \|((J^l)_{i,j})_{u,q}\| \le \binom{l}{(l-|i-j|)/2}
        \Big(b \frac{2 l_T}{\mu}\Big)^l \gamma_S'^{d(u,q)}, \qquad
        b = \sum_{\gamma \ge 0} (\gamma_S/\gamma_S')^\gamma h(\gamma).

    *stated* is that. *sharp* has ``b^{l-1} (c l_T/(2 mu))^l`` instead, ``c = c(1 + Delta l_S/mu)``:
    one sum less, see ``thm: l-power``; off-diagonal blocks of norm ``l_T/2``; and the constant of
    Demko, Moss and Smith.

    Parameters
    ----------
    specimen : Specimen
    slower : float
        ``gamma_S'``, above ``gamma_S`` and below 1.
    seed
        As in `Comparison`.

    Raises
    ------
    InputError
        If `slower` is out of range.

    References
    ----------
    Paper, ``le:J-bound``.
    """
    rate, h = float(gamma_S(specimen.x)), specimen.hierarchy
    if not rate < slower < 1:
        raise InputError(f"slower = {slower:g}: gamma_S = {rate:g} < slower < 1 is needed")
    b = specimen.shape.growth.transform(rate / slower)
    a, c = float(specimen.parameters.a_T), float(demko(1 + specimen.x))
    gap = np.abs(np.subtract.outer(np.arange(h.S), np.arange(h.S)))
    decay = slower**h.inner_distance
    measured, stated, sharp = [], [], []
    power = np.eye(len(h.M))
    for l in range(1, LONGEST + 1):  # noqa: E741 - the paper's letter
        power = power @ h.J
        paths = np.array([[most(l, int(q)) for q in row] for row in gap], dtype=np.float64)
        common = paths[:, None, :, None] * decay[None, :, None, :]
        measured.append(h.norms(power))
        stated.append((2 * a * b) ** l * common)
        sharp.append((c * a / 2) ** l * b ** (l - 1) * common)
    text = f"{specimen.text}, gamma_S' = {slower:.6g}"
    return tuple(
        found
        for part, bound in (("stated", stated), ("sharp", sharp))
        for found in worst(
            LABEL, part, np.array(measured), np.array(bound), instance=text, seed=seed
        )
    )


def measure(seed: int) -> tuple[Comparison, ...]:
    """Compare on a random local problem, with a random ``gamma_S'``."""
    specimen = drawn(seed)
    rate = float(gamma_S(specimen.x))
    share = np.random.default_rng([seed, 3]).uniform(0.02, 0.98)
    return compare(specimen, rate + (1 - rate) * float(share), seed=seed)
