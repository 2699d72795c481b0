"""``nearsight:sharp-cr`` as a planner sees it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from .arithmetic import approximate, upper_end
from .certificate import (
    StepError,
    best_shares,
    cost_gap,
    excess_ratio,
    sharp_excess,
    step_error,
    variational_slope,
)
from .energy import NEIGHBOURS, NEXT, OWN, SHARES, Couplings, Row, float_count, row_bound
from .forms import Form, Gap
from .formula import plain_floats
from .promise import FAR, Floats, Promise
from .setting import Setting

_CROWD = 1e200  # a boundary of more members is not planned with: floats would overflow


@dataclass(frozen=True)
class SharpPromise(Promise):
    """The certificate of one kind, at the shares of the grid.

    Parameters
    ----------
    setting : Setting
        Scalar float parameters and the network; its k and r are not used.
    variant : {"vi", "mix", "smooth"}
        Kind of the certificate.
    """

    setting: Setting
    variant: str
    steps: int = 4

    @property
    def _couplings(self) -> Couplings:
        return Couplings(*(approximate(v) for v in self.setting.couplings))

    def excess(self, k: Any, r: Any) -> Floats:
        """Return the certificate."""
        c, eta = self._couplings, float_count(self.setting.growth.eta(np.asarray(r)))
        with plain_floats():
            value = sharp_excess(
                self.variant, c, eta, k, r, best_shares(self.variant, c, eta, k, r)
            )
        return np.where(np.isnan(value) | np.greater(eta, _CROWD), np.inf, value)

    def floor_in_k(self, k: Any) -> Floats:
        """Return the certificate for a lateral boundary that is not perturbed."""
        c = self._couplings
        alone = c._replace(a_S=0.0)
        with plain_floats():
            e = step_error(alone, 0.0, k, 2, best_shares(self.variant, alone, 0.0, k, 2))
            return np.asarray(excess_ratio(c, cost_gap(self.variant, c, k, e), e))

    def floor_in_r(self, k: int, r: Any) -> Floats:
        """Return the certificate without the top, each coefficient at its own best share.

        From ``k = 4`` on every part that is left grows with k: the sums over the window
        get longer and nothing else changes.
        """
        c, zero = self._couplings, Form(0.0, 0.0)
        eta = float_count(self.setting.growth.eta(np.asarray(r)))
        far = np.greater_equal(r, 2)
        with plain_floats():
            own, later = (self._least(row, c, eta, k, r) for row in (OWN, NEXT))
            nbr = self._least(NEIGHBOURS, c, eta, k, np.maximum(r, 2))
            direct = Form(np.sqrt(c.max_degree), 0.0)  # r = 1: at least sqrt(Delta) D
            nbr = Form(*(np.where(far, v, w) for v, w in zip(nbr, direct, strict=True)))
            e = StepError(zero, zero, own, later, nbr)
            if self.variant != "vi":
                gap = cost_gap(self.variant, c, FAR, e)
            else:  # dG E - E^2/2 is below the bound in both of its cases
                slope = variational_slope(c, FAR, e)
                gap = Gap.product(slope, own).plus(Gap.product(own, own), -0.5)
            value = np.asarray(excess_ratio(c, gap, e))
            # a form that is negative somewhere has no root: it rules nothing out
            value = np.where(np.isnan(value) & np.isfinite(own.D + gap.P_0), 0.0, value)
        return np.where(np.greater(eta, _CROWD), np.inf, value)

    def _least(self, row: Row, c: Couplings, eta: Any, k: int, r: Any) -> Form:
        shares = np.arange(1, SHARES).reshape((-1,) + (1,) * np.ndim(r))
        bound = row_bound(row, c, eta, k, r, shares)
        return Form(*(np.min(part, axis=0) for part in (bound.D_part, bound.y_part)))

    def hopeless(self, k: int, r: int, excess: float) -> bool:
        """Compare with the limit of a large radius, once what the sides add has rounded away."""
        value = float(self.excess(k, r))
        return value > excess and value <= float(self.floor_in_k(k)) * (1 + 1e-12)

    def upper(self, k: int, r: int) -> float:
        """Evaluate the certificate in intervals, at the same shares."""
        eta = self.setting.growth.eta(r)
        shares = best_shares(self.variant, self._couplings, eta, k, r)
        c = self.setting.converted("interval").couplings
        return upper_end(sharp_excess(self.variant, c, eta, k, r, shares))
