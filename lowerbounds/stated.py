"""The lower bounds as the paper prints them, and whether what is proven implies them."""

from __future__ import annotations

from dataclasses import dataclass

from ..bounds import Hypothesis, Setting, bounds_for
from ..bounds.arithmetic import Number, power, sqrt
from ..bounds.decay import g, one_minus_g
from ..bounds.formula import formula

LABEL = "thm:bottleneck"


@formula(counts=("k",))
def stated_temporal_excess(mu: Number, l_T: Number, k: int) -> Number:
    r"""Return ``mu^3 (1 - sqrt(lambda_T))^2/(48 (mu+1)^2 l_T) lambda_T^k`` as printed.

    ``lambda_T = g(4 l_T/mu)^2``; evaluated without 0/0 as ``l_T -> 0``. The constant changes with
    the unit of costs (mu and l_T times 2), which no competitive ratio does: it goes back to costs
    with a movement term of a fixed weight.

    References
    ----------
    Paper, ``thm:bottleneck:e2``.
    """
    a = l_T / mu
    rate = g(4 * a)
    unit = power(mu / (mu + 1), 2)
    return (
        unit
        * power(one_minus_g(4 * a), 2)
        * power(rate, 2 * k - 1)
        / (12 * power(sqrt(1 + 4 * a) + 1, 2))
    )


@dataclass(frozen=True)
class Stated:
    """What ``thm:bottleneck`` prints.

    Attributes
    ----------
    lambda_T, lambda_S : float
        The printed rates of k and of r.
    guarantee : bool
        Whether both are rates that are proven.
    hypotheses : tuple of Hypothesis
        The paper's, and whether the rates stay below proven ones.
    temporal : float
        The printed bound on ``CR - 1`` with its constants.
    temporal_guarantee : bool
        Whether a larger bound is proven.
    spatial_guarantee : bool
        Whether ``lambda_S`` is at most the proven rate; no constant is printed.
    """

    lambda_T: float
    lambda_S: float
    guarantee: bool
    hypotheses: tuple[Hypothesis, ...]
    temporal: float
    temporal_guarantee: bool
    spatial_guarantee: bool


def stated(s: Setting, k: int, proven: float) -> Stated:
    """Return what is printed for a setting.

    Parameters
    ----------
    s : Setting
        In floats.
    k : int
        Look-ahead.
    proven : float
        The temporal lower bound on ``CR - 1`` that is proven.
    """
    (bound,) = (b for b in bounds_for(LABEL) if b.tier == "stated")
    found = bound.evaluate(s)
    printed = float(stated_temporal_excess(s.parameters.mu, s.parameters.l_T, k))
    spatial = next(h for h in found.hypotheses if "lambda_S" in h.text)
    return Stated(
        float(found.values["lambda_T"]),
        float(found.values["lambda_S"]),
        found.guarantee,
        found.hypotheses,
        printed,
        printed <= proven,
        not spatial.fails,
    )
