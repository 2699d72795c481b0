"""What the theorems promise for one boundary variable at a given distance."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from ..bounds import Parameters, Setting, bounds_for
from ..bounds.joint import best_tilt, lateral_bound, top_bound
from ..graphs import Growth
from ..lpc.arrays import Floats, Ints

TIERS = ("stated", "repaired", "sharp")


@dataclass(frozen=True)
class Promised:
    """Bounds on the sensitivity of (t0, v0) to one boundary variable (tau, u).

    * ``stated``: ``C rho_T^dt rho_S^ds`` as printed in ``thm:networked-exp-decay``, C being C_1
      for the top and the lateral part, C_2 for the bottom; its guarantee may fail.
    * ``repaired``: the same with the constants that the argument gives.
    * ``sharp``: the entry-by-entry bound ``nearsight:joint-decay``.
    * ``tight`` (only where its hypotheses hold): ``thm:networked-exp-decay-tight`` as printed.

    Parameters
    ----------
    parameters : Parameters
        The constants of the class.
    growth : Growth
        Of the network; what is used is its largest degree, and all of h for ``tight``.
    """

    parameters: Parameters
    growth: Growth

    def bounds(self, part: str, dt: Ints, ds: Ints) -> dict[str, Floats]:
        """Return the bounds of every tier at distances ``dt = |t0 - tau|``, ``ds = d(v0, u)``.

        Parameters
        ----------
        part : {"top", "bottom", "lateral"}
        dt, ds : ndarray of int
            Of one shape; ``dt >= 1`` for top and bottom, ``ds >= 1`` for the lateral part.
        """
        found = self.local(part, dt, ds)
        tight = self._tight(part, dt, ds)
        return found if tight is None else found | {"tight": tight}

    def local(self, part: str, dt: Ints, ds: Ints) -> dict[str, Floats]:
        """Return the same without ``tight``, which asks for all distances of the network."""
        found = {tier: self._printed(tier, part, dt, ds) for tier in ("stated", "repaired")}
        return found | {"sharp": self._sharp(part, dt, ds)}

    def _setting(self) -> Setting:
        return Setting(self.parameters, self.growth)

    def _printed(self, tier: str, part: str, dt: Ints, ds: Ints) -> Floats:
        (bound,) = (b for b in bounds_for("thm:networked-exp-decay") if b.tier == tier)
        return _decay(bound.in_floats(self._setting()), part, dt, ds)

    def _tight(self, part: str, dt: Ints, ds: Ints) -> Floats | None:
        (bound,) = bounds_for("thm:networked-exp-decay-tight")
        result = bound.evaluate(self._setting())
        if not result.guarantee:
            return None
        return _decay(dict(result.values), part, dt, ds)

    def _sharp(self, part: str, dt: Ints, ds: Ints) -> Floats:
        p, degree = self.parameters, self.growth.max_degree
        dt, ds = np.asarray(dt), np.asarray(ds)
        x = degree * p.a_S
        if part == "lateral":
            tilt = best_tilt(p.a_T, x, dt, ds - 1)
            found = lateral_bound(p.a_T, p.a_S, degree, dt, ds, *tilt)
        else:
            tilt = best_tilt(p.a_T, x, dt - 1, ds)
            found = top_bound(p.a_T, x, dt, ds, *tilt)
        return np.asarray(found, dtype=np.float64)


def _decay(values: dict[str, float], part: str, dt: Ints, ds: Ints) -> Floats:
    C = values["C_2" if part == "bottom" else "C_1"]
    found: Floats = C * values["rho_T"] ** np.asarray(dt) * values["rho_S"] ** np.asarray(ds)
    return found
