r"""Resource augmentation: how much more look-ahead LPC needs than the best algorithm.

An upper bound that falls like ``u^k`` is below a lower bound that falls like ``l^{k*}``
once ``k >= (log l/log u + o(1)) k*``. Logarithms of rates near 1 come from
``log w = -2 asinh((1-w)/(2 sqrt(w)))``, with ``1 - w`` known to full accuracy.
"""

from __future__ import annotations

from ..graphs.growth import Growth
from ..graphs.source import parse_growth
from .arithmetic import Number, asinh, is_zero, maximum, select, sqrt
from .decay import log_g
from .lower import block_size


def _log(w: Number, one_minus_w: Number) -> Number:
    return -2 * asinh(one_minus_w / (2 * sqrt(w)))


def _coupled(y: Number) -> Number:
    """Replace a vanishing coupling by 1: without it no ratio is asked for."""
    return select(is_zero(y), 1 + 0 * y, y)


def temporal_ratio_of_printed_rates(a_T: Number) -> Number:
    """Return ``log lambda_T/log rho_T`` of the printed rates: ``4 log g(4a)/log g(2a)``."""
    a_T = _coupled(a_T)
    return 4 * log_g(4 * a_T) / log_g(2 * a_T)


def spatial_ratio_of_printed_rates(x: Number) -> Number:
    """Return ``log lambda_S/((1/2) log rho_S)`` of the printed rates.

    The half because under ``h = O~(rho_S^{-q/4})``, which the corollary allows, the upper
    bound ``h(r)^2 rho_S^r`` falls like ``rho_S^{r/2}``.
    """
    x = _coupled(x)
    weak = _log(x / (3 + 3 * x), (3 + 2 * x) / (3 + 3 * x))
    large = x > 48
    share = sqrt(48 / select(large, x, 192 + 0 * x))  # 1 - sqrt(lambda_S)
    strong = select(large, 2 * _log(1 - share, share), weak)
    return 4 * maximum(weak, strong) / log_g(x)


def ratio_of_blocks(a_S: Number, max_degree: int) -> Number:
    """Return ``log g(2 floor(Delta/2) a_S)/log g(Delta a_S)``.

    1 for even Delta; for odd Delta the ring of blocks has one neighbour less.
    """
    a_S = _coupled(a_S)
    if max_degree % 2 == 0:
        return 1 + 0 * a_S
    return log_g(2 * block_size(max_degree) * a_S) / log_g(max_degree * a_S)


def converges_up_to(growth: Growth, rate: float) -> bool:
    """Whether ``sum h(q) z^q`` converges for ``z < rate`` (tested just below, in mpmath).

    For ``rate = 1``: the network grows subexponentially.
    """
    from mpmath import mp

    with mp.workprec(120):
        return bool(mp.isfinite(growth.transform(mp.mpf(rate) * (1 - mp.mpf(2) ** -60))))


def contains_ring_of_blocks(growth: Growth) -> bool:
    """Whether the infinite ring of blocks of ``floor(Delta/2)`` grows no faster.

    ``h`` and ``eta`` are compared up to distance 64; the ring's are constant from 3 on.
    A finite network contains no infinite ring.
    """
    d = block_size(growth.max_degree)
    if not d or growth.radius is not None:
        return False
    ring = parse_growth(f"ring-of-blocks:{d}") if d > 1 else parse_growth("line")
    distances = range(1, 65)
    return all(growth.h(q) >= ring.h(q) and growth.eta(q) >= ring.eta(q) for q in distances)
