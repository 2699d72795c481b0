r"""``(I + l L)^{-1}`` on the ring of blocks, by its characters.

N blocks of d vertices in a ring, neighbouring blocks completely joined. On vectors that are
constant in each block the Laplacian L has the eigenvalues ``2d (1 - cos(2 pi m/N))``, on vectors
that sum to 0 in each block ``2d``. With ``x = 4 d l``, ``s = sqrt(1+x)``, ``m = 1 + x/2`` and
``q = g(x)`` the sum over the characters of the ring is a sum over images,

.. math:: \frac1N \sum_{m} \frac{\cos(2\pi m\kappa/N)}{1 + 2dl(1-\cos(2\pi m/N))}
    = \frac{q^\kappa + q^{N-\kappa}}{s\,(1-q^N)} .

All expressions below add positive terms only.
"""

from __future__ import annotations

from typing import Any

from ..bounds.arithmetic import Number, geometric_sum, power, sqrt
from ..bounds.decay import g, one_minus_g
from ..bounds.formula import formula
from ..graphs import InputError


def _check(d: int, blocks: int | None, least: int = 3) -> None:
    if d < 1:
        raise InputError(f"d = {d}: blocks of at least 1 vertex are needed", "d")
    if blocks is not None and blocks < least:
        raise InputError(f"blocks = {blocks}: at least {least} are needed", "blocks")


def _one_minus_power(x: Number, n: int) -> Number:
    """Return ``1 - g(x)^n`` as a value of its own."""
    q = g(x)
    return one_minus_g(x) * geometric_sum(1 + 0 * q, q, n)


@formula(counts=("d", "kappa", "blocks"))
def between_blocks(ell: Number, d: int, kappa: Any, blocks: int | None = None) -> Number:
    r"""Return ``B_ij`` for i, j in blocks ``kappa >= 1`` apart.

    ``(q^kappa + q^{N-kappa})/(d s (1 - q^N))``; ``q^kappa/(d s)`` for infinitely many blocks.

    Parameters
    ----------
    ell : number
        The factor of the Laplacian, ``>= 0``.
    d : int
        Vertices a block.
    kappa : int
        Blocks from one to the other, ``1 <= kappa < N``.
    blocks : int, optional
        N, at least 3; infinitely many if omitted.
    """
    _check(d, blocks)
    x = 4 * d * ell
    q, s = g(x), sqrt(1 + x)
    if blocks is None:
        return power(q, kappa) / (d * s)
    if not 1 <= kappa < blocks:
        raise InputError(f"kappa = {kappa}: from 1 to {blocks - 1} are needed", "kappa")
    around = power(q, kappa) + power(q, blocks - kappa)
    return around / (d * s * _one_minus_power(x, blocks))


@formula(counts=("d", "blocks"))
def within_block(ell: Number, d: int, blocks: int | None = None) -> Number:
    r"""Return ``B_ij`` for two different vertices of one block.

    ``(1/d) [x^2/(4 s m (m+s)) + 2 q^N/(s (1 - q^N))]``: the first part is
    ``1/s - 1/m`` without its cancellation.
    """
    _check(d, blocks)
    x = 4 * d * ell
    s, m = sqrt(1 + x), 1 + x / 2
    found = power(x, 2) / (4 * s * m * (m + s))
    if blocks is not None:
        found = found + 2 * power(g(x), blocks) / (s * _one_minus_power(x, blocks))
    return found / d


@formula(counts=("d", "blocks"))
def diagonal(ell: Number, d: int, blocks: int | None = None) -> Number:
    """Return ``B_jj``: `within_block` and ``1/(1 + 2 d l)``."""
    return within_block(ell, d, blocks) + 1 / (1 + 2 * d * ell)


@formula(counts=("d", "blocks"))
def off_diagonal(ell: Number, d: int, blocks: int | None = None) -> Number:
    r"""Return ``1 - B_jj``, the sum of all other entries of a row (rows of B sum to 1).

    ``(d-1)`` times `within_block` and ``2 q (1 - q^{N-1})/(s (1-q)(1 - q^N))``.
    """
    _check(d, blocks)
    x = 4 * d * ell
    q, s = g(x), sqrt(1 + x)
    others = 2 * q / (s * one_minus_g(x))
    if blocks is not None:
        one = 1 + 0 * q
        others = others * geometric_sum(one, q, blocks - 1) / geometric_sum(one, q, blocks)
    return others + (d - 1) * within_block(ell, d, blocks)


def entry(ell: Number, d: int, i: int, j: int, blocks: int | None = None) -> Number:
    """Return ``B_ij``, vertices numbered as in ``ring-of-blocks:NxD``: ``block d + place``."""
    if i == j:
        return diagonal(ell, d, blocks)
    apart = abs(i // d - j // d)
    return between_blocks(ell, d, apart, blocks) if apart else within_block(ell, d, blocks)
