"""What a competitive ratio in cost promises for the revenue of multiproduct pricing."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from ..bounds.theorem import Hypothesis, Result, at_least_zero
from ..graphs import InputError
from .arrays import Floats
from .pricing import Pricing

LABEL = "le:cr-rev"
RATIO = Hypothesis("cost(ALG) <= CR cost(OPT) for these products and prices")
KNOWN = Hypothesis("the given revenue is at most rev(OPT): that of some feasible prices")


@dataclass(frozen=True)
class Scale:
    """The constants of the lemma, the smallest that hold.

    Parameters
    ----------
    mu : float
        ``2 min xi``.
    k : float
        ``max k``; the paper's l_f is ``2 k``.
    gamma, complement : float
        ``max |eta|``, and ``max(eta, 0)``: substitutes do not hurt.
    b, c : float
        ``max a^u/a^v`` over edges in both directions, 0 without edges; ``max a/cap``.
    degree : int
        The largest degree.
    """

    mu: float
    k: float
    gamma: float
    complement: float
    b: float
    c: float
    degree: int

    @classmethod
    def of(cls, pricing: Pricing) -> Scale:
        """Read the constants off a pricing problem."""
        u, v = pricing.edges.T
        a, cross = pricing.nominal, pricing.cross
        across = np.maximum(a[:, u] / a[:, v], a[:, v] / a[:, u])
        return cls(
            2 * float(pricing.xi.min()),
            float(pricing.elasticity.max()),
            float(np.abs(cross).max(initial=0.0)),
            float(cross.max(initial=0.0)),
            float(across.max(initial=0.0)),
            float((a / pricing.cap).max()),
            pricing.network.max_degree,
        )

    @property
    def eta(self) -> float:
        """The paper's ``max(2 (l_f + Delta b gamma)/mu, c/mu)``, ``l_f = 2 max k``."""
        return max(2 * (2 * self.k + self.degree * self.b * self.gamma), self.c) / self.mu

    @property
    def felt(self) -> float:
        """``K = max k + Delta b max(eta, 0)``: prices a/s have demand at least ``a (1 - K/s)``."""
        return self.k + self.degree * self.b * self.complement

    @property
    def safe(self) -> float:
        """``s = max(2 K, c)``: prices a/s are feasible, and the bound is best at this s."""
        return max(2 * self.felt, self.c)

    @property
    def factor(self) -> float:
        """``F = s^2/(2 mu (s - K))``, with ``C <= F rev(OPT)`` whenever ``x_0 >= 0``."""
        s = self.safe
        return s * (s / (s - self.felt)) / (2 * self.mu)


def safe_prices(pricing: Pricing) -> Floats:
    """Return the prices ``a/s`` of the proof, shape (H, N): feasible, demand at least a/2.

    Their revenue may be given to `guarantee`, which then is at least as good as without.
    """
    return np.minimum(pricing.nominal / Scale.of(pricing).safe, pricing.cap)


def guarantee(
    pricing: Pricing,
    cr: float,
    *,
    tier: Literal["stated", "repaired"] = "repaired",
    revenue: float | None = None,
) -> Result:
    """Return a lower bound on ``rev(ALG)/rev(OPT)`` if ``cost(ALG) <= cr cost(OPT)``.

    All bounds are ``1 - phi (cr - 1)``:

    * repaired, with a `revenue` R: ``phi = (constant - R)/R`` for any ``0 < R <= rev(OPT)``. With
      ``R = rev(OPT)`` it is an equality whenever ``cost(ALG) = cr cost(OPT)``;
    * repaired, without: ``phi = constant/R - 1``, ``R = C/F + sum_v b_1 x_0 a_1/s`` from
      `Scale`, which is ``phi = F - 1`` if ``x_0 = 0``; ``x_0 >= 0`` is needed;
    * stated: ``phi = eta/2``. It is called a guarantee only where the repaired phi is no larger.

    *Why.* With ``cost = constant - rev``, ``cost(ALG) <= cr cost(OPT)`` says
    ``rev(ALG)/rev(OPT) >= 1 - (cr - 1) (constant - rev(OPT))/rev(OPT)``, which grows with
    rev(OPT) > 0. Prices ``a/s`` with ``s >= c`` are within their caps; their demand is at least
    ``a (1 - K/s)``, plus ``b_1 x_0`` at step 1, so that they earn at least
    ``sum a^2 (s - K)/s^2 + sum_v b_1 x_0 a_1/s``. Finally ``sum a^2 >= 2 mu C`` as ``xi >= mu/2``.

    The paper's last line, ``sum a^2/(2 eta mu) >= (2/eta) C``, would need ``xi >= mu``: with
    ``xi >= mu/2`` it is ``C/eta``, twice less. It also leaves ``b_1 x_0^2/2`` out of the constant.
    Two complements, H = 1, ``a = k = 1``, ``eta = 9/10``, ``b = 1/10``, ``x_0 = 0`` have
    ``mu = 1/10``, ``eta/2 = 29`` and ``cost(OPT) = 185/19``; an algorithm that gives everything
    away costs 10, which is 38/37 of it, and earns nothing; the paper promises it 8/37. Without
    any edge it fails as well where a cap binds (``k = 1, b = 9/5``, cap 1/4), or ``x_0 > 0``.

    Parameters
    ----------
    pricing : Pricing
    cr : float
        The competitive ratio in cost, at least 1.
    tier : {"stated", "repaired"}
    revenue : float, optional
        A lower bound on rev(OPT): the revenue of any feasible prices. Not for "stated".

    Returns
    -------
    Result
        Values ``ratio``, ``phi``, ``eta``, ``factor`` (F) and ``constant``; ``ratio`` and ``phi``
        are None where a hypothesis fails. Rounded to nearest, not outwards.

    Raises
    ------
    InputError
        If cr is below 1, or the tier is not one of the two.

    References
    ----------
    Paper, Lemma ``le:cr-rev`` of Appendix ``apx:application``.
    """
    if not (np.ndim(cr) == 0 and np.isfinite(cr) and cr >= 1):
        raise InputError(f"cr = {cr}: a finite number >= 1 is needed", "cr")
    if tier not in ("stated", "repaired"):
        raise InputError(f"tier = {tier!r}: one of stated, repaired", "tier")
    if tier == "stated" and revenue is not None:
        raise InputError("revenue: the stated lemma does not use one; leave it out", "revenue")
    scale = Scale.of(pricing)
    start = at_least_zero("x_0 >= 0", float(pricing.x_0.min()))
    hypotheses: tuple[Hypothesis, ...] = (RATIO, start)
    if revenue is None:
        phi = _a_priori(pricing, scale)
    else:
        above = Hypothesis("the given revenue is > 0", bool(revenue > 0), float(revenue))
        hypotheses = (RATIO, KNOWN, above)
        phi = max(pricing.constant - revenue, 0.0) / revenue if revenue > 0 else np.nan
    if tier == "stated":
        enough = "eta/2 is at least the repaired phi"
        hypotheses = (*hypotheses, at_least_zero(enough, scale.eta / 2 - phi, masks=False))
        phi = scale.eta / 2
    holds = not any(h.fails for h in hypotheses)
    values = {"eta": scale.eta, "factor": scale.factor, "constant": pricing.constant}
    given = tier == "stated" or holds
    values |= {"phi": phi, "ratio": 1 - phi * (cr - 1)} if given else {}
    why = "; ".join(f"hypothesis fails: {h.text}" for h in hypotheses if h.fails)
    reasons = {} if given else {"phi": why, "ratio": why}
    missing = dict.fromkeys(reasons)
    return Result(LABEL, tier, "lower", holds, hypotheses, {**values, **missing}, reasons)


def _a_priori(pricing: Pricing, scale: Scale) -> float:
    """Return ``constant/(C/F + sum_v b_1 x_0 a_1/s) - 1``."""
    carried = float((pricing.carry[0] * pricing.x_0 * pricing.nominal[0]).sum()) / scale.safe
    return pricing.constant / (pricing.base / scale.factor + carried) - 1


def revenue_ratio(pricing: Pricing, x_alg: ArrayLike, x_opt: ArrayLike) -> float:
    """Return ``rev(ALG)/rev(OPT)`` of two price paths, shape (H, N) or (H, N, 1) each.

    Raises
    ------
    InputError
        If the revenue of `x_opt` is not positive: the ratio then says nothing.
    """
    best = pricing.revenue(x_opt)
    if not best > 0:
        raise InputError(f"x_opt: revenue {best:g}; a positive revenue is needed", "x_opt")
    return pricing.revenue(x_alg) / best
